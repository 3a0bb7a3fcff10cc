// Target directions: the rules hold, and no other labels cost less.
#include "align/target_angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "align/polar_angles.h"
#include "align/prepare.h"
#include "cut_checks.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

using std::numbers::pi;

double cost(const TargetProblem& problem, const std::vector<int>& labels) {
  double sum = 0;
  const std::vector<int> turns = corner_turns(labels);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const double off = problem.angle_rad[i] - pi / 2 * labels[i];
    sum += problem.lengths[i] * off * off + problem.corner_cost * std::abs(turns[i]);
  }
  return sum;
}

bool allowed(const std::vector<int>& labels) {
  const std::vector<int> turns = corner_turns(labels);
  return std::all_of(turns.begin(), turns.end(), [](int k) { return k <= 1 && k >= -2; });
}

double shortest_segment(const TargetProblem& problem, const std::vector<int>& labels) {
  const int n = static_cast<int>(labels.size());
  const std::vector<int> turns = corner_turns(labels);
  double shortest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n; ++i) {
    if (turns[i] == 0) continue;
    double length = problem.lengths[i];
    for (int j = (i + 1) % n; turns[j] == 0 && j != i; j = (j + 1) % n) length += problem.lengths[j];
    shortest = std::min(shortest, length);
  }
  return shortest;
}

/// The least cost of all labels within `reach` of the angles that keep the rules.
double least_cost(const TargetProblem& problem) {
  const int n = static_cast<int>(problem.lengths.size());
  std::vector<int> base(n), labels(n);
  for (int i = 0; i < n; ++i) base[i] = static_cast<int>(std::lround(problem.angle_rad[i] / (pi / 2))) - 1;
  double best = std::numeric_limits<double>::infinity();
  const int count = static_cast<int>(std::lround(std::pow(3, n)));
  for (int code = 0; code < count; ++code) {
    for (int i = 0, rest = code; i < n; ++i, rest /= 3) labels[i] = base[i] + rest % 3;
    if (!allowed(labels) || shortest_segment(problem, labels) < problem.least_segment - 1e-12) continue;
    best = std::min(best, cost(problem, labels));
  }
  return best;
}

/// Angles that rise by 2 pi in all, with noise.
std::vector<double> random_turn(int n, double noise, Rng& rng) {
  std::vector<double> angles;
  const double start = rng.uniform(-pi, pi);
  for (int i = 0; i < n; ++i) angles.push_back(start + 2 * pi * i / n + rng.uniform(-noise, noise));
  return angles;
}

TEST(TargetAngles, NoOtherLabelsOfASmallCycleCostLess) {
  Rng rng(5);
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(trial);
    const int n = 5 + trial % 5;
    std::vector<double> lengths;
    for (int i = 0; i < n; ++i) lengths.push_back(rng.uniform(0.2, 2));
    std::vector<double> angles = random_turn(n, 0.9, rng);
    if (trial % 3 == 0) {
      // A side that is longer than the least segment and lies along an axis: the walk begins there.
      lengths[0] = 6;
      angles[0] = pi / 2 * std::round(angles[0] / (pi / 2));
    }
    const TargetProblem problem{lengths, angles, rng.uniform(0, 1), trial % 3 == 0 ? 0.6 : 0};
    const std::vector<int> labels = target_angles(problem);
    const double least = least_cost(problem);
    if (labels.empty()) {
      EXPECT_EQ(least, std::numeric_limits<double>::infinity());
      continue;
    }
    EXPECT_TRUE(allowed(labels));
    EXPECT_LE(cost(problem, labels), least + 1e-9);
  }
}

TEST(TargetAngles, KeepTheirRulesOnEveryShape) {
  for (const shapes::Named& shape : testing::many_polygons()) {
    SCOPED_TRACE(shape.name);
    const Chart chart = testing::chart_of(shape.polygon);
    const BoundaryAngles boundary = polar_angles(prepare_chart(chart).mesh.to_chart(chart));
    for (const double sigma : {0.004, 0.02}) {
      const double length = sigma * boundary.perimeter();
      const std::vector<double> angles = smoothed_angles(boundary, length);
      const TargetProblem problem{boundary.lengths, angles, 2.5 * length, 2 * length};
      const std::vector<int> labels = target_angles(problem);
      ASSERT_EQ(labels.size(), angles.size());
      EXPECT_TRUE(allowed(labels));
      const std::vector<int> turns = corner_turns(labels);
      EXPECT_EQ(std::accumulate(turns.begin(), turns.end(), 0), 4);
      EXPECT_GE(shortest_segment(problem, labels), problem.least_segment * (1 - 1e-9));
    }
  }
}

TEST(TargetAngles, CornersThatCostMuchAreFour) {
  const Chart chart = testing::chart_of(shapes::comb());
  const BoundaryAngles boundary = polar_angles(prepare_chart(chart).mesh.to_chart(chart));
  const std::vector<int> dear = target_angles({boundary.lengths, boundary.angle_rad, 1e3 * boundary.perimeter(), 0});
  const std::vector<int> cheap = target_angles({boundary.lengths, boundary.angle_rad, 0, 0});
  const auto corners = [](const std::vector<int>& labels) {
    const std::vector<int> turns = corner_turns(labels);
    return std::count_if(turns.begin(), turns.end(), [](int k) { return k != 0; });
  };
  EXPECT_EQ(corners(dear), 4);
  EXPECT_GT(corners(cheap), 20);
}

TEST(TargetAngles, ASquareGetsItsOwnDirections) {
  const std::vector<double> lengths = {1, 1, 1, 1}, angles = {0.05, pi / 2, pi - 0.05, 1.5 * pi};
  EXPECT_EQ(target_angles({lengths, angles, 0.01, 0.1}), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(corner_turns({0, 1, 2, 3}), (std::vector<int>{1, 1, 1, 1}));
}

}  // namespace
}  // namespace atlas_refine
