// Triangles over a polygon that no division makes positive throughout: it crosses itself, or was crushed.
#pragma once

#include <optional>
#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

/// What triangles over one polygon cover backwards, in the UV plane and in space, as a fraction of the square of its size.
/// What is thin to rounding counts a little as well. An outline that is nearly a line tells nothing.
class FlippedArea {
 public:
  /// Space is looked at from where most of the polygon is seen from its front, the UV plane too.
  FlippedArea(std::vector<Vec2> uvs, const std::vector<Vec3>& positions);

  int corner_count() const { return static_cast<int>(outlines_[0].size()); }
  double of(const Triangle& triangle) const;
  double of(const std::vector<Triangle>& triangles) const;

  /// Of two triangulations that are alike in it, that with the shorter diagonals is better.
  double length_squared(int a, int b) const;

 private:
  std::vector<Vec2> outlines_[2];  ///< of size 1, in the UV plane and in the polygon's own plane in space
  bool tells_[2];
};

/// Of all triangulations of the polygon the one with the least flipped area. No triangle has two corners of one vertex, no
/// diagonal the vertices of a side. Nothing where there is none, or the polygon has more than 1000 corners.
std::optional<std::vector<Triangle>> least_flipped(const FlippedArea& flipped, const std::vector<int>& vertices);

}  // namespace atlas_refine
