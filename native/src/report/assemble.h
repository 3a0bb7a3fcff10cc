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
  Atlas mesh;                                      ///< as it comes out
  std::optional<CutMesh> cut = {};                 ///< where some part was cut across faces
  std::vector<std::array<int, 2>> new_seams = {};  ///< pairs of the input's vertices, where cuts ran along its edges
  int cut_edges = 0;                               ///< that were whole in the input's charts
};

struct AssembleOptions {
  Stored stored = Stored::Double;
  bool divide = true;        ///< cuts may divide faces
  bool triangulate = false;  ///< as CutFaceOptions has it
};

/// Followers get the UVs, and the cuts, of their leaders; charts of no part keep their own UVs, bit for bit. Where some part is
/// cut all followers of the charts that it cuts must have the triangles of their leaders.
AssembledAtlas assemble(const InputAtlas& whole, const Participants& participants, const std::vector<RefinedPart>& parts,
                        const AssembleOptions& options);

}  // namespace atlas_refine
