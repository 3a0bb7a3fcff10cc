// An edge with all that is near it.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/plane.h"

namespace atlas_refine {

/// An edge dilated to a capsule.
struct Capsule {
  Vec2 a, b;
  double radius;

  /// Largest x of the capsule at height y, -infinity where it does not reach.
  double right_at(double y) const {
    double x = -INFINITY;
    for (const Vec2& p : {a, b}) {
      const double square = radius * radius - (y - p.y()) * (y - p.y());
      if (square >= 0) x = std::max(x, p.x() + std::sqrt(square));
    }
    const Vec2 edge = b - a;
    const double length = edge.norm();
    if (length > 0 && edge.y() != 0) {
      const double sign = edge.y() > 0 ? 1 : -1;
      const Vec2 p = a + sign * radius / length * Vec2(edge.y(), -edge.x());
      const double t = (y - p.y()) / edge.y();
      if (t >= 0 && t <= 1) x = std::max(x, p.x() + t * edge.x());
    }
    return x;
  }

  /// Largest x in the band [low, high], which the capsule reaches: its right
  /// side is concave in y.
  double right_in(double low, double high) const {
    const Vec2& tip = a.x() > b.x() ? a : b;
    if (tip.y() >= low && tip.y() <= high) return tip.x() + radius;
    const double reached_low = std::max(low, std::min(a.y(), b.y()) - radius);
    const double reached_high = std::min(high, std::max(a.y(), b.y()) + radius);
    double x = right_at(std::clamp(tip.y(), reached_low, reached_high));
    // On its extreme heights round-off may miss the capsule altogether.
    if (x == -INFINITY) x = std::max(a.x(), b.x()) + radius;
    return x;
  }
};

}  // namespace atlas_refine
