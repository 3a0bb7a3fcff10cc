// Log barrier on the distance between a point and an edge, and between a point and a wall (squeeze.md; replaces the
// scaffold of section 3.3).
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "geometry/boundary.h"

namespace atlas_refine {

/// b(x) = -(x - 1)^2 log x on (0, 1), 0 beyond 1, infinite at x <= 0, with derivatives. Twice continuously differentiable.
struct BarrierValue {
  double value = 0;
  double slope = 0;
  double curvature = 0;
};
BarrierValue log_barrier(double x);
/// The value alone.
inline double log_barrier_value(double x) {
  if (x >= 1) return 0;
  if (!(x > 0)) return std::numeric_limits<double>::infinity();
  return -(x - 1) * (x - 1) * std::log(x);
}

/// One active point-edge contact: its value and derivatives for the point, the edge's start and its end.
struct ContactDerivatives {
  double value = 0;
  double slope = 0;  ///< d value / d distance
  std::array<Vec2, 3> gradient;
  std::array<std::array<Mat2, 3>, 3> hessian;  ///< positive semidefinite: the full 6x6 is projected

  void scale(double factor);
};

/// Barrier on (distance - floor) / range. The distance must be above the floor.
ContactDerivatives contact_derivatives(const Vec2& point, const Vec2& edge_start, const Vec2& edge_end, double floor,
                                       double range, bool project = true);

}  // namespace atlas_refine
