// Roots of flips and of point-edge collisions.
#include "geometry/collision.h"

#include <cmath>
#include <limits>
#include <utility>

#include "geometry/plane.h"

namespace atlas_refine {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Real roots of a t^2 + b t + c in ascending order; infinity for each that does not exist.
std::pair<double, double> real_roots(double a, double b, double c) {
  if (a == 0) {
    if (b == 0) return {kNever, kNever};
    return {-c / b, kNever};
  }
  const double discriminant = b * b - 4 * a * c;
  if (discriminant < 0) return {kNever, kNever};
  const double s = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));  // no cancellation
  double r0 = s / a;
  double r1 = s == 0 ? r0 : c / s;
  if (r0 > r1) std::swap(r0, r1);
  return {r0, r1};
}

/// Coefficients of cross(u + t du, v + t dv).
struct Quadratic {
  double a, b, c;
};
Quadratic moving_cross(const Vec2& u, const Vec2& du, const Vec2& v, const Vec2& dv) {
  return {cross(du, dv), cross(u, dv) + cross(du, v), cross(u, v)};
}

}  // namespace

double smallest_positive_root(double a, double b, double c) {
  const auto [r0, r1] = real_roots(a, b, c);
  if (r0 > 0) return r0;
  return r1 > 0 ? r1 : kNever;
}

double flip_time(const Moving& p0, const Moving& p1, const Moving& p2) {
  const Quadratic q = moving_cross(p1.position - p0.position, p1.displacement - p0.displacement, p2.position - p0.position,
                                   p2.displacement - p0.displacement);
  return smallest_positive_root(q.a, q.b, q.c);
}

double hit_time(const Moving& point, const Moving& edge_start, const Moving& edge_end, double limit) {
  constexpr double kEndTolerance = 1e-7;  // 1 % made false stalls
  const Quadratic q = moving_cross(edge_end.position - edge_start.position, edge_end.displacement - edge_start.displacement,
                                   point.position - edge_start.position, point.displacement - edge_start.displacement);
  const auto [r0, r1] = real_roots(q.a, q.b, q.c);
  for (const double t : {r0, r1}) {
    if (!(t > 0) || t > limit) continue;
    const Vec2 start = edge_start.position + t * edge_start.displacement;
    const Vec2 edge = edge_end.position + t * edge_end.displacement - start;
    const Vec2 to_point = point.position + t * point.displacement - start;
    const double length2 = edge.squaredNorm();
    const double along = edge.dot(to_point);
    if (along >= -kEndTolerance * length2 && along <= (1 + kEndTolerance) * length2) return t;
  }
  return kNever;
}

}  // namespace atlas_refine
