// The contact barrier: finite differences over interior and end-point contacts, and its projection.
#include "solve/contact_barrier.h"

#include <Eigen/Eigenvalues>

#include "finite_differences.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

using testing::expect_close;
using testing::numeric_gradient;
using testing::numeric_hessian;

constexpr double kFloor = 0.05, kRange = 0.4;

ContactDerivatives at(const Eigen::VectorXd& x, bool project) {
  return contact_derivatives(x.head<2>(), x.segment<2>(2), x.tail<2>(), kFloor, kRange, project);
}
Eigen::VectorXd stacked_gradient(const ContactDerivatives& d) {
  Eigen::VectorXd g(6);
  g << d.gradient[0], d.gradient[1], d.gradient[2];
  return g;
}
Eigen::MatrixXd full_hessian(const ContactDerivatives& d) {
  Eigen::MatrixXd h(6, 6);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) h.block<2, 2>(2 * i, 2 * j) = d.hessian[i][j];
  }
  return h;
}

TEST(LogBarrier, StartsSmoothlyAndDiverges) {
  EXPECT_EQ(log_barrier(1.0).value, 0);
  EXPECT_EQ(log_barrier(2.0).curvature, 0);
  EXPECT_NEAR(log_barrier(1 - 1e-6).slope, 0, 1e-10);
  EXPECT_TRUE(std::isinf(log_barrier(0).value));
  EXPECT_TRUE(std::isinf(log_barrier(-1).value));
  EXPECT_GT(log_barrier(1e-12).value, 20);
  const double h = 1e-6;
  for (const double x : {0.05, 0.3, 0.7, 0.95}) {
    EXPECT_NEAR((log_barrier(x + h).value - log_barrier(x - h).value) / (2 * h), log_barrier(x).slope, 1e-6);
    EXPECT_NEAR((log_barrier(x + h).slope - log_barrier(x - h).slope) / (2 * h), log_barrier(x).curvature,
                1e-4 * log_barrier(x).curvature);
  }
}

TEST(ContactBarrier, DerivativesMatchFiniteDifferences) {
  Rng rng(3);
  int interior = 0, ends = 0;
  while (interior < 100 || ends < 100) {
    Eigen::VectorXd x(6);
    for (int k = 0; k < 6; ++k) x[k] = rng.uniform(-0.5, 0.5);
    const Closest closest = closest_on_segment(x.head<2>(), x.segment<2>(2), x.tail<2>());
    if (closest.distance < kFloor + 0.02 || closest.distance > kFloor + 0.95 * kRange) continue;
    if ((x.tail<2>() - x.segment<2>(2)).norm() < 0.1) continue;
    const bool inner = closest.along > 0.01 && closest.along < 0.99;
    if (!inner && closest.along > 0 && closest.along < 1) continue;  // the second derivative jumps at the end points
    ++(inner ? interior : ends);
    const ContactDerivatives d = at(x, false);
    expect_close(stacked_gradient(d), numeric_gradient([](const auto& y) { return at(y, false).value; }, x), 1e-4);
    expect_close(full_hessian(d), numeric_hessian([](const auto& y) { return stacked_gradient(at(y, false)); }, x), 1e-3);
    const Eigen::MatrixXd psd = full_hessian(at(x, true));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(psd);
    EXPECT_GE(spectrum.eigenvalues()[0], -1e-9 * spectrum.eigenvalues()[5]);
    const Eigen::MatrixXd lifted = psd - full_hessian(d);  // the projection only adds
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(lifted).eigenvalues()[0], -1e-9 * spectrum.eigenvalues()[5]);
  }
}

}  // namespace
}  // namespace atlas_refine
