// What a seam along each edge of a chart costs: which edges cuts may run along, and which they should.
#pragma once

#include <array>
#include <limits>
#include <vector>

namespace atlas_refine {

/// Per triangle of a chart and side of it a factor on the side's length, the same from both sides; empty: 1 for all.
using SidePrices = std::vector<std::array<double, 3>>;

inline constexpr double kNoSeam = std::numeric_limits<double>::infinity();  ///< an edge that must stay whole

inline constexpr double kPreferredSeam = 0.1;  ///< at most: an edge where a seam is wanted

}  // namespace atlas_refine
