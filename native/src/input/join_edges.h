// Which edges of the faces are joined in the UV map, and which are seams.
#pragma once

#include <vector>

#include "atlas_refine/atlas.h"
#include "input/edge_uses.h"
#include "support/disjoint_sets.h"

namespace atlas_refine {

/// When the UVs at the two sides of an edge are one.
enum class Joining {
  Exact,    ///< where their values are: what was written is tested as it stands
  AsMeant,  ///< also where they differ by noise, as exporters and editors leave it
};

/// An edge of a face is named by the corner it starts from; it ends at the face's next corner.
struct EdgeJoins {
  std::vector<int> places;         ///< of each vertex the first vertex that lies where it does
  std::vector<int> corner_faces;   ///< face of each corner
  std::vector<int> partners;       ///< one per corner: the edge it is joined with, -1 at seams and natural boundary
  std::vector<char> alike;         ///< one per corner: its partner runs in the same sense: faces wound against each other
  std::vector<int> senses;         ///< one per face: the sign of its UV area as it is wound
  std::vector<bool> turned_faces;  ///< faces wound against the first face of their chart
  int seam_edges = 0;              ///< edges in space that belong to two faces or more and are not joined throughout
  double seam_length = 0;          ///< their length in space, each once
  double open_length = 0;          ///< in space, of all sides of faces that are joined with no other: the charts' boundary

  int next_corner(const Atlas& atlas, int corner) const {
    const int face = corner_faces[corner];
    return corner + 1 < atlas.face_offsets[face + 1] ? corner + 1 : atlas.face_offsets[face];
  }
  /// The side of its UV edge, in the sense it runs in, on which the face lies: 1 left, -1 right, 0 without area.
  int side(int corner) const { return senses[corner_faces[corner]]; }
  /// A joined edge with both faces on one side of it in the UV plane.
  bool is_fold(int corner) const {
    const int other = partners[corner];
    return other >= 0 && side(corner) * side(other) == (alike[corner] ? 1 : -1);
  }
};

/// Joins every two edges at one place in space whose UVs are one: those of the same vertices first, then of the same positions,
/// exact partners before (AsMeant) the nearest within min(1, long side of the UV box) / 10,000 and 5 % of the shorter edge.
/// Where more than two meet, faces on opposite sides of the UV edge are joined, wound alike in the UV plane first: the front of
/// a sheet with the front. Of faces with the same corners in space, doubles of each other, the first are the sheet; doubles on
/// one side are never joined. What is ambiguous then is joined within one chart only. Edges whose join would make a chart
/// one-sided (Moebius) stay seams, so that charts are orientable, and manifold once corners are united across joins only.
EdgeJoins join_edges(const Atlas& atlas, Joining joining, const std::vector<int>& groups = {}, int threads = 1);

/// Faces that joins hold together.
DisjointSets joined_faces(const Atlas& atlas, const EdgeJoins& joins);

/// Winds the faces of each chart alike, and undoes joins that would make it one-sided, folds and faces without area first.
void orient_faces(const Atlas& atlas, EdgeJoins& joins);

}  // namespace atlas_refine
