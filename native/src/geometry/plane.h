// Small formulas of the plane.
#pragma once

#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine {

inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Twice the signed area of triangle abc, positive counterclockwise.
inline double doubled_area(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

/// Of a polygon without holes.
inline double doubled_area(const std::vector<Vec2>& polygon) {
  double sum = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k) sum += doubled_area(polygon[0], polygon[k - 1], polygon[k]);
  return sum;
}

}  // namespace atlas_refine
