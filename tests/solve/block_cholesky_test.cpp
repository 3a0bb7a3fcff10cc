// The block factorisation against a dense solve.
#include "solve/block_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <limits>
#include <string>

#include "dense_matrix.h"
#include "support/rng.h"
#include "support/thread_pool.h"

namespace atlas_refine {
namespace {

using Edges = std::vector<std::pair<int, int>>;

/// Random blocks in the pattern, and diagonals that dominate.
void set_random_values(Rng& rng, BlockCholesky& matrix) {
  const auto block = [&] {
    Mat2 b;
    for (int k = 0; k < 4; ++k) b(k / 2, k % 2) = rng.uniform(-1, 1);
    return b;
  };
  for (Mat2& d : matrix.diagonal) {
    const Mat2 b = block();
    d = b * b.transpose() + 30 * Mat2::Identity();
  }
  for (Mat2& off : matrix.off_diagonal) off = block();
}

Edges random_edges(Rng& rng, int n, int count) {
  Edges edges;
  for (int k = 0; k < count; ++k) {
    const int i = rng.below(n), j = rng.below(n);
    if (i != j) edges.emplace_back(i, j);
  }
  return edges;
}

BlockCholesky with_random_values(int n, const Edges& edges, Rng& rng, int last_node = -1) {
  BlockCholesky matrix;
  matrix.analyse(n, edges, last_node);
  set_random_values(rng, matrix);
  return matrix;
}

/// About four edges a node.
BlockCholesky random_matrix(int n, std::uint64_t seed, int last_node) {
  Rng rng(seed);
  const Edges edges = random_edges(rng, n, 2 * n);
  return with_random_values(n, edges, rng, last_node);
}

Edges grid_edges(int side) {
  Edges edges;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const int v = y * side + x;
      if (x + 1 < side) edges.emplace_back(v, v + 1);
      if (y + 1 < side) edges.emplace_back(v + side, v);
      if (x + 1 < side && y + 1 < side) edges.emplace_back(v, v + side + 1);
    }
  }
  return edges;
}

std::vector<Vec2> random_side(int n, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Vec2> x(n);
  for (Vec2& v : x) v = {rng.uniform(-1, 1), rng.uniform(-1, 1)};
  return x;
}

void expect_solves(BlockCholesky& matrix, const std::string& what) {
  SCOPED_TRACE(what);
  ASSERT_TRUE(matrix.factor());
  std::vector<Vec2> x = random_side(matrix.node_count(), 5);
  const Eigen::VectorXd b = Eigen::Map<const Eigen::VectorXd>(x[0].data(), 2 * static_cast<Eigen::Index>(x.size()));
  matrix.solve(x);
  const Eigen::VectorXd expected = testing::dense(matrix).llt().solve(b);
  for (int k = 0; k < b.size(); ++k) EXPECT_NEAR(x[k / 2][k % 2], expected[k], 1e-12);
}

TEST(BlockCholesky, SolvesLikeADenseMatrix) {
  for (const int n : {1, 2, 7, 60, 150}) {
    for (const int last : {-1, 0}) {
      BlockCholesky m = random_matrix(n, 10 + n, last);
      expect_solves(m, std::to_string(n) + " nodes");
      expect_solves(m, "a second factorisation of the same pattern");
    }
  }
}

TEST(BlockCholesky, SolvesWithoutAnyCouplingInPartsAndWithAllCoupled) {
  Rng rng(2);
  BlockCholesky lone = with_random_values(9, {}, rng);
  expect_solves(lone, "no edges");
  Edges parts = random_edges(rng, 40, 80);
  for (const auto& [i, j] : random_edges(rng, 40, 80)) parts.emplace_back(50 + i, 50 + j);
  BlockCholesky apart = with_random_values(95, parts, rng);
  expect_solves(apart, "parts");
  Edges all;
  for (int i = 0; i < 90; ++i) {
    for (int j = 0; j < i; ++j) all.emplace_back(i, j);
  }
  BlockCholesky coupled = with_random_values(90, all, rng);
  for (Mat2& d : coupled.diagonal) d += 200 * Mat2::Identity();
  expect_solves(coupled, "all pairs");
}

TEST(BlockCholesky, SolvesAPatternThatGrewAndShrank) {
  Rng rng(8);
  const Edges few = grid_edges(11);
  Edges more = few;
  for (const auto& edge : random_edges(rng, 121, 60)) more.push_back(edge);
  BlockCholesky matrix;
  for (const Edges& edges : {few, more, few, more, more, few}) {
    matrix.analyse(121, edges, 120);
    set_random_values(rng, matrix);
    expect_solves(matrix, std::to_string(edges.size()) + " edges");
  }
}

TEST(BlockCholesky, ValuesMayBeSetBeforeThePatternIsAnalysed) {
  const int side = 20, n = side * side;
  std::vector<std::vector<Vec2>> solutions;
  for (const bool before : {false, true}) {
    Rng rng(9);
    BlockCholesky matrix;
    for (const int last_node : {-1, n - 1, n - 1}) {  // also where the order is kept
      matrix.set_pattern(n, grid_edges(side), last_node);
      if (!before) matrix.analyse_pattern();
      matrix.set_zero();
      set_random_values(rng, matrix);
      if (before) matrix.analyse_pattern();
      ASSERT_TRUE(matrix.factor());
      matrix.solve(solutions.emplace_back(random_side(n, 3)));
    }
  }
  for (int k = 0; k < 3; ++k) EXPECT_EQ(solutions[k], solutions[k + 3]) << "pattern " << k;
}

TEST(BlockCholesky, TwoSidesAtOnceAreTheTwoAlone) {
  BlockCholesky m = random_matrix(80, 6, 3);
  ASSERT_TRUE(m.factor());
  std::vector<Vec2> a = random_side(80, 1), b = random_side(80, 2), both_a = a, both_b = b;
  m.solve(a);
  m.solve(b);
  m.solve(both_a, both_b);
  EXPECT_EQ(a, both_a);
  EXPECT_EQ(b, both_b);
}

TEST(BlockCholesky, AnyNumberOfThreadsGivesTheSameBits) {
  const int side = 110;  // large enough for tasks of their own
  Rng rng(4);
  BlockCholesky matrix;
  matrix.analyse(side * side, grid_edges(side));
  set_random_values(rng, matrix);
  std::vector<std::vector<Vec2>> solutions;
  for (const int threads : {1, 2, 3, 8}) {
    const ThreadPoolScope pool(threads);
    matrix.analyse_pattern();
    ASSERT_TRUE(matrix.factor(threads));
    matrix.solve(solutions.emplace_back(random_side(side * side, 7)));
    EXPECT_EQ(solutions.back(), solutions.front()) << threads << " threads";
  }
  matrix.diagonal[side * side / 2] = -Mat2::Identity();
  for (const int threads : {1, 2, 8}) EXPECT_FALSE(matrix.factor(threads));
}

TEST(BlockCholesky, RefusesAnIndefiniteMatrix) {
  BlockCholesky m = random_matrix(20, 3, -1);
  m.diagonal[7] = -Mat2::Identity();
  EXPECT_FALSE(m.factor());
  m.diagonal[7] = 100 * Mat2::Identity();
  EXPECT_TRUE(m.factor()) << "and recovers";
  m.diagonal[7](1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(m.factor());
  m.diagonal[7] = 100 * Mat2::Identity();
  m.diagonal[7](1, 1) = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(m.factor());
  m.diagonal[7](1, 1) = 0;
  EXPECT_FALSE(m.factor());
}

TEST(Buffer, GrowsByALittleWithoutNewMemory) {
  Buffer buffer;
  const double* memory = buffer.reserve(1000);
  EXPECT_EQ(buffer.reserve(1200), memory);
}

}  // namespace
}  // namespace atlas_refine
