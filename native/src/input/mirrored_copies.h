// Halves of a folded chart that lie on each other as a Mirror modifier leaves them.
#pragma once

#include <vector>

#include "input/split_charts.h"
#include "input/stacks.h"

namespace atlas_refine {

/// Takes from `followers` of one group those that were one chart with their leaders, folded, and do not come together again with
/// them. The others stay joined: from one to the next of the stack each is reached across edges whose ends lie on the same
/// vertices of the leader from both sides, and none of its edges has ends that do not.
void keep_mirrored_copies(const ChartSet& set, std::vector<Follower>& followers);

}  // namespace atlas_refine
