// The boundary edges of all charts as one flat list, with a tree over them.
#pragma once

#include <vector>

#include "geometry/box_tree.h"
#include "geometry/chart.h"

namespace atlas_refine {

/// One edge of a boundary loop, the chart on its left.
struct BoundaryEdge {
  Vec2 from, to;
  int chart;
  int loop;      ///< in Chart::boundary_loops
  int position;  ///< of `from` in the loop
  int from_vertex, to_vertex;

  Box box() const { return {from.cwiseMin(to), from.cwiseMax(to)}; }
};

/// Ordered by chart, loop and position.
std::vector<BoundaryEdge> boundary_edges(const std::vector<Chart>& charts);

/// Labels are the charts.
BoxTree tree_over(const std::vector<BoundaryEdge>& edges);

}  // namespace atlas_refine
