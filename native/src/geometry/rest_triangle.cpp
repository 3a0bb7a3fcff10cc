// The undeformed shape of a triangle, laid flat.
#include "geometry/rest_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace atlas_refine {

namespace {

/// From the flat edges (length, 0) and (along, height).
RestTriangle from_flat_edges(double length, double along, double height) {
  RestTriangle rest;
  rest.inverse_edges << 1 / length, -along / (length * height), 0, 1 / height;
  rest.area = 0.5 * length * height;
  return rest;
}

RestTriangle degenerate() {
  RestTriangle rest;
  rest.inverse_edges.setZero();
  return rest;
}

/// Whether a triangle of this doubled area, on this longest edge, has no usable shape.
bool is_sliver(double doubled_area, double longest) {
  return !(doubled_area > kSliverHeight * longest * longest) || !(doubled_area >= 1e-290);
}

}  // namespace

RestTriangle rest_from_space(const Vec3& p0, const Vec3& p1, const Vec3& p2) {
  const Vec3 e1 = p1 - p0;
  const Vec3 e2 = p2 - p0;
  const double doubled_area = e1.cross(e2).norm();
  const double longest = std::max({e1.norm(), e2.norm(), (p2 - p1).norm()});
  if (is_sliver(doubled_area, longest)) return degenerate();
  const double length = e1.norm();
  return from_flat_edges(length, e1.dot(e2) / length, doubled_area / length);
}

RestTriangle rest_raised(const Vec3& p0, const Vec3& p1, const Vec3& p2, double least_height) {
  const std::array<Vec3, 3> corners = {p0, p1, p2};
  int apex = 0;
  const auto side = [&](int k) -> Vec3 { return corners[(k + 2) % 3] - corners[(k + 1) % 3]; };  // opposite corner k
  for (int k = 1; k < 3; ++k) {
    if (side(k).squaredNorm() > side(apex).squaredNorm()) apex = k;
  }
  const double length = side(apex).norm();
  if (!(length > 0)) return degenerate();
  const Vec3 to_apex = corners[apex] - corners[(apex + 1) % 3];
  const double along = to_apex.dot(side(apex)) / length;
  const double height = std::max(to_apex.cross(side(apex)).norm() / length, least_height * length);
  std::array<Vec2, 3> flat;
  flat[(apex + 1) % 3] = {0, 0};
  flat[(apex + 2) % 3] = {length, 0};
  flat[apex] = {along, height};
  return rest_from_plane(flat[0], flat[1], flat[2], 1);
}

RestTriangle rest_from_plane(const Vec2& p0, const Vec2& p1, const Vec2& p2, double scale) {
  Mat2 edges;
  edges.col(0) = scale * (p1 - p0);
  edges.col(1) = scale * (p2 - p0);
  const double doubled_area = edges.determinant();
  const double longest = std::max({edges.col(0).norm(), edges.col(1).norm(), scale * (p2 - p1).norm()});
  if (is_sliver(doubled_area, longest)) return degenerate();
  RestTriangle rest;
  rest.inverse_edges = edges.inverse();
  rest.area = 0.5 * doubled_area;
  return rest;
}

RestTriangle rest_equilateral(double area) {
  const double length = std::sqrt(4 * area / std::sqrt(3.0));
  return from_flat_edges(length, 0.5 * length, 0.5 * std::sqrt(3.0) * length);
}

RestTriangle rest_from_sides(const std::array<double, 3>& lengths) {
  constexpr double kFlat = 1e-6;  // of the first side, squared: no lower
  const double along = (lengths[0] * lengths[0] + lengths[2] * lengths[2] - lengths[1] * lengths[1]) / (2 * lengths[0]);
  const double height = std::sqrt(std::max(lengths[2] * lengths[2] - along * along, kFlat * lengths[0] * lengths[0]));
  return from_flat_edges(lengths[0], along, height);
}

std::array<double, 3> side_lengths(const RestTriangle& shape) {
  const Mat2 edges = shape.inverse_edges.inverse();
  return {edges.col(0).norm(), (edges.col(1) - edges.col(0)).norm(), edges.col(1).norm()};
}

}  // namespace atlas_refine
