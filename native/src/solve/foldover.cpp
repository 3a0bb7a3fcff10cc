// Closed-form derivatives of the regularised energy, and of its Hessian's eigenvalues.
#include "solve/foldover.h"

#include <algorithm>
#include <cmath>

namespace atlas_refine {
namespace {

using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;

constexpr double kLeastProgress = 0.1;

/// As a function of n = |J|^2 and D = det J, linear in n: the derivatives by n, by D, by both and by D twice.
struct InvariantDerivatives {
  double by_n, by_d, mixed, by_dd;
};

Vec4 direction(const Vec4& v, const Vec4& otherwise) {
  const double length = v.norm();
  return length > 0 ? Vec4(v / length) : otherwise;
}

void lift(double eigenvalue, const Vec4& direction, Mat4& hessian) {
  if (eigenvalue < 0) hessian -= eigenvalue * (direction * direction.transpose());
}

/// Lifts negative eigenvalues to zero. J is the sum of a similarity and a mirrored one. Turning either, which is its twist or
/// flip (Smith et al. 2019, "Analytic eigensystems for isotropic distortion energies"), is an eigenvector; scaling the two spans
/// the other two.
void lift_negative_eigenvalues(const Vec4& j, const InvariantDerivatives& f, Mat4& hessian) {
  const Vec4 similarity = 0.5 * Vec4(j[0] + j[3], j[1] - j[2], j[2] - j[1], j[0] + j[3]);
  const Vec4 same = direction(similarity, Vec4(1, 0, 0, 1) / std::sqrt(2.0));
  const Vec4 mirrored = direction(j - similarity, Vec4(1, 0, 0, -1) / std::sqrt(2.0));
  lift(2 * f.by_n + f.by_d, Vec4(-same[1], same[0], -same[3], same[2]), hessian);
  lift(2 * f.by_n - f.by_d, Vec4(-mirrored[1], mirrored[0], -mirrored[3], mirrored[2]), hessian);
  const double a = same.dot(j), b = mirrored.dot(j);
  const double first = 2 * f.by_n + f.by_d + (f.by_dd + 4 * f.mixed) * a * a;
  const double last = 2 * f.by_n - f.by_d + (f.by_dd - 4 * f.mixed) * b * b;
  const double between = -f.by_dd * a * b;
  const double half = 0.5 * (first - last), mean = 0.5 * (first + last);
  const double angle = 0.5 * std::atan2(between, half), spread = std::hypot(half, between);
  lift(mean + spread, std::cos(angle) * same + std::sin(angle) * mirrored, hessian);
  lift(mean - spread, std::cos(angle) * mirrored - std::sin(angle) * same, hessian);
}

}  // namespace

double regularised_determinant(double determinant, double epsilon) {
  const double root = std::sqrt(epsilon * epsilon + determinant * determinant);
  // Where the sum would cancel, the same from the other root of the quadratic.
  return determinant > 0 ? 0.5 * (determinant + root) : 0.5 * epsilon * (epsilon / (root - determinant));
}

double next_epsilon(double epsilon, double least_determinant, double before, double after) {
  const double progress = std::max(kLeastProgress, 1 - after / before);
  const double level = (1 - progress) * regularised_determinant(least_determinant, epsilon);
  if (least_determinant >= level) return kLeastEpsilon;
  return std::max(kLeastEpsilon, 2 * std::sqrt(level * (level - least_determinant)));
}

bool stay_folded(const std::vector<FoldoverLevel>& steps) {
  // As they are, flipped triangles make the energy grow as 1 / eps or faster. One that unfolds may do so for a while.
  constexpr std::size_t kSteps = 10;
  constexpr double kLarge = 10;
  constexpr double kGrowth = 0.75;  // power of 1 / eps
  if (steps.size() <= kSteps) return false;
  const FoldoverLevel &now = steps.back(), &then = steps[steps.size() - 1 - kSteps];
  return now.epsilon < then.epsilon && now.energy > kLarge &&
         now.energy > then.energy * std::pow(then.epsilon / now.epsilon, kGrowth);
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
  const double root = std::sqrt(epsilon * epsilon + d * d);  // chi' = chi / root
  const double quarter = 0.25 / regularised_determinant(d, epsilon);
  const InvariantDerivatives f{.by_n = quarter,
                               .by_d = quarter * (2 * d - q / root),
                               .mixed = -quarter / root,
                               .by_dd = quarter * (2 - 4 * d / root + (q + q * d / root) / (root * root))};
  Mat4 hessian = 2 * f.by_n * Mat4::Identity() + f.by_dd * (cofactor * cofactor.transpose());
  hessian += 2 * f.mixed * (j * cofactor.transpose() + cofactor * j.transpose());
  hessian(0, 3) += f.by_d;
  hessian(3, 0) += f.by_d;
  hessian(1, 2) -= f.by_d;
  hessian(2, 1) -= f.by_d;
  if (project) lift_negative_eigenvalues(j, f, hessian);
  return on_vertices(inverse_edges, quarter * q, 2 * f.by_n * j + f.by_d * cofactor, hessian);
}

}  // namespace atlas_refine
