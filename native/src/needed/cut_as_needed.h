// Between the two roads: charts are squeezed, and cut where a seam pays.
#pragma once

#include "report/solution.h"

namespace atlas_refine {

/// Squeezes; then, as long as the distortion is above the largest allowed, or, without that limit, as long as a cut saves what
/// its seam costs (RefineOptions::seam_cost), cuts charts one cut after the other where that saves most for the seam's length,
/// places all pieces anew and squeezes them again. The boundary grows by no more than allowed. Throws UnmendedCharts.
Solution cut_as_needed(const Refinement& run, const ProgressRange& range);

}  // namespace atlas_refine
