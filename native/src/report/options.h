// The options of one call, checked once.
#pragma once

#include "atlas_refine/atlas.h"
#include "atlas_refine/options.h"

namespace atlas_refine {

/// These throw RefineError(BadOption) naming the option and its range.
void check_aspect(double box_aspect);
void check_options(const Atlas& atlas, const RefineOptions& options);

/// Those of one group, whose box and gap are its own.
RefineOptions options_of_group(const RefineOptions& options, int group);

}  // namespace atlas_refine
