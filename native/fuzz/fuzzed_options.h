// Bytes as options of a refinement.
#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include <string>

#include "atlas_refine/options.h"

namespace atlas_refine::fuzz {

/// Options in their ranges, few candidates, one thread.
RefineOptions fuzzed_options(FuzzedDataProvider& data, const Atlas& atlas);

/// The options that differ from their defaults, on one line.
std::string words(const RefineOptions& options);

}  // namespace atlas_refine::fuzz
