// Directions of a chart's boundary edges as polar angles without a 2 pi ambiguity (section 3.1, eq. 1, 3, 4, 5).
#pragma once

#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

/// The outer boundary of a disk-shaped chart: edge i runs from vertices[i] to vertices[i + 1], the chart on its left.
struct BoundaryAngles {
  std::vector<int> vertices;
  std::vector<double> lengths;  ///< of each edge, UV units
  std::vector<double>
      angle_rad;  ///< polar angle of each edge; the turn from the last edge on to the first is counted beyond 2 pi

  int size() const { return static_cast<int>(vertices.size()); }
  double perimeter() const;
};

/// Eq. (1): polar angles by recurrence from the interior angles, which are sums of triangle angles; 2 pi after one turn.
BoundaryAngles polar_angles(const Chart& disk);

/// Eq. (3) and (4): angles after at most five rounds of Gaussian smoothing of the directions; `sigma` as a length along the
/// boundary.
std::vector<double> smoothed_angles(const BoundaryAngles& boundary, double sigma);

/// Eq. (5): the rotation in (-pi/4, pi/4] that makes directions most axis-aligned.
/// Differs from eq. (5)'s L-BFGS: x^2 y^2 = (1 - cos 4a) / 8, so the minimum has a closed form.
double aligning_rotation(const std::vector<double>& lengths, const std::vector<double>& angle_rad);

}  // namespace atlas_refine
