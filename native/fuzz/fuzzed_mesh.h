// Bytes as a small mesh: a regular one, damaged in the ways that files are.
#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include "atlas_refine/atlas.h"

namespace atlas_refine::fuzz {

/// At most 40 faces; indices fit together, all numbers are finite.
Atlas fuzzed_mesh(FuzzedDataProvider& data);

}  // namespace atlas_refine::fuzz
