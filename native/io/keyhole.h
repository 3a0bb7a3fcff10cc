// Polygons with holes, written as one outline.
#pragma once

#include <vector>

namespace atlas_refine::io {

/// Whether a polygon that comes to some vertices several times is loops of different vertices, three or more in each, joined by
/// edges that it runs along to and fro: the way in which outlines with holes are written as one polygon.
bool is_keyhole(std::vector<int> polygon);

}  // namespace atlas_refine::io
