// Guided local search: charts that overlap in a box a little too small are
// moved and turned until none does.
#pragma once

#include <cstdint>

#include "pack/layout.h"

namespace atlas_refine {

/// What a box must satisfy, in cells.
struct BoxGoal {
  double aspect = 0;  ///< width / height, 0 = free
  double enough = 0;  ///< stop at this box area
};

/// Shrinks a feasible layout's box again and again until so much work, in row words compared, is used up. Deterministic.
GridLayout shrink_box(const std::vector<GridChart>& charts, const GridLayout& start, const BoxGoal& goal, std::int64_t most_work,
                      std::uint64_t seed, Watch& watch);

}  // namespace atlas_refine
