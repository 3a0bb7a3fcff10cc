// Pieces of atlases that were cut each by itself: what is divided on one side of a seam is divided on the other.
#pragma once

#include <vector>

#include "cut/cut_atlas.h"

namespace atlas_refine {

/// Divides every border of a piece where some other piece has a vertex at that place in space, so that the mesh in space stays
/// closed. `charts` are those of the input, `space_points` as in divided_atlas, `uvs` the pieces' UVs; new vertices lie between
/// their neighbours.
void match_pieces(CutAtlas& atlas, const std::vector<Chart>& charts, const std::vector<std::vector<int>>& space_points,
                  std::vector<std::vector<Vec2>>& uvs);

}  // namespace atlas_refine
