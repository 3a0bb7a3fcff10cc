// The paper's road: axis-aligned charts, cut and packed as rectangles, distortion reduced under the bound (section 3).
#pragma once

#include <optional>

#include "report/outcome.h"

namespace atlas_refine {

/// The certified result. Nothing where no chart needs a cut, or the bound was not reached: then charts are better squeezed, which
/// divides no face either. Throws as refine() does.
std::optional<RefineResult> cut_into_rectangles(const Atlas& atlas, ChartSet set, const RefineOptions& options, Outcome& outcome,
                                                Monitor& monitor);

}  // namespace atlas_refine
