// Atlas Refine: bring a UV atlas to a packing efficiency bound. This is the library's main entry.
//
//   atlas_refine::RefineOptions options;
//   options.pe_bound = 0.85;
//   auto result = atlas_refine::refine(atlas, options);   // result.corner_uvs replaces atlas.corner_uvs
#pragma once

#include "atlas_refine/atlas.h"
#include "atlas_refine/debug_sink.h"
#include "atlas_refine/error.h"
#include "atlas_refine/inspect.h"
#include "atlas_refine/measures.h"
#include "atlas_refine/options.h"
#include "atlas_refine/progress.h"
#include "atlas_refine/result.h"
#include "atlas_refine/tiles.h"

namespace atlas_refine {

/// Brings `atlas` to `options.pe_bound`. With Seams::None only UVs change; faces, corners and their order are the input's.
/// Throws RefineError: BadOption, BadInput, BoundNotReached, NotCertified, Cancelled. Nothing is modified on failure.
/// The UVs of a changed atlas lie in [0, 1]^2, box corner at the origin. A free box has its longer side 1; with a fixed aspect
/// W:H they are those of a texture of W:H: all lengths (gap, distortion, density) are taken with u stretched by W / H.
RefineResult refine(const Atlas& atlas, const RefineOptions& options = {}, const ProgressFn& progress = {},
                    DebugSink* debug = nullptr);

/// The program's version, "major.minor.patch".
const char* version();

}  // namespace atlas_refine
