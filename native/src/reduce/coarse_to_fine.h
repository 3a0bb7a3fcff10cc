// Coarse to fine: what the engine finds on coarse charts is a start for the charts themselves that is nearly at its optimum.
#pragma once

#include <optional>
#include <vector>

#include "reduce/reduce.h"

namespace atlas_refine {

/// The start of a problem without a box, led down to its optimum as far as coarse charts tell. Nothing where they are no help.
std::optional<std::vector<Chart>> reduced_coarsely(const ReduceProblem& problem, const ReduceMonitor& monitor);

}  // namespace atlas_refine
