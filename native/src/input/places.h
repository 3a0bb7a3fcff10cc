// Which vertices lie at one point in space.
#pragma once

#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine {

/// For every vertex the smallest index of the vertices of its mesh that lie exactly where it does.
std::vector<int> places(const Atlas& atlas);

}  // namespace atlas_refine
