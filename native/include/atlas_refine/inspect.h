// What a UV map is made of and what is wrong with it, face by face: for tools that show or select faces.
#pragma once

#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine {

/// The chart that each face belongs to, an index into RefineResult::charts of a refine() of the same arrays and groups.
/// Throws RefineError(BadInput) for arrays that do not fit together or hold no finite UV.
std::vector<int> charts_of_faces(const Atlas& atlas, const std::vector<int>& groups = {});

/// Faces of the input, ascending, that somebody should look at.
struct Problems {
  std::vector<int> unwrapped;    ///< without finite UVs, or of a chart that is a point or a line in the UV map
  std::vector<int> zero_area;    ///< without area in the UV map, in a chart that has some
  std::vector<int> flipped;      ///< turned over against the rest of their chart, or with an outline that crosses itself
  std::vector<int> mirrored;     ///< of charts that are turned over as a whole
  std::vector<int> overlapping;  ///< whose inside has a point in common with that of another face; exact
};
/// Throws as charts_of_faces() does.
Problems find_problems(const Atlas& atlas);

}  // namespace atlas_refine
