// The convex hull of points in the plane (CGAL, exact predicates).
#pragma once

#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine {

/// The points that are the hull's corners, each once, counterclockwise, no three of them collinear. Fewer than three where all
/// points lie on one line.
std::vector<Vec2> convex_hull(const std::vector<Vec2>& points);

}  // namespace atlas_refine
