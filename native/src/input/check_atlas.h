// Whether the arrays of an atlas fit together.
#pragma once

#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine {

/// Throws RefineError(BadInput) where arrays do not fit together, indices are out of range, or there are no faces.
void check_arrays(const Atlas& atlas);

/// Throws also where a coordinate is not finite or beyond 1e60; names the first face or vertex.
void check_atlas(const Atlas& atlas);

/// True where all coordinates are finite and below 1e60.
bool is_usable(const Atlas& atlas);

/// An atlas whose coordinates are all usable.
struct UsableAtlas {
  Atlas atlas;                ///< faces with a UV or a vertex that is not have all UVs on one point, away from all others
  std::vector<char> has_uvs;  ///< one per face: false for those
};

/// The arrays must fit together. Throws RefineError(BadInput) where no face is usable.
UsableAtlas set_unusable_aside(const Atlas& atlas);

/// "object 'name': ", or nothing where the atlas has no name; opens messages.
std::string message_prefix(const Atlas& atlas);

}  // namespace atlas_refine
