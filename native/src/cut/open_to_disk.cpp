// Shortest paths between boundary loops.
#include "cut/open_to_disk.h"

#include <limits>
#include <queue>

namespace atlas_refine {
namespace {

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

int edge_count(const SplitMesh& mesh) {
  int doubled = 0;
  for (const auto& n : mesh.neighbours) {
    for (int other : n) doubled += other < 0 ? 2 : 1;
  }
  return doubled / 2;
}

}  // namespace

Opening open_to_disk(SplitMesh& mesh) {
  Opening out;
  for (auto loops = mesh.vertex_loops(); loops.size() > 1; loops = mesh.vertex_loops()) {
    const std::vector<Side> path = path_between_loops(mesh, loops);
    if (path.empty()) return out;
    mesh.cut(path);
    ++out.holes_cut;
  }
  out.is_disk = mesh.vertex_count() - edge_count(mesh) + mesh.triangle_count() == 1;
  return out;
}

}  // namespace atlas_refine
