// What a result lacks, in words.
#pragma once

#include <string>
#include <vector>

#include "report/measure_atlas.h"

namespace atlas_refine {

/// The limits of distortion and stretch are kept.
bool within_limits(const RefineOptions& options, const Measures& of);

/// Why a bound is not held where densities are kept; `charts`: those that would outgrow them.
std::string words_on_outgrown(int charts);

/// Where it is held as these were only moved.
std::string words_on_held(int charts);

/// Why the result, these charts, is not what was asked for; empty where it is.
std::string shortfall(const InputAtlas& input, const RefineOptions& options, const Measures& after,
                      const std::vector<Chart>& charts, int outgrown);

}  // namespace atlas_refine
