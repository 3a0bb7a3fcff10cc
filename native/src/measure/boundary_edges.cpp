// The boundary edges of all charts as one flat list, with a tree over them.
#include "measure/boundary_edges.h"

namespace atlas_refine {

std::vector<BoundaryEdge> boundary_edges(const std::vector<Chart>& charts) {
  std::vector<BoundaryEdge> edges;
  for (std::size_t k = 0; k < charts.size(); ++k) {
    const Chart& chart = charts[k];
    for (std::size_t l = 0; l < chart.boundary_loops.size(); ++l) {
      const std::vector<int>& loop = chart.boundary_loops[l];
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const int from = loop[i], to = loop[(i + 1) % loop.size()];
        edges.push_back(
            {chart.uvs[from], chart.uvs[to], static_cast<int>(k), static_cast<int>(l), static_cast<int>(i), from, to});
      }
    }
  }
  return edges;
}

BoxTree tree_over(const std::vector<BoundaryEdge>& edges) {
  std::vector<Box> boxes;
  std::vector<int> labels;
  boxes.reserve(edges.size());
  labels.reserve(edges.size());
  for (const BoundaryEdge& edge : edges) {
    boxes.push_back(edge.box());
    labels.push_back(edge.chart);
  }
  return BoxTree(std::move(boxes), std::move(labels));
}

}  // namespace atlas_refine
