// Charts by themselves: as they would be without a bound.
#pragma once

#include <vector>

#include "atlas_refine/options.h"
#include "geometry/freedom.h"
#include "solve/objective.h"
#include "support/monitor.h"

namespace atlas_refine {

/// Charts in a row, far from each other, roughly at the objective's optimum; they may begin at any places. Borders of one chart
/// stay `gap` of the row's diagonal apart, or as far as they are: that is more than they need when they are packed, so that
/// others find room there and the smallest gap still holds in a larger box.
std::vector<Chart> relaxed_apart(std::vector<Chart> charts, const Objective& objective, const Gap& gap, const Freedoms& freedom,
                                 Monitor& monitor);

}  // namespace atlas_refine
