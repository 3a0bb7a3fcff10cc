// Which edges of the faces are joined in the UV map, and which are seams.
#pragma once

#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine {

/// An edge of a face is named by the corner it starts from; it ends at the face's next corner.
struct EdgeJoins {
  std::vector<int> corner_faces;   ///< face of each corner
  std::vector<int> partners;       ///< one per corner: the edge it is joined with, -1 at seams and natural boundary
  std::vector<bool> turned_faces;  ///< faces wound against the first face of their chart
  int seam_edges = 0;              ///< edges in space that belong to two faces or more and are not joined throughout
  double seam_length = 0;          ///< their length in space, each once

  int next_corner(const Atlas& atlas, int corner) const {
    const int face = corner_faces[corner];
    return corner + 1 < atlas.face_offsets[face + 1] ? corner + 1 : atlas.face_offsets[face];
  }
};

/// Twice the signed UV area of a face as it is wound.
double doubled_uv_area(const Atlas& atlas, int face);

/// Joins every two edges with equal ends, by vertex first, then by equal positions, and equal UVs at both ends. Where more
/// than two such edges meet they stay seams, and so do edges equal by position only whose faces lie on the same side of them in
/// the UV plane: the front and back of a sheet. Edges whose join would make a chart one-sided (Moebius) stay seams as well, so
/// that charts are orientable, and manifold once corners are united across joins only.
EdgeJoins join_edges(const Atlas& atlas);

}  // namespace atlas_refine
