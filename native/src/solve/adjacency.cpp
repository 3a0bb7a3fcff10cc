// Nodes renamed, edges to others left out.
#include "solve/adjacency.h"

#include <utility>

namespace atlas_refine {

Subgraph subgraph(const Adjacency& graph, std::vector<int> nodes) {
  Subgraph out{.nodes = std::move(nodes), .graph = {.start = {0}, .nodes = {}}};
  std::vector<int> number(graph.size(), -1);
  for (std::size_t k = 0; k < out.nodes.size(); ++k) number[out.nodes[k]] = static_cast<int>(k);
  for (const int v : out.nodes) {
    for (int e = graph.start[v]; e < graph.start[v + 1]; ++e) {
      if (const int k = number[graph.nodes[e]]; k >= 0) out.graph.nodes.push_back(k);
    }
    out.graph.start.push_back(static_cast<int>(out.graph.nodes.size()));
  }
  return out;
}

}  // namespace atlas_refine
