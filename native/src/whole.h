// The road without cuts: charts stay whole, are placed anew, and bend as far as the bound needs (the squeeze).
#pragma once

#include "report/solution.h"

namespace atlas_refine {

/// The least intervention that holds the bound, or, where none does, the best that was found. Throws RefineError(BadInput) naming
/// the chart that no embedding without a cut exists or was found for.
Solution refine_whole(const Refinement& run, const ProgressRange& range);

}  // namespace atlas_refine
