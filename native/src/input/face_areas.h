// Areas of polygons, in the UV plane and in space.
#pragma once

#include "atlas_refine/atlas.h"

namespace atlas_refine {

/// Twice the signed UV area of a face as it is wound.
double doubled_uv_area(const Atlas& atlas, int face);

/// Twice the area of a face in space; of a polygon that is not flat that of its projection where it is largest.
double doubled_area_in_space(const Atlas& atlas, int face);

}  // namespace atlas_refine
