// The atlases of one call, the charts that went with them and those that stayed, put together again.
#pragma once

#include <optional>
#include <vector>

#include "atlas_refine/result.h"
#include "cut/cut_atlas.h"
#include "input/take_part.h"
#include "report/measure_atlas.h"

namespace atlas_refine {

/// What came of the charts of one atlas.
struct RefinedPart {
  std::vector<int> charts;             ///< of the whole input
  bool changed = false;                ///< else they keep the input's UVs and the rest is empty
  CutAtlas atlas;                      ///< its charts are numbered within `charts`
  std::vector<std::vector<Vec2>> uvs;  ///< of each piece, as they will be stored
};

struct AssembledAtlas {
  Atlas mesh;                  ///< as it comes out
  std::optional<CutMesh> cut;  ///< where some part was cut
};

/// Followers get the UVs, and the cuts, of their leaders; charts of no part keep their own UVs, bit for bit. Where some part is
/// cut all of its followers must have the triangles of their leaders. `triangulate` as CutFaceOptions has it.
AssembledAtlas assemble(const InputAtlas& whole, const Participants& participants, const std::vector<RefinedPart>& parts,
                        bool triangulate);

}  // namespace atlas_refine
