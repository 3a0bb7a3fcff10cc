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
  std::vector<int> vertex_meshes;  ///< as Atlas::vertex_meshes, of all vertices
};

/// What cut_faces() needs beside the atlas.
struct CutFaceOptions {
  const std::vector<std::vector<Vec2>>& uvs;  ///< as they will be stored, one array per piece
  bool triangulate = false;                   ///< faces that are divided become triangles throughout
};

/// The part of a polygon that lies in one piece becomes one face with the polygon's winding, where that is clearly convex in
/// space and in the UV plane, so that every division of it is positive; else its triangles, as those of a triangle do. A face
/// that nothing crosses keeps its corners in their order, unless a division that was positive in the input no longer is. Faces of
/// charts that have no piece are left out.
CutFaces cut_faces(const Atlas& atlas, const ChartSet& set, const CutAtlas& cut, const CutFaceOptions& options);

}  // namespace atlas_refine
