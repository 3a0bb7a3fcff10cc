// Which relative scale the charts get before they are placed.
#pragma once

#include <vector>

#include "atlas_refine/options.h"
#include "geometry/chart.h"

namespace atlas_refine {

/// Equal: every chart is scaled to its own optimum of E_d, so that all share one density. Keep: the charts stay, and the rest
/// shapes are scaled instead, so that the present scale of each chart is its optimum. True where UVs changed their
/// relative scale by more than a thousandth.
bool set_density(std::vector<Chart>& charts, Density density);

}  // namespace atlas_refine
