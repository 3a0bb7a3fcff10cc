// Ears of polygons.
#include "geometry/convex_polygon.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "geometry/plane.h"
#include "geometry/predicates.h"

namespace atlas_refine {
namespace {

// Of the ear of a regular polygon: what is clear to see, and what is more than noise.
constexpr double kClear = 0.05, kAboveNoise = 0.005;

/// Area of an ear of a regular polygon / area of the polygon.
double regular_ear(std::size_t corners) {
  const double sine = std::sin(std::numbers::pi / static_cast<double>(corners));
  return 4 * sine * sine / static_cast<double>(corners);
}

/// `ear` gives the doubled area of a triangle of corners.
template <class Ear>
bool ears_are_large(std::size_t corners, double share, Ear&& ear) {
  double doubled = 0;
  for (std::size_t i = 2; i < corners; ++i) doubled += ear({0, static_cast<int>(i) - 1, static_cast<int>(i)});
  if (!(doubled > 0)) return false;
  for (std::size_t i = 0; i < corners; ++i) {
    const Triangle triangle = corner_triangle(static_cast<int>(i), static_cast<int>(corners));
    if (!(ear(triangle) >= share * regular_ear(corners) * doubled)) return false;
  }
  return true;
}

bool is_convex_with(double share, std::span<const Vec2> polygon) {
  return is_strictly_convex(polygon) && ears_are_large(polygon.size(), share, [&](const Triangle& t) {
           return doubled_area(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
         });
}

}  // namespace

Triangle corner_triangle(int i, int corner_count) { return {(i + corner_count - 1) % corner_count, i, (i + 1) % corner_count}; }

bool is_strictly_convex(std::span<const Vec2> polygon) {
  const int count = static_cast<int>(polygon.size());
  const auto positive = [&](int a, int b, int c) { return orientation(polygon[a], polygon[b], polygon[c]) > 0; };
  for (int i = 0; i < count; ++i) {
    const Triangle ear = corner_triangle(i, count);
    if (!positive(ear[0], ear[1], ear[2])) return false;
  }
  for (int i = 2; i < count; ++i) {
    if (!positive(0, i - 1, i)) return false;
  }
  return true;
}

bool is_clearly_convex(std::span<const Vec2> polygon) { return is_convex_with(kClear, polygon); }

bool is_convex_above_noise(std::span<const Vec2> polygon) { return is_convex_with(kAboveNoise, polygon); }

bool is_clearly_convex(std::span<const Vec3> polygon) {
  const auto normal = [&](const Triangle& t) -> Vec3 {
    return (polygon[t[1]] - polygon[t[0]]).cross(polygon[t[2]] - polygon[t[0]]);
  };
  Vec3 sum = Vec3::Zero();
  for (int i = 2; i < static_cast<int>(polygon.size()); ++i) sum += normal({0, i - 1, i});
  const Vec3 axis = sum.normalized();
  return ears_are_large(polygon.size(), kClear, [&](const Triangle& t) { return normal(t).dot(axis); });
}

}  // namespace atlas_refine
