// UDIM tiles of an atlas as groups for RefineOptions.
#pragma once

#include <string>
#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine {

/// UDIM tiles as groups for RefineOptions: a chart belongs to the tile that the centre of its UV box lies in. Charts that are
/// larger than a tile, or lie below zero, are dealt out likewise.
struct TileGroups {
  std::vector<int> groups;         ///< one per face, numbers from 0 on in the order of (v, u)
  std::vector<Vec2> origins;       ///< of each group: the tile's lower left corner
  std::vector<std::string> names;  ///< "1001", or "tile (-1, 0)" where UDIM has no number
};
/// Throws RefineError(BadInput) for arrays that do not fit together or hold no finite UV.
TileGroups group_by_tile(const Atlas& atlas);

}  // namespace atlas_refine
