// Charts cut along the edges of their polygons (section 4.1, Fig. 16).
#pragma once

#include "cut_plan.h"

namespace atlas_refine {

/// No face is divided. Differs from section 4.1: parts keep the shapes that they have in the input's UVs instead of becoming
/// rectangles, and are packed by their outlines.
Attempt cut_along_edges(const Refinement& run, CutPlan plan, const ProgressRange& range);

}  // namespace atlas_refine
