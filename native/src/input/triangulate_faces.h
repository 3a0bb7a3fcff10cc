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

/// Appends the triangles of every face to its chart, in the order of the faces. `corners` has one entry per corner;
/// `turned_faces` tells which faces run backwards in their chart. Returns the faces whose triangles are not all positive.
std::vector<FaceDefect> triangulate_faces(const Atlas& atlas, const std::vector<CornerRef>& corners,
                                          const std::vector<bool>& turned_faces, std::vector<Chart>& charts);

}  // namespace atlas_refine
