// Target directions: the rules hold, and no other labels cost less.
#include "align/target_angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
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

/// Calls `visit` with all labels within three quarter turns of the angles that turn as they may, the last vertex left out.
void for_all_labels(const TargetProblem& problem, std::vector<int>& labels,
                    const std::function<void(const std::vector<int>&)>& visit) {
  const std::size_t i = labels.size();
  if (i == problem.lengths.size()) return visit(labels);
  const int own = static_cast<int>(std::lround(problem.angle_rad[i] / (pi / 2)));
  for (int label = own - 3; label <= own + 3; ++label) {
    if (i > 0 && (label - labels[i - 1] > 1 || label - labels[i - 1] < -2)) continue;
    labels.push_back(label);
    for_all_labels(problem, labels, visit);
    labels.pop_back();
  }
}

/// The least cost of all labels that keep the rules, infinite where none do.
double least_cost(const TargetProblem& problem) {
  double best = std::numeric_limits<double>::infinity();
  std::vector<int> labels;
  for_all_labels(problem, labels, [&](const std::vector<int>& all) {
    if (!allowed(all) || shortest_segment(problem, all) < problem.least_segment * (1 - 1e-9)) return;
    best = std::min(best, cost(problem, all));
  });
  return best;
}

/// Angles that rise by 2 pi in all, with noise.
std::vector<double> random_turn(int n, double noise, Rng& rng) {
  std::vector<double> angles;
  const double start = rng.uniform(-pi, pi);
  for (int i = 0; i < n; ++i) angles.push_back(start + 2 * pi * i / n + rng.uniform(-noise, noise));
  return angles;
}

/// Lengths and angles of a small cycle; a third of them mild, the others wild.
struct SmallCycle {
  std::vector<double> lengths, angles;
  double corner_cost, least_segment;

  SmallCycle(int trial, Rng& rng) {
    const int n = 5 + trial % 4;
    const double noise[] = {0.9, 2.5, 5};
    angles = random_turn(n, noise[trial % 3], rng);
    for (int i = 0; i < n; ++i) lengths.push_back(rng.uniform(0.05, 2));
    corner_cost = trial % 5 == 0 ? 0 : rng.uniform(0, 2);
    least_segment = trial % 2 == 0 ? 0 : rng.uniform(0, 0.3) * std::accumulate(lengths.begin(), lengths.end(), 0.0);
  }
  TargetProblem problem() const { return {lengths, angles, corner_cost, least_segment}; }
};

TEST(TargetAngles, NoOtherLabelsOfASmallCycleCostLess) {
  Rng rng(5);
  int solved = 0, unsolvable = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    SCOPED_TRACE(trial);
    const SmallCycle cycle(trial, rng);
    const std::vector<int> labels = target_angles(cycle.problem());
    const double least = least_cost(cycle.problem());
    if (labels.empty()) {
      EXPECT_EQ(least, std::numeric_limits<double>::infinity());
      ++unsolvable;
      continue;
    }
    ++solved;
    EXPECT_TRUE(allowed(labels));
    EXPECT_GE(shortest_segment(cycle.problem(), labels), cycle.least_segment * (1 - 1e-9));
    EXPECT_NEAR(cost(cycle.problem(), labels), least, 1e-12 * (1 + least));
  }
  EXPECT_GT(solved, 3000);
  EXPECT_GT(unsolvable, 100);
}

TEST(TargetAngles, WhereTheBoundaryBeginsIsAllTheSame) {
  Rng rng(6);
  for (int trial = 0; trial < 400; ++trial) {
    SCOPED_TRACE(trial);
    SmallCycle cycle(trial, rng);
    const std::vector<int> before = target_angles(cycle.problem());
    const double cost_before = before.empty() ? 0 : cost(cycle.problem(), before);
    std::rotate(cycle.lengths.begin(), cycle.lengths.begin() + 2, cycle.lengths.end());
    std::rotate(cycle.angles.begin(), cycle.angles.begin() + 2, cycle.angles.end());
    for (std::size_t i = cycle.angles.size() - 2; i < cycle.angles.size(); ++i) cycle.angles[i] += 2 * pi;
    const std::vector<int> after = target_angles(cycle.problem());
    ASSERT_EQ(after.empty(), before.empty());
    if (after.empty()) continue;
    EXPECT_NEAR(cost(cycle.problem(), after), cost_before, 1e-12 * (1 + cost_before));
  }
}

TEST(TargetAngles, SegmentsOfManyEdgesKeepTheirLengthAllRound) {
  Rng rng(7);
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 300;
    std::vector<double> lengths(n, 1), angles;
    for (int i = 0; i < n; ++i) angles.push_back(2 * pi * i / n + 2 * std::sin(40 * pi * i / n) + rng.uniform(-1, 1));
    const TargetProblem problem{lengths, angles, 0.5, 20};
    const std::vector<int> labels = target_angles(problem);
    ASSERT_EQ(labels.size(), angles.size());
    EXPECT_TRUE(allowed(labels));
    EXPECT_GE(shortest_segment(problem, labels), 20);
  }
}

TEST(TargetAngles, NoneWhereFourSegmentsDoNotFit) {
  const std::vector<double> lengths(8, 1), angles = {0, 0, pi / 2, pi / 2, pi, pi, 1.5 * pi, 1.5 * pi};
  EXPECT_EQ(target_angles({lengths, angles, 0.1, 2}).size(), 8u);
  EXPECT_TRUE(target_angles({lengths, angles, 0.1, 2.01}).empty());
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
