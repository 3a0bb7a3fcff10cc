// Derivatives of the contact barrier, the Hessian projected in the three directions that carry it.
#include "solve/contact_barrier.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace atlas_refine {
namespace {

using Mat3 = Eigen::Matrix3d;

void positive_part(Mat3& matrix) {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(matrix);
  if (eigen.eigenvalues()[0] >= 0) return;
  matrix = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * eigen.eigenvectors().transpose();
}

/// The distance to an end point: only the direction of approach carries stiffness, the rest of the Hessian is negative.
void add_end_point(ContactDerivatives& out, const Closest& closest, double curvature, bool project) {
  const Vec2 n = closest.offset / closest.distance;
  const int end = closest.along == 0 ? 1 : 2;
  out.gradient[0] = out.slope * n;
  out.gradient[end] = -out.gradient[0];
  Mat2 h = curvature * n * n.transpose();
  if (!project) h += (out.slope / closest.distance) * (Mat2::Identity() - n * n.transpose());
  out.hessian[0][0] = out.hessian[end][end] = h;
  out.hessian[0][end] = out.hessian[end][0] = -h;
}

/// The distance to the edge's line. With relative motion r = dp - (1 - s) da - s db, rotation rate w = n.(db - da) / L:
/// first variation z = n.r, second variation -2 w (t.r) - d w^2.
void add_interior(ContactDerivatives& out, const Closest& closest, const Vec2& edge, double curvature, bool project) {
  const double length = edge.norm();
  const Vec2 n = closest.offset / closest.distance;
  const Vec2 t = edge / length;
  const std::array<double, 3> share = {1, -(1 - closest.along), -closest.along};
  const std::array<double, 3> turn = {0, -1 / length, 1 / length};
  // Orthonormal coordinates of the three forms: z and w along n, t.r along t, which is orthogonal to both.
  const double norm_z = std::sqrt(share[0] * share[0] + share[1] * share[1] + share[2] * share[2]);
  double w_on_z = 0;
  for (int k = 0; k < 3; ++k) w_on_z += share[k] * turn[k] / norm_z;
  std::array<double, 3> rest;
  double norm_rest = 0;
  for (int k = 0; k < 3; ++k) {
    rest[k] = turn[k] - w_on_z * share[k] / norm_z;
    norm_rest += rest[k] * rest[k];
  }
  norm_rest = std::sqrt(norm_rest);
  const Eigen::Vector3d z(norm_z, 0, 0), w(w_on_z, norm_rest, 0), y(0, 0, norm_z);
  Mat3 form =
      curvature * z * z.transpose() - out.slope * (closest.distance * w * w.transpose() + w * y.transpose() + y * w.transpose());
  if (project) positive_part(form);
  // Rows: the three orthonormal forms as functions of the motion of vertex k.
  std::array<Eigen::Matrix<double, 3, 2>, 3> basis;
  for (int k = 0; k < 3; ++k) {
    basis[k].row(0) = share[k] / norm_z * n.transpose();
    basis[k].row(1) = rest[k] / norm_rest * n.transpose();
    basis[k].row(2) = share[k] / norm_z * t.transpose();
    out.gradient[k] = out.slope * share[k] * n;
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out.hessian[i][j] = basis[i].transpose() * form * basis[j];
  }
}

}  // namespace

BarrierValue log_barrier(double x) {
  if (x >= 1) return {};
  if (!(x > 0)) return {std::numeric_limits<double>::infinity(), 0, 0};
  const double u = x - 1;
  const double l = std::log(x);
  return {-u * u * l, -2 * u * l - u * u / x, -2 * l - 4 * u / x + u * u / (x * x)};
}

void ContactDerivatives::scale(double factor) {
  value *= factor;
  slope *= factor;
  for (Vec2& part : gradient) part *= factor;
  for (auto& row : hessian) {
    for (Mat2& part : row) part *= factor;
  }
}

ContactDerivatives contact_derivatives(const Vec2& point, const Vec2& edge_start, const Vec2& edge_end, double floor,
                                       double range, bool project) {
  ContactDerivatives out;
  out.gradient.fill(Vec2::Zero());
  for (auto& row : out.hessian) row.fill(Mat2::Zero());
  const Closest closest = closest_on_segment(point, edge_start, edge_end);
  const BarrierValue b = log_barrier((closest.distance - floor) / range);
  out.value = b.value;
  if (b.value == 0) return out;
  out.slope = b.slope / range;
  const double curvature = b.curvature / (range * range);
  if (closest.along == 0 || closest.along == 1)
    add_end_point(out, closest, curvature, project);
  else
    add_interior(out, closest, edge_end - edge_start, curvature, project);
  return out;
}

}  // namespace atlas_refine
