// Distortion of charts against the surface: E_d (eq. 9), E_2, stretch.
#pragma once

#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

/// Area-weighted sums over triangles: E_d of the UVs scaled by t is (t^2 * dirichlet + inverse / t^2) / (4 * area).
struct DirichletSums {
  double dirichlet = 0;  ///< sum of area * |J|_F^2
  double inverse = 0;    ///< sum of area * |J^-1|_F^2
  double area = 0;

  DirichletSums& operator+=(const DirichletSums& other);
  double best_scale() const;   ///< t that minimises the energy
  double best_energy() const;  ///< the energy at that t
};

/// Over triangles and guards. Those without UV area, whose energy is infinite, are left out.
DirichletSums dirichlet_sums(const Chart& chart);
DirichletSums dirichlet_sums(const std::vector<Chart>& charts);
/// The same of flat arrays: one rest shape per triangle.
DirichletSums dirichlet_sums(const std::vector<RestTriangle>& rest, const std::vector<Triangle>& triangles,
                             const std::vector<Vec2>& uvs);
/// From the UVs of `from` to those of `to`: best_energy() is E_2. The charts must have the same triangles; the guards are those
/// of `to`.
DirichletSums dirichlet_sums_between(const std::vector<Chart>& from, const std::vector<Chart>& to);

/// max(s1, 1 / s2) of the Jacobian (rest -> UV) times `scale`.
double triangle_stretch(const RestTriangle& rest, const Triangle& triangle, const std::vector<Vec2>& uvs, double scale);
/// The same of every triangle.
std::vector<double> triangle_stretch(const Chart& chart, double scale);

/// Stretch of one triangle, and its area on the surface.
struct StretchedArea {
  double stretch, area;
};
/// What 99 % of the area is stretched by at most: the area-weighted percentile.
double stretch_99(std::vector<StretchedArea> all);
double stretch_99(const std::vector<Chart>& charts, double scale);

/// What charts may be distorted by; 0 = no limit.
struct DistortionLimits {
  double distortion = 0;  ///< E_d
  double stretch = 0;     ///< stretch_99()

  bool any() const { return distortion > 0 || stretch > 0; }
  /// The largest of both as a part of its limit: above 1 one is exceeded; 0 without limits.
  double used(double distortion_is, double stretch_is) const;
  double used_by(const std::vector<Chart>& charts) const;
};

/// area * (E_d - 1) of every triangle, its UVs times `scale`.
std::vector<double> triangle_losses(const Chart& chart, double scale);

/// Sum of UV triangle areas.
double uv_area(const Chart& chart);
double uv_area(const std::vector<Chart>& charts);
/// sqrt(UV area / surface area), of all charts together.
double texel_density(const Chart& chart);
double texel_density(const std::vector<Chart>& charts);
/// Sum of the lengths of all boundary edges.
double uv_perimeter(const std::vector<Chart>& charts);

Box uv_box(const std::vector<Chart>& charts);
Box box_of_points(const std::vector<Vec2>& points);
/// The smallest box of `aspect` (width / height) that holds `box`, same min corner; `box` itself where aspect is 0.
Box box_of_aspect(const Box& box, double aspect);
/// Sides of the box of this area and aspect; a square where aspect is 0.
Vec2 sides_of_area(double area, double aspect);

}  // namespace atlas_refine
