// The pieces of cut charts put where a layout wants them.
#pragma once

#include <vector>

#include "layout/search_layout.h"

namespace atlas_refine {

/// `pieces` lie where their axis-aligned charts lie; `charts` tells which chart each one is part of. A piece is known by its
/// bounding box, whose sides are coordinates of its chart's corners, to the last bit.
std::vector<Chart> place_pieces(const Layout& layout, std::vector<Chart> pieces, const std::vector<int>& charts);

}  // namespace atlas_refine
