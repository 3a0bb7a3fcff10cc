// The paper's road: axis-aligned charts, cut and packed as rectangles, distortion reduced under the bound (section 3).
#pragma once

#include "cut_plan.h"

namespace atlas_refine {

/// Where there is no solution charts are better left whole, which divides no face. Throws as refine() does.
Attempt refine_by_rectangles(const Refinement& run, const ProgressRange& range);

}  // namespace atlas_refine
