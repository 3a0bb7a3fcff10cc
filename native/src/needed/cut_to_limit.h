// The least seams with which the largest distortion is kept.
#pragma once

#include "needed/cut_outcomes.h"

namespace atlas_refine {

/// `found` has the charts without cuts. Adds what was squeezed on the way to the limits of distortion, and with less boundary.
void cut_to_limit(const CutTrials& trials, const RefineOptions& options, const ProgressRange& range, Outcomes& found);

}  // namespace atlas_refine
