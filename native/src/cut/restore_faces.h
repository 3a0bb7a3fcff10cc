// Vertices that only prepared a chart for its deformation are taken out again (Fig. 23: the chart is mapped back).
#pragma once

#include <vector>

#include "cut/cut_atlas.h"

namespace atlas_refine {

/// Takes new vertices inside the piece out wherever the triangles that they divided are positive and not much distorted without
/// them; faces that are then whole, and convex, have their guards again. `source` is the chart that the piece was cut from,
/// `scale` brings the piece's UVs to the surface's size. Vertices and triangles are numbered anew; returns how many vertices
/// went.
/// `border_points` tells which points must stay, because they lie on the boundary of this or another piece; empty where only this
/// piece's own boundary counts.
int restore_faces(Piece& piece, const Chart& source, double scale, const std::vector<bool>& border_points = {});

/// Of each point of the atlas whether it lies on the boundary of a piece.
std::vector<bool> points_on_borders(const CutAtlas& atlas);

}  // namespace atlas_refine
