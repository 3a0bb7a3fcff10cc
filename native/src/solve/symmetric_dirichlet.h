// Symmetric Dirichlet energy of one triangle, eq. (9), with its gradient and positive semidefinite Hessian.
#pragma once

#include <array>
#include <limits>

#include "geometry/chart.h"

namespace atlas_refine {

/// Jacobian of the map rest triangle -> UV triangle; `inverse_edges` as in RestTriangle.
inline Mat2 jacobian(const Mat2& inverse_edges, const Vec2& p0, const Vec2& p1, const Vec2& p2) {
  Mat2 edges;
  edges << p1 - p0, p2 - p0;
  return edges * inverse_edges;
}

/// 1/4 (|J|^2 + |J^-1|^2), infinite where det J <= 0. 1 where J is a rotation.
inline double symmetric_dirichlet(const Mat2& j) {
  const double determinant = j(0, 0) * j(1, 1) - j(0, 1) * j(1, 0);
  if (!(determinant > 0)) return std::numeric_limits<double>::infinity();
  return 0.25 * j.squaredNorm() * (1 + 1 / (determinant * determinant));
}

/// Derivatives with respect to the three vertices: blocks (row vertex, column vertex) for 00 11 22 01 12 20.
struct TriangleDerivatives {
  double energy = 0;
  std::array<Vec2, 3> gradient;
  std::array<Mat2, 3> diagonal;
  std::array<Mat2, 3> off_diagonal;  ///< (0,1), (1,2), (2,0)
};

/// Derivatives with respect to the vertices of an energy of J = jacobian(...), from its gradient and Hessian in vec(J) (columns
/// stacked).
TriangleDerivatives on_vertices(const Mat2& inverse_edges, double energy, const Eigen::Vector4d& gradient,
                                const Eigen::Matrix4d& hessian);

/// Energy, gradient and projected Hessian for a triangle of weight 1. Only the twist eigenvalue can be negative; it alone
/// is clamped to zero, so away from strong compression this is the exact Hessian. det J must be positive.
TriangleDerivatives symmetric_dirichlet_derivatives(const Mat2& inverse_edges, const Vec2& p0, const Vec2& p1, const Vec2& p2,
                                                    bool project = true);

}  // namespace atlas_refine
