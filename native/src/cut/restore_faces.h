// Vertices that only prepared a chart for its deformation are taken out again (Fig. 23: the chart is mapped back).
#pragma once

#include "cut/cut_atlas.h"

namespace atlas_refine {

/// Takes new vertices inside the piece out wherever the triangles that they divided are positive and not much distorted without
/// them; faces that are then whole, and convex, have their guards again. `source` is the chart that the piece was cut from,
/// `scale` brings the piece's UVs to the surface's size. Vertices and triangles are numbered anew; returns how many vertices
/// went.
int restore_faces(Piece& piece, const Chart& source, double scale);

}  // namespace atlas_refine
