// CGAL's convex hull on its filtered kernel Epick.
#include "geometry/convex_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>

#include <iterator>

namespace atlas_refine {

std::vector<Vec2> convex_hull(const std::vector<Vec2>& points) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;
  std::vector<Point> input, hull;
  input.reserve(points.size());
  for (const Vec2& p : points) input.emplace_back(p.x(), p.y());
  CGAL::convex_hull_2(input.begin(), input.end(), std::back_inserter(hull));
  std::vector<Vec2> corners;
  for (const Point& p : hull) corners.emplace_back(p.x(), p.y());
  return corners;
}

}  // namespace atlas_refine
