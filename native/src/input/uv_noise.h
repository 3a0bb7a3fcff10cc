// How far UVs may differ and be meant as one.
#pragma once

#include "atlas_refine/atlas.h"

namespace atlas_refine {

inline constexpr double kNoise = 1e-4;        ///< of the tile, or of a smaller UV box: below it UVs are one in Blender too
inline constexpr double kNoiseOfEdge = 0.05;  ///< of the shorter UV edge: so that small faces are not welded onto each other

/// In UV units.
double uv_noise(const Atlas& atlas);

}  // namespace atlas_refine
