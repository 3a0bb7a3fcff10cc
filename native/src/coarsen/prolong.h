// From coarse UVs to those of the fine chart.
#pragma once

#include <optional>

#include "coarsen/coarse_chart.h"

namespace atlas_refine {

/// Every vertex where its place in the coarse chart went. Elements that turned over or were crushed by that are mended by moving
/// vertices inside, one after the other; nothing where some are left. `fine` is the objective of the chart's elements, in units
/// of `unit`.
std::optional<std::vector<Vec2>> prolong(const Chart& chart, const CoarseChart& coarse, const std::vector<Vec2>& coarse_uvs,
                                         const ChartObjective& fine, double unit);

/// UVs of a chart without flips in which elements that are crushed, next to all others, have been relaxed by moving vertices
/// inside, one after the other. A global Newton step lets each of them come free by a third of its size only, however few they
/// are.
std::vector<Vec2> relax_crushed(const Chart& chart, const ChartObjective& objective, double unit);

}  // namespace atlas_refine
