// Charts that were mended, as they came: what they were bent from, and what their parts may be again.
#pragma once

#include <vector>

#include "cut/cut_atlas.h"
#include "seams/cut_places.h"

namespace atlas_refine {

struct ShapesAsTheyCame {
  /// Per chart its UVs at its wanted density; empty where it was not mended, or opened, or came as a line.
  std::vector<std::vector<Vec2>> uvs;
  std::vector<std::vector<Loss>> bent;  ///< per chart the E_d that mending has cost, where that lies in the mended chart
};

/// `charts`: of the input, at their wanted densities; `mended`: which of `whole` were, which has a piece each.
ShapesAsTheyCame shapes_as_they_came(const std::vector<Chart>& charts, const CutAtlas& whole, const std::vector<int>& mended);

/// Pieces that do not overlap themselves with the shapes as they came get these again: they are nearer to the optimum.
void restore_shapes(const ShapesAsTheyCame& shapes, CutAtlas& atlas);

}  // namespace atlas_refine
