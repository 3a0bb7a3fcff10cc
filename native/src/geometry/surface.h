// The undeformed surface of one chart: what limits and measures are taken on.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace atlas_refine {

using Mat2 = Eigen::Matrix2d;

/// The undeformed shape of one triangle: the 3D triangle laid flat, in model units.
struct RestTriangle {
  Mat2 inverse_edges;  ///< inverse of the 2x2 matrix whose columns are the flat edges p1 - p0 and p2 - p0
  double area = 0;     ///< > 0
};

/// The true shapes of a chart's triangles, in their order. Immutable: never weighted, never scaled, and shared by all copies, for
/// stages copy charts whose UVs alone differ. What distortion is reduced against is an Objective (solve/objective.h), which may
/// weight and scale; E_d is measured here.
class Surface {
 public:
  Surface() = default;
  explicit Surface(std::vector<RestTriangle> triangles)
      : triangles_(std::make_shared<const std::vector<RestTriangle>>(std::move(triangles))) {}

  std::size_t size() const { return all().size(); }
  const RestTriangle& operator[](std::size_t triangle) const { return (*triangles_)[triangle]; }
  auto begin() const { return all().begin(); }
  auto end() const { return all().end(); }

  double area() const {
    double sum = 0;
    for (const RestTriangle& triangle : all()) sum += triangle.area;
    return sum;
  }

 private:
  std::span<const RestTriangle> all() const { return triangles_ ? std::span(*triangles_) : std::span<const RestTriangle>(); }

  std::shared_ptr<const std::vector<RestTriangle>> triangles_;
};

}  // namespace atlas_refine
