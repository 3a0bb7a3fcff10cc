// Closed-form derivatives of the symmetric Dirichlet energy.
#include "solve/symmetric_dirichlet.h"

#include <cmath>

namespace atlas_refine {
namespace {

using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;

/// Hessian of 1/4 n (1 + 1 / D^2), n = |J|^2, D = det J, in vec(J) (columns stacked).
Mat4 jacobian_hessian(const Vec4& j, const Vec4& cofactor, double n, double d) {
  Mat4 det_hessian = Mat4::Zero();
  det_hessian(0, 3) = det_hessian(3, 0) = 1;
  det_hessian(1, 2) = det_hessian(2, 1) = -1;
  const double d2 = d * d;
  const double d3 = d2 * d;
  const Mat4 mixed = j * cofactor.transpose();
  return 0.5 * (1 + 1 / d2) * Mat4::Identity() - (mixed + mixed.transpose()) / d3 - (0.5 * n / d3) * det_hessian +
         (1.5 * n / (d2 * d2)) * (cofactor * cofactor.transpose());
}

/// Adds what lifts the twist eigenvalue 1/2 (1 - (s1^2 - s1 s2 + s2^2) / (s1 s2)^3) to zero where it is negative.
void clamp_twist(const Mat2& j, double n, double d, Mat4& hessian) {
  const double eigenvalue = 0.5 * (1 - (n - d) / (d * d * d));
  if (eigenvalue >= 0) return;
  const double trace = j(0, 0) + j(1, 1);
  const double skew = j(1, 0) - j(0, 1);
  const Vec4 twist = Vec4(-skew, trace, -trace, -skew) / std::sqrt(2 * (trace * trace + skew * skew));
  hessian -= eigenvalue * (twist * twist.transpose());
}

}  // namespace

TriangleDerivatives on_vertices(const Mat2& inverse_edges, double energy, const Vec4& g, const Mat4& h) {
  // J = sum_k u_k w_k^T with w_1, w_2 the rows of the inverse rest edges and w_0 = -(w_1 + w_2).
  const Eigen::RowVector2d w1 = inverse_edges.row(0);
  const Eigen::RowVector2d w2 = inverse_edges.row(1);
  const auto contract = [&](const Eigen::RowVector2d& a, const Eigen::RowVector2d& b) -> Mat2 {
    return a[0] * (b[0] * h.block<2, 2>(0, 0) + b[1] * h.block<2, 2>(0, 2)) +
           a[1] * (b[0] * h.block<2, 2>(2, 0) + b[1] * h.block<2, 2>(2, 2));
  };
  TriangleDerivatives out;
  out.energy = energy;
  out.gradient[1] = w1[0] * g.head<2>() + w1[1] * g.tail<2>();
  out.gradient[2] = w2[0] * g.head<2>() + w2[1] * g.tail<2>();
  out.gradient[0] = -(out.gradient[1] + out.gradient[2]);
  const Mat2 h11 = contract(w1, w1);
  const Mat2 h12 = contract(w1, w2);
  const Mat2 h22 = contract(w2, w2);
  // Rows and columns sum to zero: translations cost nothing.
  const Mat2 h01 = -(h11 + h12.transpose());
  const Mat2 h20 = -(h12.transpose() + h22);
  out.diagonal = {Mat2(-(h01.transpose() + h20)), h11, h22};
  out.off_diagonal = {h01, h12, h20};
  return out;
}

TriangleDerivatives symmetric_dirichlet_derivatives(const Mat2& inverse_edges, const Vec2& p0, const Vec2& p1, const Vec2& p2,
                                                    bool project) {
  const Mat2 jac = jacobian(inverse_edges, p0, p1, p2);
  const Vec4 j(jac(0, 0), jac(1, 0), jac(0, 1), jac(1, 1));
  const Vec4 cofactor(j[3], -j[2], -j[1], j[0]);
  const double n = j.squaredNorm();
  const double d = j[0] * j[3] - j[1] * j[2];
  const Vec4 g = 0.5 * (1 + 1 / (d * d)) * j - (0.5 * n / (d * d * d)) * cofactor;
  Mat4 h = jacobian_hessian(j, cofactor, n, d);
  if (project) clamp_twist(jac, n, d, h);
  return on_vertices(inverse_edges, 0.25 * n * (1 + 1 / (d * d)), g, h);
}

}  // namespace atlas_refine
