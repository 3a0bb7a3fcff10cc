// Section 3.3 for the pieces of a layout: from where it has them to the least distortion under the bound.
#pragma once

#include <string>
#include <vector>

#include "cut_plan.h"
#include "reduce/reduce.h"

namespace atlas_refine {

struct ReducedPieces {
  CutAtlas atlas;
  std::vector<Chart> packed;  ///< before, as the layout has them
  std::string failure = {};   ///< why there is no result
  ReduceResult result = {};
};

/// `cut`: the axis-aligned charts of the plan, cut along its trails. Where they have many triangles their pieces are reduced on
/// coarse charts first, in several packings, of which the best is kept.
ReducedPieces reduce_pieces(const Refinement& run, const CutPlan& plan, CutAtlas cut);

/// Takes out the vertices that only served the deformation, of charts that bend.
void restore_pieces(const std::vector<Chart>& charts, const Freedoms& freedom, CutAtlas& cut);

}  // namespace atlas_refine
