// The options of one call: checked once, and turned into what the stages take.
#pragma once

#include "atlas_refine/options.h"
#include "layout/search_layout.h"
#include "reduce/squeeze.h"

namespace atlas_refine {

/// Throws RefineError(BadOption) naming the option and its range.
void check_options(const Atlas& atlas, const RefineOptions& options);

/// The asked gap alone where one was given, else the default and smaller ones down to a fiftieth of it.
LayoutOptions layout_options(const RefineOptions& options, int threads);
SqueezeOptions squeeze_options(const RefineOptions& options, int threads);

}  // namespace atlas_refine
