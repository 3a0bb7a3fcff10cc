// Pieces of a chart left where the chart lies, a little apart: a start that is as good as the layout before the cut.
#pragma once

#include "cut/cut_atlas.h"

namespace atlas_refine {

/// The pieces of `finer`, which has the cuts of `present` and more, with the UVs that these places have in `present`; pieces that
/// were one are drawn apart by about `gap`, where they are so large. `charts` are those of the input.
CutAtlas lay_apart(const CutAtlas& finer, const CutAtlas& present, const std::vector<Chart>& charts, double gap);

}  // namespace atlas_refine
