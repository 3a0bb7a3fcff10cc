// Measures and certificate of an atlas that is split already.
#pragma once

#include "atlas_refine/measures.h"
#include "input/split_charts.h"

namespace atlas_refine {

/// All of Measures but distortion_to_input, which is 1.
Measures measure_split(const Atlas& atlas, const ChartSet& set, double box_aspect);

Validity validate_split(const ChartSet& set);

}  // namespace atlas_refine
