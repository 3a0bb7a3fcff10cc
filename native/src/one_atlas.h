// One atlas: the least intervention that brings its charts to the bound.
#pragma once

#include "report/outcome.h"
#include "report/solution.h"

namespace atlas_refine {

/// Throws RefineError as refine() does. `range` is its part of the whole call's progress.
Outcome refine_one(const InputAtlas& input, const RefineOptions& options, const ProgressRange& range, Monitor& monitor,
                   Journal& journal);

/// With the input's UVs, as one of several atlases of which others can be refined.
Outcome left_as_it_is(const InputAtlas& input, const RefineOptions& options, std::string reason);

}  // namespace atlas_refine
