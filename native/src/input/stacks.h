// Charts that lie on each other on purpose.
#pragma once

#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

/// A chart that lies on another one and goes where that goes.
struct Follower {
  int chart;
  int leader;                 ///< no follower itself
  std::vector<int> vertices;  ///< one per vertex of the chart: the leader's vertex that it lies on
  bool same_polygons;         ///< the polygons lie on each other too: it can follow cuts
};

/// Followers among `candidates`, indices of charts where their UVs lie (either sense of winding). A chart follows the first
/// candidate on whose vertices all of its own lie, one on each, within `tolerance` and a fiftieth of the chart's size, and on
/// whose borders its borders lie: the same shape or the mirrored one.
std::vector<Follower> find_stacks(const std::vector<Chart>& placed, const std::vector<int>& candidates, double tolerance);

}  // namespace atlas_refine
