// Section 3.3 for the pieces of a layout: from where it has them to the least distortion under the bound.
#pragma once

#include <string>
#include <vector>

#include "cut_plan.h"
#include "reduce/reduce.h"

namespace atlas_refine {

/// From so many pieces on these may be jammed and slide on and on, by next to nothing; another layout takes long and brings as
/// little.
inline constexpr std::size_t kHundredsOfPieces = 100;

struct ReducedPieces {
  CutAtlas atlas;
  Layout layout;              ///< that it is cut and was packed by
  std::vector<Chart> packed;  ///< before, as the layout has them
  std::string failure = {};   ///< why there is no result
  ReduceResult result = {};
  bool carried = false;  ///< over from coarse charts; `result` is theirs

  bool holds() const { return failure.empty() && result.holds(); }
  bool better_than(const ReducedPieces& other) const;
};

/// `cut`: the axis-aligned charts of the plan, cut along the layout's trails. Reduced to near the optimum: many triangles on
/// coarse charts, few in several packings, of which the best is kept.
ReducedPieces reduce_pieces(const Refinement& run, const CutPlan& plan, const Layout& layout, const CutAtlas& cut);

/// From there, if it holds the bound, to the optimum, without the vertices that only served the deformation.
void finish_pieces(const Refinement& run, const CutPlan& plan, ReducedPieces& at);

/// Takes out the vertices that only served the deformation, of charts that bend.
void restore_pieces(const std::vector<Chart>& charts, const Freedoms& freedom, CutAtlas& cut);

}  // namespace atlas_refine
