// Where points lie in a triangulation of the plane.
#pragma once

#include <array>
#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

/// A point of a triangle: the mean of its corners with these weights, which add up to 1.
struct Place {
  int triangle = -1;
  std::array<double, 3> weights = {};
};

/// Finds points by walking from triangle to triangle. Holds references.
class Locator {
 public:
  Locator(const std::vector<Vec2>& points, const std::vector<Triangle>& triangles);

  /// The triangle that holds `point`, or the nearest one by weights; found sooner where triangle `near` is near.
  Place locate(const Vec2& point, int near) const;

  /// Per triangle those across its edges (1, 2), (2, 0), (0, 1), -1 = none.
  const std::vector<std::array<int, 3>>& neighbours() const { return neighbours_; }

 private:
  Place place_in(int triangle, const Vec2& point) const;

  const std::vector<Vec2>& points_;
  const std::vector<Triangle>& triangles_;
  std::vector<std::array<int, 3>> neighbours_;
};

}  // namespace atlas_refine
