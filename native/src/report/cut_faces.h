// The faces of a mesh whose charts were cut.
#pragma once

#include <vector>

#include "atlas_refine/result.h"
#include "cut/cut_atlas.h"
#include "input/split_charts.h"

namespace atlas_refine {

/// Faces and what each of their corners stands for.
struct CutFaces {
  CutMesh mesh;
  std::vector<CornerRef> corners;  ///< one per corner: piece and its vertex
  std::vector<Vec3> positions;     ///< of all vertices, the input's first
};

/// The part of a face that lies in one piece becomes one face: a polygon with the face's winding where all its vertices lie on
/// its outline, else its triangles. Faces of charts that have no piece are left out. A face that nothing crosses keeps its
/// corners in their order.
CutFaces cut_faces(const Atlas& atlas, const ChartSet& set, const CutAtlas& cut);

}  // namespace atlas_refine
