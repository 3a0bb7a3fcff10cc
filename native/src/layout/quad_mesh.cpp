// Q is read from a copy of the chart's mesh that all trails are traced through.
#include "layout/quad_mesh.h"

#include <Eigen/LU>
#include <algorithm>
#include <map>

#include "geometry/plane.h"
#include "layout/axis_trails.h"

namespace atlas_refine {
namespace {

constexpr double kApart = 1e-4;  // extra corners keep so far from all lines, as a fraction of the boundary

class QuadMeshMaker {
 public:
  QuadMeshMaker(const AxisAlignedChart& aligned, const Chart& source)
      : aligned_(aligned),
        source_(source),
        mesh_(aligned.mesh),
        tracer_(mesh_, aligned.boundary, aligned.quarter_turns),
        turns_(corner_turns(aligned.quarter_turns)) {}

  QuadMesh run(int extra_corners) {
    const int n = static_cast<int>(aligned_.boundary.size());
    for (const auto& loop : mesh_.boundary_loops()) {
      for (const Side& s : loop) out_.boundary_length += surface_length(s);
    }
    for (int i = 0; i < n; ++i) add_corner(i, -turns_[i], false);
    for (int i : extra_corner_places(extra_corners)) add_corner(i, 0, true);
    for (const auto& trail : out_.trails) ends_.push_back(tracer_.trace(trail.start, TrailTracer::Until::Boundary).back());
    for (std::size_t t = 0; t < ends_.size(); ++t) paths_.push_back(tracer_.path(out_.trails[t].start, ends_[t]));
    find_nodes();
    find_faces();
    find_segments();
    return std::move(out_);
  }

 private:
  double surface_length(const Side& side) const {
    const int s = mesh_.sources[side.triangle];
    const Mat2 flat = source_.surface[s].inverse_edges.inverse();
    const auto place = [&](int vertex) -> Vec2 {
      return flat * weights_on(mesh_.supports[vertex], source_.triangles[s]).tail<2>();
    };
    return (place(mesh_.to(side)) - place(mesh_.from(side))).norm();
  }

  /// A corner of `reflex` = -K quarter turns beyond straight has 1 - K directions inside.
  void add_corner(int i, int reflex, bool optional) {
    if (reflex < 0 || (reflex == 0 && !optional)) return;
    std::vector<int> trails;
    for (int j = 1; j <= 1 + reflex; ++j) {
      const TrailStart start{aligned_.boundary[i], aligned_.quarter_turns[i] + j};
      tracer_.hold(start.vertex);
      trails.push_back(static_cast<int>(out_.trails.size()));
      out_.trails.push_back({start, {}, {}, 0});
    }
    out_.corners.push_back(trails);
    out_.optional_corner.push_back(optional);
  }

  /// Boundary vertices that are no corners, as evenly spread along the boundary as they come.
  std::vector<int> extra_corner_places(int count) const {
    const int n = static_cast<int>(aligned_.boundary.size());
    std::vector<double> at(n + 1, 0);
    for (int i = 0; i < n; ++i)
      at[i + 1] = at[i] + (aligned_.mesh.uvs[aligned_.boundary[(i + 1) % n]] - aligned_.mesh.uvs[aligned_.boundary[i]]).norm();
    const double apart = kApart * at[n];
    std::vector<int> places;
    for (int k = 0; k < count; ++k) {
      const double wanted = at[n] * (k + 0.5) / count;
      int best = -1;
      for (int i = 1; i < n; ++i) {
        if (turns_[i] != 0 || beside_a_line(i, places, apart)) continue;
        if (best < 0 || std::abs(at[i] - wanted) < std::abs(at[best] - wanted)) best = i;
      }
      if (best >= 0 && std::find(places.begin(), places.end(), best) == places.end()) places.push_back(best);
    }
    return places;
  }

  /// True where a trail from this place would run beside one of a corner, or of an extra corner that was chosen before.
  bool beside_a_line(int i, const std::vector<int>& chosen, double apart) const {
    const int axis = aligned_.quarter_turns[i] % 2 == 0 ? 0 : 1;
    const double line = aligned_.mesh.uvs[aligned_.boundary[i]][axis];
    for (int k = 0; k < static_cast<int>(aligned_.boundary.size()); ++k) {
      const bool corner = turns_[k] != 0 || std::find(chosen.begin(), chosen.end(), k) != chosen.end();
      if (corner && std::abs(aligned_.mesh.uvs[aligned_.boundary[k]][axis] - line) < apart) return true;
    }
    return false;
  }

  /// Vertices where trails begin, end or meet.
  void find_nodes() {
    std::vector<int> visits(mesh_.vertex_count(), 0);
    for (const auto& path : paths_) {
      for (int v : path) ++visits[v];
      ++visits[path.front()];
      ++visits[path.back()];
    }
    node_of_.assign(mesh_.vertex_count(), -1);
    for (int v = 0; v < mesh_.vertex_count(); ++v) {
      if (visits[v] > 1) node_of_[v] = out_.node_count++;
    }
  }

  /// Triangles that no trail parts make one face.
  void find_faces() {
    trail_edges_.assign(mesh_.triangle_count(), {0, 0, 0});
    for (const auto& path : paths_) {
      for (std::size_t k = 0; k + 1 < path.size(); ++k) {
        const Side side = mesh_.find_side(path[k], path[k + 1]), twin = mesh_.twin(side);
        trail_edges_[side.triangle][side.side] = 1;
        if (twin.triangle >= 0) trail_edges_[twin.triangle][twin.side] = 1;
      }
    }
    face_of_.assign(mesh_.triangle_count(), -1);
    for (int seed = 0; seed < mesh_.triangle_count(); ++seed) {
      if (face_of_[seed] >= 0) continue;
      const int face = static_cast<int>(out_.faces.size());
      Box box{mesh_.uvs[mesh_.triangles[seed][0]], mesh_.uvs[mesh_.triangles[seed][0]]};
      double area = 0;
      std::vector<int> stack = {seed};
      face_of_[seed] = face;
      while (!stack.empty()) {
        const int t = stack.back();
        stack.pop_back();
        const Triangle& v = mesh_.triangles[t];
        area += 0.5 * doubled_area(mesh_.uvs[v[0]], mesh_.uvs[v[1]], mesh_.uvs[v[2]]);
        for (int k = 0; k < 3; ++k) {
          box.min = box.min.cwiseMin(mesh_.uvs[v[k]]);
          box.max = box.max.cwiseMax(mesh_.uvs[v[k]]);
          const int other = mesh_.neighbours[t][k];
          if (trail_edges_[t][k] || other < 0 || face_of_[other] >= 0) continue;
          face_of_[other] = face;
          stack.push_back(other);
        }
      }
      out_.faces.push_back(box);
      out_.face_areas.push_back(area);
    }
  }

  /// Trails that run along one line share their segments.
  void find_segments() {
    std::map<std::pair<int, int>, int> known;
    for (std::size_t t = 0; t < paths_.size(); ++t) {
      const auto& path = paths_[t];
      QuadMesh::Trail& trail = out_.trails[t];
      trail.nodes = {node_of_[path.front()]};
      double length = 0;
      for (std::size_t k = 0; k + 1 < path.size(); ++k) {
        const Side side = mesh_.find_side(path[k], path[k + 1]), twin = mesh_.twin(side);
        length += surface_length(side);
        const int node = node_of_[path[k + 1]];
        if (node < 0) continue;
        const auto key = std::minmax(trail.nodes.back(), node);
        const auto [at, added] = known.try_emplace(key, static_cast<int>(out_.segments.size()));
        if (added)
          out_.segments.push_back(
              {face_of_[side.triangle], twin.triangle >= 0 ? face_of_[twin.triangle] : face_of_[side.triangle], length});
        trail.nodes.push_back(node);
        trail.segments.push_back(at->second);
        trail.length += length;
        length = 0;
      }
    }
  }

  const AxisAlignedChart& aligned_;
  const Chart& source_;
  SplitMesh mesh_;
  TrailTracer tracer_;
  std::vector<int> turns_;  // K_i
  QuadMesh out_;
  std::vector<int> ends_;  // last vertex of each trail
  std::vector<std::vector<int>> paths_;
  std::vector<int> node_of_;
  std::vector<int> face_of_;
  std::vector<std::array<char, 3>> trail_edges_;
};

}  // namespace

QuadMesh make_quad_mesh(const AxisAlignedChart& aligned, const Chart& source, int extra_corners) {
  return QuadMeshMaker(aligned, source).run(extra_corners);
}

}  // namespace atlas_refine
