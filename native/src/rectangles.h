// The paper's road: axis-aligned charts, cut and packed as rectangles, distortion reduced under the bound (section 3).
#pragma once

#include <optional>

#include "report/outcome.h"

namespace atlas_refine {

/// The certified result. Nothing where the bound was not reached, or where no chart was cut and they do not relax from their
/// rectangles: then they are better squeezed. Throws as refine() does.
std::optional<RefineResult> cut_into_rectangles(const Atlas& atlas, ChartSet set, const RefineOptions& options, Outcome& outcome,
                                                Monitor& monitor);

}  // namespace atlas_refine
