// Faces of which two corners would be one vertex of their chart.
#pragma once

#include "input/join_edges.h"

namespace atlas_refine {

/// Undoes the fewest joins with which two corners of a face would be one vertex though its outline has no such place: corners
/// next to each other, or opposite ones of a quad. No UVs give such a face an area, which would cost its whole chart. These are
/// faces without length in space, around whose end the faces on either side of them are joined: by their places, or as the
/// face has a vertex twice. A join of vertices that the mesh has apart is undone before others, one without length before
/// those, and the nearest to the face of these. On entry joins are orientable, and the faces turned for it.
///
/// Undoes also joins of edges without length that faces have from one vertex of the mesh to two of it: those are the border of
/// faces that come to a point, as bevels do where they run out, and joined would close around a vertex within a face.
void keep_corners_apart(const Atlas& atlas, EdgeJoins& joins);

}  // namespace atlas_refine
