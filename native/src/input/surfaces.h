// The shapes that the triangles of the charts have in space.
#pragma once

#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

/// Gives every chart its surface and guards without a shape theirs; `positions` has one point in space for each vertex of each
/// chart. Triangles without a shape in space (slivers) take the one they have in the UV plane, at the scale of their chart, or a
/// thin one on their longest side, or a small equilateral, and next to no weight.
void set_surfaces(std::vector<Chart>& charts, const std::vector<std::vector<Vec3>>& positions);

/// The second and third corner of every triangle and guard change places: the surface is seen from behind.
void turn_triangles_over(Chart& chart);

}  // namespace atlas_refine
