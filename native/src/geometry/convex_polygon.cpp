// Ears of polygons.
#include "geometry/convex_polygon.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "geometry/plane.h"
#include "geometry/predicates.h"

namespace atlas_refine {
namespace {

constexpr double kSmallestShare = 0.05;  // of the ear of a regular polygon

/// Area of an ear of a regular polygon / area of the polygon, times the smallest share.
double least_ear(std::size_t corners) {
  const double sine = std::sin(std::numbers::pi / static_cast<double>(corners));
  return kSmallestShare * 4 * sine * sine / static_cast<double>(corners);
}

/// `ear` gives the doubled area of a triangle of corners.
template <class Ear>
bool ears_are_large(std::size_t corners, Ear&& ear) {
  double doubled = 0;
  for (std::size_t i = 2; i < corners; ++i) doubled += ear({0, static_cast<int>(i) - 1, static_cast<int>(i)});
  if (!(doubled > 0)) return false;
  for (std::size_t i = 0; i < corners; ++i) {
    const Triangle triangle = corner_triangle(static_cast<int>(i), static_cast<int>(corners));
    if (!(ear(triangle) >= least_ear(corners) * doubled)) return false;
  }
  return true;
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

bool is_clearly_convex(std::span<const Vec2> polygon) {
  if (!is_strictly_convex(polygon)) return false;
  return ears_are_large(polygon.size(),
                        [&](const Triangle& t) { return doubled_area(polygon[t[0]], polygon[t[1]], polygon[t[2]]); });
}

bool is_clearly_convex(std::span<const Vec3> polygon) {
  const auto normal = [&](const Triangle& t) -> Vec3 {
    return (polygon[t[1]] - polygon[t[0]]).cross(polygon[t[2]] - polygon[t[0]]);
  };
  Vec3 sum = Vec3::Zero();
  for (int i = 2; i < static_cast<int>(polygon.size()); ++i) sum += normal({0, i - 1, i});
  const Vec3 axis = sum.normalized();
  return ears_are_large(polygon.size(), [&](const Triangle& t) { return normal(t).dot(axis); });
}

}  // namespace atlas_refine
