// Distortion and stretch of what was squeezed with some cuts.
#pragma once

#include "needed/cut_trials.h"

namespace atlas_refine {

/// As it will be stored; infinite where the bound does not hold.
void measure(const Refinement& run, const Solution& solution, Trial& trial);

}  // namespace atlas_refine
