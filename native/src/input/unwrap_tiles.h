// Faces whose UVs run back over a whole tile, where the map starts again: moved on by a tile, beside their neighbours.
#pragma once

#include <array>
#include <vector>

#include "input/join_edges.h"

namespace atlas_refine {

/// Faces across the line where a texture repeats, such as the last column around a tube: their UVs were taken from both ends of
/// the tile. A whole tile further the texture is the same, and their shape is that of the faces around them.
struct UnwrappedTiles {
  std::vector<int> faces;                ///< that were moved, in ascending order
  std::vector<Vec2> corner_uvs;          ///< of the whole atlas; empty where no face was moved
  std::vector<std::array<int, 2>> torn;  ///< edges, as the corners that their uses start from, that are seams now
};

/// Moves some corners of faces that span more than half a tile, and then lie and are scaled as most of their chart, where that
/// mends the chart. Faces that have a flag in `kept`, and their charts, stay.
UnwrappedTiles unwrap_tiles(const Atlas& atlas, const std::vector<int>& groups, const std::vector<char>& kept);

}  // namespace atlas_refine
