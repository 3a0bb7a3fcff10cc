// The faces of the input as the triangles of its charts.
#pragma once

#include <vector>

#include "geometry/chart.h"
#include "input/face_defect.h"

namespace atlas_refine {

/// Where a corner of the input went.
struct CornerRef {
  int chart;
  int vertex;  ///< local index into Chart::uvs
};

/// Which divisions of a face are positive throughout in the UV plane; for triangles all are one.
struct FaceReading {
  int chart;              ///< of the face; -1 where it is of none of the charts at hand
  bool fan = true;        ///< from the first corner
  bool ears = true;       ///< ear clipping: the outline is simple
  bool diagonals = true;  ///< of a quad: both; of a larger polygon: all, it is strictly convex
};

struct FaceTriangles {
  std::vector<FaceDefect> defects;    ///< faces whose triangles are not all positive
  std::vector<FaceReading> readings;  ///< one per face
};

/// Appends the triangles of every face to its chart, in the order of the faces, and the guards of polygons; those of polygons
/// that are not clearly convex in space have no shape yet. `corners` has one entry per corner; `turned_faces` tells which faces
/// run backwards in their chart. A polygon that is convex above noise in the UV plane has its ears as guards, a strictly convex
/// quad the triangles of its other diagonal, any other polygon its fan from the first corner where that is positive. Guards of
/// quads that are clearly convex in both are measured. A polygon that is clearly convex in space has none where one of them would
/// be next to flat in the UV plane.
FaceTriangles triangulate_faces(const Atlas& atlas, const std::vector<CornerRef>& corners, const std::vector<bool>& turned_faces,
                                std::vector<Chart>& charts);

}  // namespace atlas_refine
