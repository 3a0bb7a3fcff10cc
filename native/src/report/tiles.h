// Faces that ran back over a whole tile of the texture: what is told of them, and what stays where their charts are left.
#pragma once

#include "atlas_refine/result.h"
#include "input/take_part.h"
#include "input/unwrap_tiles.h"
#include "report/assemble.h"
#include "report/journal.h"

namespace atlas_refine {

/// Charts that are left as they are keep what they had in the `input`.
void restore_left(const Atlas& input, const ChartSet& set, const Participants& participants, AssembledAtlas& assembled);

/// Names the faces that were moved, and the edges that are seams for that.
void tell_of_tiles(const UnwrappedTiles& tiles, const InputAtlas& whole, const Participants& participants, RefineResult& result,
                   Journal& journal);

}  // namespace atlas_refine
