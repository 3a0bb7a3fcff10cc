// The block factorisation against a dense solve.
#include "solve/block_ldlt.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "support/rng.h"

namespace atlas_refine {
namespace {

struct Random {
  BlockLdlt sparse;
  Eigen::MatrixXd dense;
};

/// A diagonally dominant random block matrix with about four edges a node.
Random random_matrix(int n, std::uint64_t seed, int last_node) {
  Rng rng(seed);
  std::vector<std::pair<int, int>> edges;
  for (int k = 0; k < 2 * n; ++k) {
    const int i = rng.below(n), j = rng.below(n);
    if (i != j) edges.emplace_back(i, j);
  }
  Random m;
  m.sparse.analyse(n, edges, last_node);
  m.dense = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  const auto block = [&] {
    Mat2 b;
    for (int k = 0; k < 4; ++k) b(k / 2, k % 2) = rng.uniform(-1, 1);
    return b;
  };
  for (int i = 0; i < n; ++i) {
    const Mat2 b = block();
    m.sparse.diagonal[i] = b * b.transpose() + 30 * Mat2::Identity();
    m.dense.block<2, 2>(2 * i, 2 * i) = m.sparse.diagonal[i];
    for (int j = i + 1; j < n; ++j) {
      const int slot = m.sparse.slot(i, j);
      EXPECT_EQ(slot, m.sparse.slot(j, i));
      if (slot < 0) continue;
      m.sparse.off_diagonal[slot] = block();
      m.dense.block<2, 2>(2 * i, 2 * j) = m.sparse.off_diagonal[slot];
      m.dense.block<2, 2>(2 * j, 2 * i) = m.sparse.off_diagonal[slot].transpose();
    }
  }
  return m;
}

TEST(BlockLdlt, SolvesLikeADenseMatrix) {
  for (const int n : {1, 2, 7, 60, 150}) {
    for (const int last : {-1, 0}) {
      Random m = random_matrix(n, 10 + n, last);
      ASSERT_TRUE(m.sparse.factor());
      ASSERT_TRUE(m.sparse.factor()) << "a second factorisation of the same pattern";
      Rng rng(5);
      std::vector<Vec2> x(n);
      Eigen::VectorXd b(2 * n);
      for (int k = 0; k < 2 * n; ++k) b[k] = x[k / 2][k % 2] = rng.uniform(-1, 1);
      m.sparse.solve(x);
      const Eigen::VectorXd expected = m.dense.llt().solve(b);
      for (int k = 0; k < 2 * n; ++k) EXPECT_NEAR(x[k / 2][k % 2], expected[k], 1e-12);
    }
  }
}

TEST(BlockLdlt, RefusesAnIndefiniteMatrix) {
  Random m = random_matrix(20, 3, -1);
  m.sparse.diagonal[7] = -Mat2::Identity();
  EXPECT_FALSE(m.sparse.factor());
  m.sparse.diagonal[7] = 100 * Mat2::Identity();
  EXPECT_TRUE(m.sparse.factor()) << "and recovers";
}

}  // namespace
}  // namespace atlas_refine
