// Graphs: which nodes are joined with which.
#pragma once

#include <vector>

namespace atlas_refine {

/// A symmetric pattern: neighbours of column i are nodes[start[i]] to nodes[start[i + 1] - 1], without i itself.
struct Adjacency {
  std::vector<int> start;
  std::vector<int> nodes;

  int size() const { return static_cast<int>(start.size()) - 1; }
};

/// Some nodes of a graph, and the edges between them.
struct Subgraph {
  std::vector<int> nodes;  ///< in the whole graph
  Adjacency graph;         ///< by their places among these
};

Subgraph subgraph(const Adjacency& graph, std::vector<int> nodes);

}  // namespace atlas_refine
