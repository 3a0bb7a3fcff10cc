// Shortest ways along the edges of a mesh.
#pragma once

#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "geometry/split_mesh.h"

namespace atlas_refine {

struct EdgeWays {
  std::vector<double> cost;  ///< per vertex, infinite where no way leads
  std::vector<int> from;     ///< per vertex: the one before it on the way, -1 at sources and where no way leads
};

/// From the sources to all vertices, or until `target` is reached. `price` gives what a side costs, infinite where no way may
/// run; ways end at vertices that `passable` is false for.
template <class Price, class Passable>
EdgeWays edge_ways(const SplitMesh& mesh, const std::vector<int>& sources, const Price& price, const Passable& passable,
                   int target = -1) {
  EdgeWays out{std::vector<double>(mesh.vertex_count(), std::numeric_limits<double>::infinity()),
               std::vector<int>(mesh.vertex_count(), -1)};
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> queue;
  for (const int v : sources) queue.emplace(out.cost[v] = 0, v);
  while (!queue.empty() && queue.top().second != target) {
    const auto [d, v] = queue.top();
    queue.pop();
    if (d > out.cost[v] || (d > 0 && !passable(v))) continue;
    for (const Side& s : mesh.fan(v)) {
      const int w = mesh.to(s);
      const double through = d + price(s);
      if (through >= out.cost[w]) continue;
      out.from[w] = v;
      queue.emplace(out.cost[w] = through, w);
    }
  }
  return out;
}

}  // namespace atlas_refine
