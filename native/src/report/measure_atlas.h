// Measures and certificate of an atlas that is split already.
#pragma once

#include "atlas_refine/measures.h"
#include "input/split_charts.h"

namespace atlas_refine {

/// The input as all stages see it. UVs are in units of the texture: of a texture of W:H, which [0, 1]^2 stands for, u is
/// stretched by W / H, so that lengths, areas and distortion are those on the texture; nothing changes where the aspect is free
/// or square.
struct InputAtlas {
  const Atlas& atlas;  ///< as it was given
  ChartSet set;
  Measures measures;
};

/// Throws RefineError(BadInput) as split_charts() does.
InputAtlas read_atlas(const Atlas& atlas, double box_aspect);

/// The charts' UVs in units of the texture.
void stretch_to_texture(std::vector<Chart>& charts, double box_aspect);

/// All of Measures but distortion_to_input, which is 1. The charts are in units of the texture.
Measures measure_split(const Atlas& atlas, const ChartSet& set, double box_aspect);

Validity validate_split(const ChartSet& set);

}  // namespace atlas_refine
