// The options of one call, checked once.
#pragma once

#include "atlas_refine/atlas.h"
#include "atlas_refine/options.h"

namespace atlas_refine {

/// Throws RefineError(BadOption) naming the option and its range.
void check_options(const Atlas& atlas, const RefineOptions& options);

}  // namespace atlas_refine
