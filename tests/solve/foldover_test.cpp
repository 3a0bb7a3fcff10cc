// The regularised energy: finite for flips, its derivatives, the projection of its Hessian, and how eps falls.
#include "solve/foldover.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "finite_differences.h"
#include "support/rng.h"
#include "triangle_derivatives.h"

namespace atlas_refine {
namespace {

struct Sample {
  Mat2 inverse_edges;
  Eigen::VectorXd x = Eigen::VectorXd(6);
};

/// A random triangle, flipped as often as not.
Sample random_sample(Rng& rng) {
  Sample out;
  Mat2 edges;
  do {
    for (int k = 0; k < 4; ++k) edges(k / 2, k % 2) = rng.uniform(-1, 1);
  } while (edges.determinant() < 0.1);
  out.inverse_edges = edges.inverse();
  for (int k = 0; k < 6; ++k) out.x[k] = rng.uniform(-1, 1);
  return out;
}

TriangleDerivatives derivatives(const Sample& s, const Eigen::VectorXd& x, double epsilon, bool project) {
  return foldover_derivatives(s.inverse_edges, x.head<2>(), x.segment<2>(2), x.tail<2>(), epsilon, project);
}

TEST(Foldover, DerivativesMatchDifferencesAlsoWhereFlipped) {
  Rng rng(7);
  int flipped = 0;
  for (int k = 0; k < 60; ++k) {
    const Sample s = random_sample(rng);
    const double epsilon = k % 2 == 0 ? 1 : 0.3;
    const auto energy = [&](const Eigen::VectorXd& x) { return derivatives(s, x, epsilon, false).energy; };
    const auto slope = [&](const Eigen::VectorXd& x) { return testing::stacked_gradient(derivatives(s, x, epsilon, false)); };
    testing::expect_close(slope(s.x), testing::numeric_gradient(energy, s.x), 1e-5);
    testing::expect_close(testing::full_hessian(derivatives(s, s.x, epsilon, false)), testing::numeric_hessian(slope, s.x), 1e-5);
    const Mat2 j = jacobian(s.inverse_edges, s.x.head<2>(), s.x.segment<2>(2), s.x.tail<2>());
    EXPECT_NEAR(energy(s.x), foldover_energy(j, epsilon), 1e-12 * energy(s.x));
    flipped += j.determinant() < 0;
  }
  EXPECT_GT(flipped, 10);
}

TEST(Foldover, ProjectedHessianIsPositiveSemidefinite) {
  Rng rng(3);
  for (int k = 0; k < 60; ++k) {
    const Sample s = random_sample(rng);
    const Eigen::MatrixXd h = testing::full_hessian(derivatives(s, s.x, 0.2, true));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(h);
    EXPECT_GE(eigen.eigenvalues().minCoeff(), -1e-9 * eigen.eigenvalues().maxCoeff());
  }
}

TEST(Foldover, IsOneForRotationsAndGrowsWithDistortion) {
  Mat2 rotation;
  rotation << 0.6, -0.8, 0.8, 0.6;
  EXPECT_NEAR(foldover_energy(rotation, 0), 1, 1e-15);
  EXPECT_GT(foldover_energy(1.2 * rotation, 0), 1.001);
  EXPECT_GT(foldover_energy(rotation * Vec2(2, 0.5).asDiagonal(), 0), 1.5);
}

TEST(Foldover, RegularisedDeterminantIsPositiveToTheLastBit) {
  EXPECT_GT(regularised_determinant(-1e8, 1e-10), 0);
  EXPECT_NEAR(regularised_determinant(-2, 1), 0.5 * (-2 + std::sqrt(5.0)), 1e-15);
  EXPECT_EQ(regularised_determinant(3, 0), 3);
}

TEST(Foldover, EpsilonFallsWhileFlipsRemainAndThenVanishes) {
  double epsilon = 1;
  for (int k = 0; k < 20; ++k) {
    const double next = next_epsilon(epsilon, -0.5, 1, 0.99);
    EXPECT_LT(next, epsilon);
    EXPECT_GT(next, 0);
    epsilon = next;
  }
  EXPECT_LE(next_epsilon(0.1, 0.5, 1, 0.5), 1e-9);
}

}  // namespace
}  // namespace atlas_refine
