// Closed-form derivatives of the regularised energy; its Hessian is projected by eigenvalues.
#include "solve/foldover.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace atlas_refine {
namespace {

using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;

constexpr double kLeastProgress = 0.1;

Mat4 without_negative_eigenvalues(const Mat4& hessian) {
  const Eigen::SelfAdjointEigenSolver<Mat4> eigen(hessian);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

double regularised_determinant(double determinant, double epsilon) {
  const double root = std::hypot(epsilon, determinant);
  // Where the sum would cancel, the same from the other root of the quadratic.
  return determinant > 0 ? 0.5 * (determinant + root) : 0.5 * epsilon * (epsilon / (root - determinant));
}

double next_epsilon(double epsilon, double least_determinant, double before, double after) {
  const double progress = std::max(kLeastProgress, 1 - after / before);
  const double level = (1 - progress) * regularised_determinant(least_determinant, epsilon);
  if (least_determinant >= level) return kLeastEpsilon;
  return std::max(kLeastEpsilon, 2 * std::sqrt(level * (level - least_determinant)));
}

double foldover_energy(const Mat2& j, double epsilon) {
  const double d = j(0, 0) * j(1, 1) - j(0, 1) * j(1, 0);
  return 0.25 * (j.squaredNorm() + d * d + 1) / regularised_determinant(d, epsilon);
}

TriangleDerivatives foldover_derivatives(const Mat2& inverse_edges, const Vec2& p0, const Vec2& p1, const Vec2& p2,
                                         double epsilon, bool project) {
  const Mat2 jac = jacobian(inverse_edges, p0, p1, p2);
  const Vec4 j(jac(0, 0), jac(1, 0), jac(0, 1), jac(1, 1));
  const Vec4 cofactor(j[3], -j[2], -j[1], j[0]);
  const double d = j[0] * j[3] - j[1] * j[2];
  const double q = j.squaredNorm() + d * d + 1;
  const double root = std::hypot(epsilon, d);  // chi' = chi / root
  const double quarter = 0.25 / regularised_determinant(d, epsilon);
  // As a function of |J|^2 and D: the derivative by D, and the second ones.
  const double by_d = quarter * (2 * d - q / root);
  const double mixed = -quarter / root;
  const double by_dd = quarter * (2 - 4 * d / root + (q + q * d / root) / (root * root));
  Mat4 hessian = 2 * quarter * Mat4::Identity() + by_dd * (cofactor * cofactor.transpose());
  hessian += 2 * mixed * (j * cofactor.transpose() + cofactor * j.transpose());
  hessian(0, 3) += by_d;
  hessian(3, 0) += by_d;
  hessian(1, 2) -= by_d;
  hessian(2, 1) -= by_d;
  if (project) hessian = without_negative_eigenvalues(hessian);
  return on_vertices(inverse_edges, quarter * q, 2 * quarter * j + by_d * cofactor, hessian);
}

}  // namespace atlas_refine
