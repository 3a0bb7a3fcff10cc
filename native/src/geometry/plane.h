// Small formulas of the plane.
#pragma once

#include "atlas_refine/atlas.h"

namespace atlas_refine {

inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Twice the signed area of triangle abc, positive counterclockwise.
inline double doubled_area(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

}  // namespace atlas_refine
