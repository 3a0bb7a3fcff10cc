// Charts so small that the gap around them takes the room, not they.
#pragma once

#include "atlas_refine/options.h"
#include "cut/cut_atlas.h"
#include "geometry/freedom.h"

namespace atlas_refine {

/// `freedom` where charts are but moved that are no larger than the gap in a box of `box_aspect` at `pe_bound`. Bending them
/// makes no room and costs next to nothing: large ones would crush them, pull them out to hundreds of times their length where
/// that fills a void, or stand still, as no triangle may flip in a step. Those that are distorted as they are still bend, to mend
/// that.
Freedoms with_specks_held(const CutAtlas& atlas, Freedoms freedom, const Gap& gap, double pe_bound, double box_aspect);

}  // namespace atlas_refine
