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

/// Of the Jacobian: that of its triangle's second and third vertex where these are the unit vectors.
Eigen::Matrix4d jacobian_hessian(const Mat2& j, double epsilon, bool project) {
  return testing::full_hessian(foldover_derivatives(Mat2::Identity(), Vec2::Zero(), j.col(0), j.col(1), epsilon, project))
      .bottomRightCorner<4, 4>();
}

TEST(Foldover, ProjectionLiftsNegativeEigenvaluesAndNothingElse) {
  Rng rng(5);
  std::vector<Mat2> samples = {Mat2::Identity(), Mat2::Zero(), Vec2(1, -1).asDiagonal(), Vec2(3, 0).asDiagonal()};
  for (int k = 0; k < 60; ++k) samples.push_back(Mat2::NullaryExpr([&] { return rng.uniform(-2, 2); }));
  for (const Mat2& j : samples) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(jacobian_hessian(j, 0.2, false));
    const Eigen::Matrix4d wanted =
        eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() * eigen.eigenvectors().transpose();
    EXPECT_LT((jacobian_hessian(j, 0.2, true) - wanted).norm(), 1e-12 * wanted.norm());
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

TEST(Foldover, WhatGrowsAsEpsilonFallsStaysFolded) {
  const auto steps = [](double first, double power, int count) {
    std::vector<FoldoverLevel> out;
    for (int k = 0; k < count; ++k) out.push_back({first * std::pow(0.9, -power * k), std::pow(0.9, k)});
    return out;
  };
  EXPECT_TRUE(stay_folded(steps(100, 1, 11)));
  EXPECT_FALSE(stay_folded(steps(100, 1, 10)));    // too soon to tell
  EXPECT_FALSE(stay_folded(steps(100, 0.5, 40)));  // it slows down: they unfold
  EXPECT_FALSE(stay_folded(steps(0.5, 1, 11)));    // a small part of all
}

}  // namespace
}  // namespace atlas_refine
