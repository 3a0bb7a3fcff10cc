// Outlines as their shapes alone tell them, so that a packing depends on nothing else.
#pragma once

#include <vector>

#include "pack/pack_charts.h"

namespace atlas_refine {

/// The same outlines told anew: each in the turn that its own shape suggests, where it may be turned, loops from their lowest
/// point on, large ones first, on so fine a grid that rounding shows in none of them. Outlines that differ in their order, in
/// the vertex a loop starts at, by a motion that they may undergo or by rounding have the same digits then.
struct CanonicalOutlines {
  std::vector<Outline> outlines;   ///< in units of `unit`
  std::vector<int> sources;        ///< which of the input's each one is
  std::vector<Placement> motions;  ///< p -> motion.apply(p) / unit brought outline sources[k] to outlines[k]
  double unit = 1;
  double off_grid = 0;  ///< no point was moved further to lie on the grid, in `unit`

  /// One for each outline of the input, in its units, from one for each of `outlines`.
  std::vector<Placement> of_input(const std::vector<Placement>& placements) const;
};

CanonicalOutlines canonical_outlines(const std::vector<Outline>& outlines, double unit);

}  // namespace atlas_refine
