// Exact geometric predicates on doubles (CGAL's filtered kernel Epick).
#pragma once

#include "atlas_refine/atlas.h"

namespace atlas_refine {

/// Exact sign of the area of triangle abc: +1 counterclockwise, -1 clockwise, 0 collinear.
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

/// Exact: the closed segments ab and cd have a point in common. Segments may be single points.
bool segments_touch(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

}  // namespace atlas_refine
