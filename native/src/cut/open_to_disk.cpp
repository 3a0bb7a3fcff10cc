// Shortest paths between boundary loops.
#include "cut/open_to_disk.h"

#include <limits>
#include <queue>

namespace atlas_refine {
namespace {

// Where paths are equally long one that ends in corners is taken, which leaves no short sides: what another end costs, as a
// fraction of its loop's length, and the cosine of the turn below which it is a corner.
constexpr double kStraightEnd = 1e-7;
constexpr double kCornerCosine = 0.9;

/// Per vertex of the loops, what a path that ends there costs beyond its length; 0 elsewhere.
std::vector<double> end_costs(const SplitMesh& mesh, const std::vector<std::vector<int>>& loops) {
  std::vector<double> costs(mesh.vertex_count(), 0);
  for (const std::vector<int>& loop : loops) {
    const std::size_t n = loop.size();
    const auto edge = [&](std::size_t i) -> Vec2 { return mesh.uvs[loop[(i + 1) % n]] - mesh.uvs[loop[i]]; };
    double length = 0;
    for (std::size_t i = 0; i < n; ++i) length += edge(i).norm();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 before = edge((i + n - 1) % n), after = edge(i);
      if (before.dot(after) > kCornerCosine * before.norm() * after.norm()) costs[loop[i]] = kStraightEnd * length;
    }
  }
  return costs;
}

/// The shortest edge path from one boundary loop (not the first) to any other: as sides, from its one end to the other.
std::vector<Side> path_between_loops(const SplitMesh& mesh, const std::vector<std::vector<int>>& loops,
                                     const SidePrices& prices) {
  std::vector<int> loop_of(mesh.vertex_count(), -1);
  for (std::size_t l = 0; l < loops.size(); ++l) {
    for (int v : loops[l]) loop_of[v] = static_cast<int>(l);
  }
  const std::vector<double> end_cost = end_costs(mesh, loops);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<double> distance(mesh.vertex_count(), std::numeric_limits<double>::infinity());
  std::vector<Side> reached_by(mesh.vertex_count());
  for (int v : loops[1]) {
    distance[v] = end_cost[v];
    queue.emplace(distance[v], v);
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
      const double price = prices.empty() ? 1 : prices[s.triangle][s.side];
      const double through = d + price * (mesh.uvs[w] - mesh.uvs[v]).norm() + end_cost[w];
      if (mesh.is_boundary(s) || price == kNoSeam || through >= distance[w]) continue;
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

Opening open_to_disk(SplitMesh& mesh, const SidePrices& prices) {
  Opening out;
  for (auto loops = mesh.vertex_loops(); loops.size() > 1; loops = mesh.vertex_loops()) {
    const std::vector<Side> path = path_between_loops(mesh, loops, prices);
    if (path.empty()) return out;
    mesh.cut(path);
    ++out.holes_cut;
  }
  out.is_disk = mesh.vertex_count() - edge_count(mesh) + mesh.triangle_count() == 1;
  return out;
}

}  // namespace atlas_refine
