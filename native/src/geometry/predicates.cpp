// Exact geometric predicates, a thin wrapper over CGAL's filtered kernel Epick.
#include "geometry/predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>

namespace atlas_refine {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

bool intervals_overlap(double a, double b, double c, double d) {
  return std::max(std::min(a, b), std::min(c, d)) <= std::min(std::max(a, b), std::max(c, d));
}

}  // namespace

int orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  return static_cast<int>(
      CGAL::orientation(Kernel::Point_2(a.x(), a.y()), Kernel::Point_2(b.x(), b.y()), Kernel::Point_2(c.x(), c.y())));
}

bool segments_touch(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  if (!intervals_overlap(a.x(), b.x(), c.x(), d.x()) || !intervals_overlap(a.y(), b.y(), c.y(), d.y())) return false;
  // Neither segment lies strictly on one side of the other's line. Where all four signs are zero, the segments are collinear,
  // and the overlap of their boxes has decided already.
  return orientation(a, b, c) * orientation(a, b, d) <= 0 && orientation(c, d, a) * orientation(c, d, b) <= 0;
}

}  // namespace atlas_refine
