// Whether the arrays of an atlas fit together.
#pragma once

#include "atlas_refine/atlas.h"

namespace atlas_refine {

/// Throws RefineError(BadInput) that names the first face or vertex that cannot be used: arrays that do not fit together,
/// indices out of range, coordinates that are not finite or beyond 1e60, no faces.
void check_atlas(const Atlas& atlas);

/// "object 'name': ", or nothing where the atlas has no name; opens messages.
std::string message_prefix(const Atlas& atlas);

}  // namespace atlas_refine
