// Whether a polygon is convex, so that every division of it is good: exactly, and by a margin.
#pragma once

#include <span>

#include "geometry/chart.h"

namespace atlas_refine {

/// Corner i with its neighbours: the triangle that an ear at i would be.
Triangle corner_triangle(int i, int corner_count);

/// Exact: every corner turns left and the polygon winds once.
bool is_strictly_convex(std::span<const Vec2> polygon);

/// No corner is nearly straight or nearly folded: each ear has at least a twentieth of the area that it has in a regular
/// polygon of as many corners and this area. Affine maps change nothing.
bool is_clearly_convex(std::span<const Vec2> polygon);
/// With ears of a tenth of that: nearly straight corners that are meant.
bool is_convex_above_noise(std::span<const Vec2> polygon);
/// Clearly convex in space, ears being measured across the polygon's mean normal.
bool is_clearly_convex(std::span<const Vec3> polygon);

}  // namespace atlas_refine
