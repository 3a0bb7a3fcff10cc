// Q is read from a copy of the chart's mesh that all trails are traced through.
#include "layout/quad_mesh.h"

#include <Eigen/LU>
#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "geometry/plane.h"
#include "layout/axis_trails.h"

namespace atlas_refine {
namespace {

constexpr double kApart = 1e-4;  // extra corners keep so far from all lines, as a fraction of the boundary

constexpr double kAvoided = 20;  // times as long counts what runs where no seam is wanted

/// The edges of a chart where no seam is wanted.
class AvoidedEdges {
 public:
  AvoidedEdges(const Chart& chart, const SidePrices& prices) {
    for (std::size_t t = 0; t < prices.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        if (prices[t][k] == kNoSeam) edges_.insert(std::minmax(chart.triangles[t][k], chart.triangles[t][(k + 1) % 3]));
      }
    }
  }

  /// True where a side of a divided mesh lies on such an edge, or one of its ends inside of one.
  bool touches(const SplitMesh& mesh, const Side& side) const {
    if (edges_.empty()) return false;
    std::set<int> both;
    for (const int vertex : {mesh.from(side), mesh.to(side)}) {
      std::set<int> own(mesh.supports[vertex].vertices.begin(), mesh.supports[vertex].vertices.end());
      own.erase(-1);
      if (is_one(own)) return true;
      both.merge(own);
    }
    return is_one(both);
  }

 private:
  bool is_one(const std::set<int>& ends) const { return ends.size() == 2 && edges_.contains({*ends.begin(), *ends.rbegin()}); }

  std::set<std::pair<int, int>> edges_;
};

double surface_length(const SplitMesh& mesh, const Chart& source, const Side& side) {
  const int s = mesh.sources[side.triangle];
  const Mat2 flat = source.surface[s].inverse_edges.inverse();
  const auto place = [&](int vertex) -> Vec2 { return flat * weights_on(mesh.supports[vertex], source.triangles[s]).tail<2>(); };
  return (place(mesh.to(side)) - place(mesh.from(side))).norm();
}

Vec2 boundary_uv(const AxisAlignedChart& aligned, int i) {
  return aligned.mesh.uvs[aligned.boundary[i % aligned.boundary.size()]];
}

/// True where a trail from boundary vertex i would run within `apart` of one of a corner.
bool beside_a_line(const AxisAlignedChart& aligned, const std::vector<char>& is_corner, int i, double apart) {
  const int axis = aligned.quarter_turns[i] % 2 == 0 ? 0 : 1;
  const double line = boundary_uv(aligned, i)[axis];
  for (int k = 0; k < static_cast<int>(is_corner.size()); ++k) {
    if (is_corner[k] && std::abs(boundary_uv(aligned, k)[axis] - line) < apart) return true;
  }
  return false;
}

/// Boundary vertices that are no corners, as evenly spread along the boundary as they come; their trails keep away from those of
/// corners and of each other.
std::vector<int> extra_corner_places(const AxisAlignedChart& aligned, const std::vector<int>& turns, int count) {
  const int n = static_cast<int>(aligned.boundary.size());
  std::vector<double> at(n + 1, 0);
  for (int i = 0; i < n; ++i) at[i + 1] = at[i] + (boundary_uv(aligned, i + 1) - boundary_uv(aligned, i)).norm();
  std::vector<char> is_corner(n);
  for (int i = 0; i < n; ++i) is_corner[i] = turns[i] != 0;
  std::vector<int> places;
  for (int k = 0; k < count; ++k) {
    const double wanted = at[n] * (k + 0.5) / count;
    int best = -1;
    for (int i = 1; i < n; ++i) {
      if (turns[i] != 0 || beside_a_line(aligned, is_corner, i, kApart * at[n])) continue;
      if (best < 0 || std::abs(at[i] - wanted) < std::abs(at[best] - wanted)) best = i;
    }
    if (best < 0) break;
    places.push_back(best);
    is_corner[best] = 1;
  }
  return places;
}

/// A corner of `reflex` = -K quarter turns beyond straight has 1 - K directions inside.
void add_corner(QuadMesh& quads, const AxisAlignedChart& aligned, int i, int reflex, bool optional) {
  if (reflex < 0 || (reflex == 0 && !optional)) return;
  std::vector<int> trails;
  for (int j = 1; j <= 1 + reflex; ++j) {
    trails.push_back(static_cast<int>(quads.trails.size()));
    quads.trails.push_back({{aligned.boundary[i], aligned.quarter_turns[i] + j}, {}, {}, 0});
  }
  quads.corners.push_back(trails);
  quads.optional_corner.push_back(optional);
}

/// Every trail driven to the boundary through `mesh`, which gets their edges; the vertices that they pass.
std::vector<std::vector<int>> traced(const QuadMesh& quads, const AxisAlignedChart& aligned, SplitMesh& mesh) {
  TrailTracer tracer(mesh, aligned.boundary, aligned.quarter_turns);
  for (const auto& trail : quads.trails) tracer.hold(trail.start.vertex);
  std::vector<int> ends;
  for (const auto& trail : quads.trails) ends.push_back(tracer.trace(trail.start, TrailTracer::Until::Boundary).back());
  // Later trails divide the edges of earlier ones.
  std::vector<std::vector<int>> paths;
  for (std::size_t t = 0; t < ends.size(); ++t) paths.push_back(tracer.path(quads.trails[t].start, ends[t]));
  return paths;
}

/// Per vertex the node that it is, -1 where none: nodes are vertices where trails begin, end or meet.
std::vector<int> find_nodes(const std::vector<std::vector<int>>& paths, int vertex_count, int& node_count) {
  std::vector<int> visits(vertex_count, 0);
  for (const auto& path : paths) {
    for (int v : path) ++visits[v];
    ++visits[path.front()];
    ++visits[path.back()];
  }
  std::vector<int> node_of(vertex_count, -1);
  for (int v = 0; v < vertex_count; ++v) {
    if (visits[v] > 1) node_of[v] = node_count++;
  }
  return node_of;
}

/// Per triangle and side, whether a trail runs along it.
std::vector<std::array<char, 3>> trail_sides(const SplitMesh& mesh, const std::vector<std::vector<int>>& paths) {
  std::vector<std::array<char, 3>> marks(mesh.triangle_count(), {0, 0, 0});
  for (const auto& path : paths) {
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      const Side side = mesh.find_side(path[k], path[k + 1]), twin = mesh.twin(side);
      marks[side.triangle][side.side] = 1;
      if (twin.triangle >= 0) marks[twin.triangle][twin.side] = 1;
    }
  }
  return marks;
}

/// Numbers the faces by where they lie, whatever the order of the triangles.
void number_by_place(QuadMesh& quads, std::vector<int>& face_of) {
  const auto key = [&](int f) {
    const Box& box = quads.faces[f];
    return std::tie(box.min.y(), box.min.x(), box.max.y(), box.max.x());
  };
  std::vector<int> order(quads.faces.size()), number(quads.faces.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  std::vector<Box> faces;
  std::vector<double> areas;
  for (std::size_t k = 0; k < order.size(); ++k) {
    number[order[k]] = static_cast<int>(k);
    faces.push_back(quads.faces[order[k]]);
    areas.push_back(quads.face_areas[order[k]]);
  }
  quads.faces = std::move(faces);
  quads.face_areas = std::move(areas);
  for (int& face : face_of) face = number[face];
}

/// Triangles that no trail parts make one face: fills the faces, returns the face of each triangle.
std::vector<int> find_faces(const SplitMesh& mesh, const std::vector<std::vector<int>>& paths, QuadMesh& quads) {
  const std::vector<std::array<char, 3>> is_trail = trail_sides(mesh, paths);
  std::vector<int> face_of(mesh.triangle_count(), -1);
  for (int seed = 0; seed < mesh.triangle_count(); ++seed) {
    if (face_of[seed] >= 0) continue;
    const int face = static_cast<int>(quads.faces.size());
    Box box{mesh.uvs[mesh.triangles[seed][0]], mesh.uvs[mesh.triangles[seed][0]]};
    double area = 0;
    std::vector<int> stack = {seed};
    face_of[seed] = face;
    while (!stack.empty()) {
      const int t = stack.back();
      stack.pop_back();
      const Triangle& v = mesh.triangles[t];
      area += 0.5 * doubled_area(mesh.uvs[v[0]], mesh.uvs[v[1]], mesh.uvs[v[2]]);
      for (int k = 0; k < 3; ++k) {
        box.min = box.min.cwiseMin(mesh.uvs[v[k]]);
        box.max = box.max.cwiseMax(mesh.uvs[v[k]]);
        const int other = mesh.neighbours[t][k];
        if (is_trail[t][k] || other < 0 || face_of[other] >= 0) continue;
        face_of[other] = face;
        stack.push_back(other);
      }
    }
    quads.faces.push_back(box);
    quads.face_areas.push_back(area);
  }
  number_by_place(quads, face_of);
  return face_of;
}

/// A stretch of a trail from one node to the next.
struct Stretch {
  int from, to;  // nodes
  Side side;     // its last edge
  double length;
};
std::vector<Stretch> stretches(const std::vector<int>& path, const std::vector<int>& node_of, const SplitMesh& mesh,
                               const Chart& source, const AvoidedEdges& avoided) {
  std::vector<Stretch> out;
  int from = node_of[path.front()];
  double length = 0;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const Side side = mesh.find_side(path[k], path[k + 1]);
    length += (avoided.touches(mesh, side) ? kAvoided : 1) * surface_length(mesh, source, side);
    const int node = node_of[path[k + 1]];
    if (node < 0) continue;
    out.push_back({from, node, side, length});
    from = node;
    length = 0;
  }
  return out;
}

/// Trails that run along one line share their segments.
class SegmentIndex {
 public:
  SegmentIndex(const SplitMesh& mesh, const std::vector<int>& face_of, std::vector<QuadMesh::Segment>& segments)
      : mesh_(mesh), face_of_(face_of), segments_(segments) {}

  int segment_of(const Stretch& stretch) {
    const auto [at, added] = known_.try_emplace(std::minmax(stretch.from, stretch.to), static_cast<int>(segments_.size()));
    if (!added) return at->second;
    const Side twin = mesh_.twin(stretch.side);
    const int left = face_of_[stretch.side.triangle];
    segments_.push_back({left, twin.triangle >= 0 ? face_of_[twin.triangle] : left, stretch.length});
    return at->second;
  }

 private:
  const SplitMesh& mesh_;
  const std::vector<int>& face_of_;
  std::vector<QuadMesh::Segment>& segments_;
  std::map<std::pair<int, int>, int> known_;
};

}  // namespace

QuadMesh make_quad_mesh(const AxisAlignedChart& aligned, const Chart& source, int extra_corners, const SidePrices& prices) {
  QuadMesh out;
  SplitMesh mesh = aligned.mesh;
  for (const auto& loop : mesh.boundary_loops()) {
    for (const Side& s : loop) out.boundary_length += surface_length(mesh, source, s);
  }
  const std::vector<int> turns = corner_turns(aligned.quarter_turns);
  for (int i = 0; i < static_cast<int>(turns.size()); ++i) add_corner(out, aligned, i, -turns[i], false);
  for (int i : extra_corner_places(aligned, turns, extra_corners)) add_corner(out, aligned, i, 0, true);
  const std::vector<std::vector<int>> paths = traced(out, aligned, mesh);
  const std::vector<int> node_of = find_nodes(paths, mesh.vertex_count(), out.node_count);
  const std::vector<int> face_of = find_faces(mesh, paths, out);
  SegmentIndex index(mesh, face_of, out.segments);
  const AvoidedEdges avoided(source, prices);
  for (std::size_t t = 0; t < paths.size(); ++t) {
    QuadMesh::Trail& trail = out.trails[t];
    trail.nodes = {node_of[paths[t].front()]};
    for (const Stretch& stretch : stretches(paths[t], node_of, mesh, source, avoided)) {
      trail.nodes.push_back(stretch.to);
      trail.segments.push_back(index.segment_of(stretch));
      trail.length += stretch.length;
    }
  }
  return out;
}

}  // namespace atlas_refine
