// The paper's road: axis-aligned charts, cut and packed as rectangles, distortion reduced under the bound (section 3).
#pragma once

#include <optional>

#include "report/solution.h"

namespace atlas_refine {

/// Nothing where no chart needs a cut, or cuts did not lead to the bound: the journal's fallbacks say which. Charts are better
/// squeezed then, which divides no face. Throws as refine() does.
std::optional<Solution> refine_by_rectangles(const Refinement& run, const ProgressRange& range);

}  // namespace atlas_refine
