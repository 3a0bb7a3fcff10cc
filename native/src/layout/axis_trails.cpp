// Walking along an axis from vertex to vertex.
#include "layout/axis_trails.h"

#include "atlas_refine/error.h"
#include "geometry/axis_aligned_chart.h"
#include "geometry/plane.h"
#include "geometry/predicates.h"

namespace atlas_refine {
namespace {

constexpr double kNear = 0.25;       // a vertex so near along the crossed edge is drawn onto the trail,
constexpr double kLeastArea = 0.25;  // unless a triangle of it would keep less than this share of its area

}  // namespace

TrailTracer::TrailTracer(SplitMesh& mesh, const std::vector<int>& boundary, const std::vector<int>& quarter_turns)
    : mesh_(mesh), marks_(mesh.vertex_count(), 0) {
  const std::size_t n = boundary.size();
  for (std::size_t i = 0; i < n; ++i) {
    const unsigned char keeps = quarter_turns[i] % 2 == 0 ? kKeepY : kKeepX;
    marks_[boundary[i]] |= keeps | kOnBoundary;
    marks_[boundary[(i + 1) % n]] |= keeps;
  }
  // A vertex where the direction changes stays where it is, also where it turns back (K = -2).
  const std::vector<int> turns = corner_turns(quarter_turns);
  for (std::size_t i = 0; i < n; ++i) {
    if (turns[i] != 0) marks_[boundary[i]] |= kKeepX | kKeepY;
  }
}

std::vector<int> TrailTracer::trace(const TrailStart& start, Until until) {
  std::vector<int> trail = {start.vertex};
  const unsigned char keeps = start.quarter_turns % 2 == 0 ? kKeepY : kKeepX;
  while (true) {
    const int next = next_vertex(trail.back(), start.quarter_turns);
    if (next < 0) break;
    const bool stop = marks_[next] & (until == Until::Boundary ? kOnBoundary : kOnBoundary | kOnTrail);
    marks_[next] |= keeps | kOnTrail;
    trail.push_back(next);
    if (stop) break;
  }
  if (trail.size() > 1) marks_[start.vertex] |= keeps | kOnTrail;
  return trail;
}

std::vector<int> TrailTracer::path(const TrailStart& start, int end) {
  std::vector<int> vertices = {start.vertex};
  while (vertices.back() != end) {
    const int next = next_vertex(vertices.back(), start.quarter_turns);
    if (next < 0) throw RefineError(ErrorCode::NotCertified, "layout", "a trail was lost on its way");
    vertices.push_back(next);
  }
  return vertices;
}

/// The next vertex on the line, made where there is none; -1 where the way ahead is not inside the chart.
int TrailTracer::next_vertex(int at, int quarter_turns) {
  const int direction = ((quarter_turns % 4) + 4) % 4;
  const int axis = direction % 2;
  const double ahead = direction < 2 ? 1 : -1;
  // Left of the line: for +x and -y where the other coordinate grows.
  const double left = direction == 0 || direction == 3 ? 1 : -1;
  const Vec2 origin = mesh_.uvs[at];
  const double line = origin[1 - axis];
  const auto off = [&](int v) { return left * (mesh_.uvs[v][1 - axis] - line); };
  for (const Side& side : mesh_.fan(at)) {
    const int right_vertex = mesh_.to(side), left_vertex = mesh_.opposite(side);
    const double right_off = off(right_vertex), left_off = off(left_vertex);
    if (right_off == 0 && ahead * (mesh_.uvs[right_vertex][axis] - origin[axis]) > 0)
      return mesh_.is_boundary(side) ? -1 : right_vertex;
    if (!(right_off < 0 && left_off > 0)) continue;
    const double along = -right_off / (left_off - right_off);
    if (along < kNear && draw_onto(right_vertex, 1 - axis, line)) return right_vertex;
    if (along > 1 - kNear && draw_onto(left_vertex, 1 - axis, line)) return left_vertex;
    const Side crossed{side.triangle, (side.side + 1) % 3};
    Vec2 point = mesh_.uvs[right_vertex] + along * (mesh_.uvs[left_vertex] - mesh_.uvs[right_vertex]);
    point[1 - axis] = line;
    // An edge on another trail or on the boundary hands its properties to its new vertex.
    unsigned char marks = marks_[right_vertex] & marks_[left_vertex];
    const bool upright = mesh_.uvs[right_vertex][axis] == mesh_.uvs[left_vertex][axis];
    if (!upright) marks = 0;
    if (mesh_.is_boundary(crossed)) marks |= kOnBoundary;
    mesh_.split(crossed, along, point);
    marks_.push_back(marks & static_cast<unsigned char>(~(axis == 0 ? kKeepY : kKeepX)));
    return mesh_.vertex_count() - 1;
  }
  return -1;
}

/// Sets one coordinate of the vertex, where nothing else needs the old one and its triangles stay good.
bool TrailTracer::draw_onto(int vertex, int coordinate, double value) {
  if (marks_[vertex] & (coordinate == 0 ? kKeepX : kKeepY)) return false;
  const double old = mesh_.uvs[vertex][coordinate];
  const std::vector<Side> fan = mesh_.fan(vertex);
  std::vector<double> areas;
  const auto area = [&](const Side& s) {
    const Triangle& t = mesh_.triangles[s.triangle];
    return doubled_area(mesh_.uvs[t[0]], mesh_.uvs[t[1]], mesh_.uvs[t[2]]);
  };
  for (const Side& s : fan) areas.push_back(area(s));
  mesh_.uvs[vertex][coordinate] = value;
  for (std::size_t k = 0; k < fan.size(); ++k) {
    const Triangle& t = mesh_.triangles[fan[k].triangle];
    if (area(fan[k]) >= kLeastArea * areas[k] && orientation(mesh_.uvs[t[0]], mesh_.uvs[t[1]], mesh_.uvs[t[2]]) > 0) continue;
    mesh_.uvs[vertex][coordinate] = old;
    return false;
  }
  return true;
}

}  // namespace atlas_refine
