// The triangle energy: finite differences, isometry, and the projection of its Hessian.
#include "solve/symmetric_dirichlet.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "finite_differences.h"
#include "support/rng.h"
#include "triangle_derivatives.h"

namespace atlas_refine {
namespace {

using testing::expect_close;
using testing::numeric_gradient;
using testing::numeric_hessian;

struct Sample {
  RestTriangle rest;
  Eigen::VectorXd x = Eigen::VectorXd(6);
};

/// A random rest triangle and a random positive image of it, mildly to strongly deformed.
Sample random_sample(Rng& rng) {
  Sample s;
  Mat2 rest_edges;
  do {
    for (int k = 0; k < 4; ++k) rest_edges(k / 2, k % 2) = rng.uniform(-1, 1);
  } while (rest_edges.determinant() < 0.1);
  s.rest = {rest_edges.inverse(), 0.5 * rest_edges.determinant()};
  Mat2 edges;
  do {
    for (int k = 0; k < 6; ++k) s.x[k] = rng.uniform(-1, 1);
    edges << s.x.segment<2>(2) - s.x.head<2>(), s.x.tail<2>() - s.x.head<2>();
  } while (edges.determinant() < 0.1);
  return s;
}

TriangleDerivatives derivatives(const Sample& s, const Eigen::VectorXd& x, bool project) {
  return symmetric_dirichlet_derivatives(s.rest.inverse_edges, x.head<2>(), x.segment<2>(2), x.tail<2>(), project);
}

TEST(SymmetricDirichlet, IsOneForRotations) {
  Mat2 rotation;
  rotation << 0.6, -0.8, 0.8, 0.6;
  EXPECT_NEAR(symmetric_dirichlet(rotation), 1.0, 1e-15);
  EXPECT_GT(symmetric_dirichlet(1.1 * rotation), 1.0);
}

TEST(SymmetricDirichlet, IsInfiniteForFlips) {
  Mat2 mirror;
  mirror << 1, 0, 0, -1;
  EXPECT_TRUE(std::isinf(symmetric_dirichlet(mirror)));
  EXPECT_TRUE(std::isinf(symmetric_dirichlet(Mat2::Zero())));
}

TEST(SymmetricDirichlet, DerivativesMatchFiniteDifferences) {
  Rng rng(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Sample s = random_sample(rng);
    const auto energy = [&](const Eigen::VectorXd& x) {
      return symmetric_dirichlet(jacobian(s.rest.inverse_edges, x.head<2>(), x.segment<2>(2), x.tail<2>()));
    };
    const TriangleDerivatives d = derivatives(s, s.x, false);
    EXPECT_NEAR(d.energy, energy(s.x), 1e-12 * d.energy);
    expect_close(testing::stacked_gradient(d), numeric_gradient(energy, s.x), 1e-5);
    expect_close(testing::full_hessian(d),
                 numeric_hessian([&](const auto& x) { return testing::stacked_gradient(derivatives(s, x, false)); }, s.x), 1e-4);
  }
}

TEST(SymmetricDirichlet, ProjectionRemovesNegativeCurvatureAndNothingElse) {
  Rng rng(2);
  int projected = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Sample s = random_sample(rng);
    const Eigen::MatrixXd exact = testing::full_hessian(derivatives(s, s.x, false));
    const Eigen::MatrixXd psd = testing::full_hessian(derivatives(s, s.x, true));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> before(exact), after(psd);
    const double scale = before.eigenvalues().cwiseAbs().maxCoeff();
    EXPECT_GE(after.eigenvalues()[0], -1e-10 * scale);
    if (before.eigenvalues()[0] < -1e-9 * scale)
      ++projected;
    else
      expect_close(exact, psd, 1e-12);
  }
  EXPECT_GT(projected, 50);
}

}  // namespace
}  // namespace atlas_refine
