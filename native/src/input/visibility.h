// How much of a surface is seen from around it: seams are best where nobody looks.
#pragma once

#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine {

/// Per vertex in [0, 1]: of the directions that the surface looks to there, each by its cosine, the share from which no other
/// part of its mesh hides it. Told from pictures of each mesh, 128 pixels wide; vertices at one place have the same.
std::vector<double> visibility(const Atlas& atlas, int threads);

}  // namespace atlas_refine
