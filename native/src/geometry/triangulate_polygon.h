// Triangulation of one polygon face, positive in the UV plane.
#pragma once

#include <optional>
#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

/// The fan (0, 1, 2), (0, 2, 3), ...
std::vector<Triangle> polygon_fan(int corner_count);

/// Triangles over the corners of a polygon with corners `uvs` in the UV plane and `positions` in space: the fan where that is
/// strictly positive in the UV plane, has no two opposing normals in space and no slivers in either, else the constrained
/// Delaunay triangulation of the UV polygon. Nothing where the UV polygon is not counterclockwise and simple; it may run along an
/// edge to and fro, as keyholes do, and come to a place several times.
std::optional<std::vector<Triangle>> triangulate_polygon(const std::vector<Vec2>& uvs, const std::vector<Vec3>& positions);

}  // namespace atlas_refine
