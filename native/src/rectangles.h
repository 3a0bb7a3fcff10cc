// The paper's road: axis-aligned charts, cut and packed as rectangles, distortion reduced under the bound (section 3).
#pragma once

#include <optional>

#include "report/outcome.h"

namespace atlas_refine {

/// The certified result; nothing where no cut was found for any chart and the charts do not relax from their rectangles either:
/// then they are better squeezed. Throws as refine() does.
std::optional<RefineResult> cut_into_rectangles(const Atlas& atlas, ChartSet set, const RefineOptions& options, Outcome& outcome,
                                                Monitor& monitor);

}  // namespace atlas_refine
