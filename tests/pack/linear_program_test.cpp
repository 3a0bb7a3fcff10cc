// Small linear programs whose answer is known.
#include "pack/linear_program.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>

#include "support/rng.h"

namespace atlas_refine {
namespace {

TEST(LinearProgram, CornerOfAPolygon) {
  // max x + y with x + 2 y <= 2, 2 x + y <= 2: at (2/3, 2/3).
  const std::vector<LinearInequality> rows{{{{0, -1}, {1, -2}}, -2}, {{{0, -2}, {1, -1}}, -2}};
  const Eigen::VectorXd z = solve_linear_program(Eigen::Vector2d(-1, -1), rows, Eigen::Vector2d(5, 5), [] {});
  ASSERT_EQ(z.size(), 2);
  EXPECT_NEAR(z[0] + z[1], 4.0 / 3, 1e-3);
  EXPECT_LE(z[0] + 2 * z[1], 2 + 1e-8);
}

TEST(LinearProgram, StopsAtItsReach) {
  const Eigen::VectorXd z = solve_linear_program(Eigen::Vector2d(1, 0), {}, Eigen::Vector2d(0.25, 0.5), [] {});
  ASSERT_EQ(z.size(), 2);
  EXPECT_NEAR(z[0], -0.25, 1e-4);
}

TEST(LinearProgram, RepairsAnInfeasibleStart) {
  const std::vector<LinearInequality> rows{{{{0, 1}}, 0.5}};
  const Eigen::VectorXd z = solve_linear_program(Eigen::VectorXd::Constant(1, 1), rows, Eigen::VectorXd::Constant(1, 1), [] {});
  ASSERT_EQ(z.size(), 1);
  EXPECT_NEAR(z[0], 0.5, 1e-4);
  EXPECT_GE(z[0], 0.5 - 1e-8);
}

TEST(LinearProgram, NoFeasiblePointGivesNoAnswer) {
  const std::vector<LinearInequality> rows{{{{0, 1}}, 2.0}};
  EXPECT_EQ(solve_linear_program(Eigen::VectorXd::Constant(1, 1), rows, Eigen::VectorXd::Constant(1, 1), [] {}).size(), 0);
}

TEST(LinearProgram, RandomProgramsAreFeasibleAndNoVertexIsBetter) {
  // In the plane the best vertex is found by intersecting every pair of rows.
  for (int seed = 0; seed < 30; ++seed) {
    Rng rng(seed);
    std::vector<LinearInequality> rows;
    for (int k = 0; k < 8; ++k) rows.push_back({{{0, rng.uniform(-1, 1)}, {1, rng.uniform(-1, 1)}}, rng.uniform(-1, -0.1)});
    const Eigen::Vector2d cost(rng.uniform(-1, 1), rng.uniform(-1, 1)), reach(3, 3);
    const Eigen::VectorXd z = solve_linear_program(cost, rows, reach, [] {});
    ASSERT_EQ(z.size(), 2);
    auto all = rows;
    for (int i = 0; i < 2; ++i) {
      for (const double sign : {-1.0, 1.0}) all.push_back({{{i, sign}, {1 - i, 0}}, -3});
    }
    const auto row = [&](const LinearInequality& r) {
      Eigen::Vector2d v(0, 0);
      for (const auto& term : r.terms) v[term.variable] += term.coefficient;
      return v;
    };
    const auto feasible = [&](const Eigen::Vector2d& p) {
      return std::all_of(all.begin(), all.end(), [&](const auto& r) { return row(r).dot(p) >= r.bound - 1e-8; });
    };
    EXPECT_TRUE(feasible(z));
    double best = INFINITY;
    for (const auto& r : all) {
      for (const auto& s : all) {
        Eigen::Matrix2d matrix;
        matrix << row(r).transpose(), row(s).transpose();
        if (std::abs(matrix.determinant()) < 1e-9) continue;
        const Eigen::Vector2d p = matrix.inverse() * Eigen::Vector2d(r.bound, s.bound);
        if (feasible(p)) best = std::min(best, cost.dot(p));
      }
    }
    EXPECT_NEAR(cost.dot(z), best, 1e-3);
  }
}

}  // namespace
}  // namespace atlas_refine
