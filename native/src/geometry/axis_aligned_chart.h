// A chart whose boundary is axis-aligned: what stage 1 of the paper hands to stage 2.
#pragma once

#include <vector>

#include "geometry/split_mesh.h"

namespace atlas_refine {

/// K_i at the start of each boundary edge: the step in quarter turns from the edge before; sums to 4 (eq. 2).
std::vector<int> corner_turns(const std::vector<int>& quarter_turns);

/// One chart after stage 1, at its wanted density: one for all charts, in surface units, or with Density::Keep each chart's own.
struct AxisAlignedChart {
  /// How it came about. Rectangle: Tutte's embedding onto a rectangle, the safety net. AsItIs: a chart too small to be deformed,
  /// or not a disk; its boundary is not axis-aligned, and it is packed by its bounding box.
  enum class Way { Deformed, Rectangle, AsItIs };
  Way way = Way::Deformed;
  SplitMesh mesh;                  ///< of the input chart; UVs are axis-aligned
  std::vector<int> boundary;       ///< vertices, counterclockwise, the chart on the left; empty where AsItIs
  std::vector<int> quarter_turns;  ///< Theta_i of the edge from boundary[i] on
  int holes_cut = 0;
};

}  // namespace atlas_refine
