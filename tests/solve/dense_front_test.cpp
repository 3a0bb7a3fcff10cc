// The kernels of one front against dense algebra, and against each other.
#include "solve/dense_front.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "support/rng.h"

namespace atlas_refine {
namespace {

struct Size {
  int pivots, rows;
};
constexpr Size kSizes[] = {{2, 2}, {2, 4}, {4, 10}, {6, 6}, {8, 30}, {10, 34}, {14, 22}, {130, 200}, {262, 262}, {264, 300}};

Eigen::MatrixXd random_positive(int rows) {
  Rng rng(rows);
  Eigen::MatrixXd a(rows, rows);
  for (int k = 0; k < a.size(); ++k) a(k / rows, k % rows) = rng.uniform(-1, 1);
  return a * a.transpose() + rows * Eigen::MatrixXd::Identity(rows, rows);
}

struct Factored {
  Eigen::MatrixXd panel;
  Eigen::MatrixXd update;
  bool good;

  Front front() { return {panel.data(), static_cast<int>(panel.rows()), static_cast<int>(panel.cols())}; }
};

Factored factored(const FrontKernels& kernels, const Eigen::MatrixXd& matrix, int pivots, int threads = 1) {
  const Eigen::Index below = matrix.rows() - pivots;
  Factored out{matrix.leftCols(pivots), Eigen::MatrixXd::Zero(below, below), false};
  std::vector<double> packed(packed_size(out.front()));
  out.good = kernels.factor(out.front(), {out.update.data(), packed.data(), threads});
  return out;
}

/// The part that counts.
Eigen::MatrixXd lower(const Eigen::MatrixXd& m) { return m.triangularView<Eigen::Lower>(); }

TEST(DenseFront, FactorsLikeADenseMatrix) {
  for (const auto& [pivots, rows] : kSizes) {
    const Eigen::MatrixXd matrix = random_positive(rows);
    Factored front = factored(supported_kernels().front(), matrix, pivots);
    ASSERT_TRUE(front.good);
    Eigen::MatrixXd expected = matrix.llt().matrixL();
    const Eigen::MatrixXd below = expected.bottomLeftCorner(rows - pivots, pivots);
    EXPECT_LT((lower(front.update) + lower(below * below.transpose())).norm(), 1e-11 * matrix.norm());
    for (int k = 0; k < pivots; ++k) front.panel(k, k) = 1 / front.panel(k, k);
    EXPECT_LT((lower(front.panel) - lower(expected.leftCols(pivots))).norm(), 1e-11 * matrix.norm());
  }
}

TEST(DenseFront, EverySetOfInstructionsGivesTheSameBits) {
  for (const auto& [pivots, rows] : kSizes) {
    const Eigen::MatrixXd matrix = random_positive(rows);
    std::vector<Eigen::MatrixXd> first;
    for (const FrontKernels& kernels : supported_kernels()) {
      SCOPED_TRACE(kernels.name);
      Factored front = factored(kernels, matrix, pivots);
      ASSERT_TRUE(front.good);
      Eigen::MatrixXd a = matrix.col(0), b = matrix.col(rows - 1);
      const std::vector<FrontSide> sides = {{a.data(), a.data() + pivots}, {b.data(), b.data() + pivots}};
      kernels.solve_forward(front.front(), sides);
      kernels.solve_backward(front.front(), sides);
      const std::vector<Eigen::MatrixXd> all = {lower(front.panel), lower(front.update), a, b};
      if (first.empty()) first = all;
      for (std::size_t k = 0; k < all.size(); ++k) EXPECT_EQ(all[k], first[k]);
    }
  }
}

TEST(DenseFront, IsDividedIntoTheSameBits) {
  const Eigen::MatrixXd matrix = random_positive(700);
  for (const int pivots : {160, 396, 700}) {
    Factored alone = factored(best_kernels(), matrix, pivots);
    for (const int threads : {2, 8}) {
      Factored divided = factored(best_kernels(), matrix, pivots, threads);
      ASSERT_TRUE(divided.good);
      EXPECT_EQ(lower(divided.panel), lower(alone.panel)) << threads << " threads";
      EXPECT_EQ(lower(divided.update), lower(alone.update)) << threads << " threads";
    }
  }
}

TEST(DenseFront, RefusesAPivotThatIsNotPositive) {
  Eigen::MatrixXd matrix = random_positive(150);
  for (const int bad : {0, 1, 70, 139}) {
    Eigen::MatrixXd broken = matrix;
    broken(bad, bad) = -1;
    for (const FrontKernels& kernels : supported_kernels()) EXPECT_FALSE(factored(kernels, broken, 140).good) << kernels.name;
  }
}

}  // namespace
}  // namespace atlas_refine
