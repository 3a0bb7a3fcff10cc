// Distortion and stretch of what was squeezed with some cuts.
#pragma once

#include "needed/cut_trials.h"

namespace atlas_refine {

/// Infinite where the bound does not hold. What seems to keep the limits that are asked is measured as it will be stored.
void measure(const Refinement& run, const Solution& solution, Trial& trial);

}  // namespace atlas_refine
