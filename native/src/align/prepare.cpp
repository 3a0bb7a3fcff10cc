// Cutting holes open and dividing edges.
#include "align/prepare.h"

#include <algorithm>
#include <queue>

namespace atlas_refine {
namespace {

// Boundary edges are divided until they are at most this fraction of the boundary long: corners can only lie at vertices.
constexpr double kLongestEdge = 0.08;

/// The shortest edge path from one boundary loop (not the first) to any other: as sides, from its one end to the other.
std::vector<Side> path_between_loops(const SplitMesh& mesh, const std::vector<std::vector<int>>& loops) {
  std::vector<int> loop_of(mesh.vertex_count(), -1);
  for (std::size_t l = 0; l < loops.size(); ++l) {
    for (int v : loops[l]) loop_of[v] = static_cast<int>(l);
  }
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<double> distance(mesh.vertex_count(), std::numeric_limits<double>::infinity());
  std::vector<Side> reached_by(mesh.vertex_count());
  for (int v : loops[1]) {
    distance[v] = 0;
    queue.emplace(0, v);
  }
  while (!queue.empty()) {
    const auto [d, v] = queue.top();
    queue.pop();
    if (d > distance[v]) continue;
    if (loop_of[v] >= 0 && loop_of[v] != 1) {
      std::vector<Side> path;
      for (int walk = v; reached_by[walk].triangle >= 0; walk = mesh.from(path.back())) path.push_back(reached_by[walk]);
      return path;
    }
    for (const Side& s : mesh.fan(v)) {
      const int w = mesh.to(s);
      const double through = d + (mesh.uvs[w] - mesh.uvs[v]).norm();
      if (mesh.is_boundary(s) || through >= distance[w]) continue;
      distance[w] = through;
      reached_by[w] = s;
      queue.emplace(through, w);
    }
  }
  return {};
}

void divide_long_boundary_edges(SplitMesh& mesh) {
  for (const auto& loop : mesh.boundary_loops()) {
    double perimeter = 0;
    for (const Side& s : loop) perimeter += (mesh.uvs[mesh.to(s)] - mesh.uvs[mesh.from(s)]).norm();
    std::vector<std::pair<int, int>> edges;
    for (const Side& s : loop) edges.emplace_back(mesh.from(s), mesh.to(s));
    while (!edges.empty()) {
      const auto [a, b] = edges.back();
      edges.pop_back();
      if ((mesh.uvs[b] - mesh.uvs[a]).norm() <= kLongestEdge * perimeter) continue;
      const int middle = mesh.split(mesh.find_side(a, b), 0.5, 0.5 * (mesh.uvs[a] + mesh.uvs[b]));
      edges.emplace_back(a, middle);
      edges.emplace_back(middle, b);
    }
  }
}

void divide_bridges(SplitMesh& mesh) {
  std::vector<char> outer(mesh.vertex_count(), 0);
  for (const auto& loop : mesh.boundary_loops()) {
    for (const Side& s : loop) outer[mesh.from(s)] = 1;
  }
  std::vector<std::pair<int, int>> bridges;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Side s{t, k};
      if (!mesh.is_boundary(s) && mesh.from(s) < mesh.to(s) && outer[mesh.from(s)] && outer[mesh.to(s)])
        bridges.emplace_back(mesh.from(s), mesh.to(s));
    }
  }
  for (const auto& [a, b] : bridges) {
    const Side side = mesh.find_side(a, b);
    mesh.split(side.triangle >= 0 ? side : mesh.find_side(b, a), 0.5, 0.5 * (mesh.uvs[a] + mesh.uvs[b]));
  }
}

int edge_count(const SplitMesh& mesh) {
  int doubled = 0;
  for (const auto& n : mesh.neighbours) {
    for (int other : n) doubled += other < 0 ? 2 : 1;
  }
  return doubled / 2;
}

}  // namespace

PreparedChart prepare_chart(const Chart& chart) {
  PreparedChart out{SplitMesh(chart)};
  SplitMesh& mesh = out.mesh;
  for (auto loops = mesh.vertex_loops(); loops.size() > 1; loops = mesh.vertex_loops()) {
    const std::vector<Side> path = path_between_loops(mesh, loops);
    if (path.empty()) return out;
    mesh.cut(path);
    ++out.holes_cut;
  }
  out.is_disk = mesh.vertex_count() - edge_count(mesh) + mesh.triangle_count() == 1;
  if (!out.is_disk) return out;
  divide_long_boundary_edges(mesh);
  divide_bridges(mesh);
  return out;
}

}  // namespace atlas_refine
