// The options of one call, checked once.
#pragma once

#include "atlas_refine/atlas.h"
#include "atlas_refine/options.h"

namespace atlas_refine {

/// These throw RefineError(BadOption) naming the option and its range.
void check_aspect(double box_aspect);
void check_options(const Atlas& atlas, const RefineOptions& options);

}  // namespace atlas_refine
