// Compaction: charts close up to the gap exactly, turn where that helps, and never overlap.
#include "pack/compaction.h"

#include <gtest/gtest.h>

#include <utility>

#include "outlines.h"

namespace atlas_refine {
namespace {

CompactionOptions options_for(double gap, double aspect = 0) {
  return {gap, aspect, 0.02, [] {}};
}

TEST(Compaction, TwoSquaresCloseUpToTheGap) {
  const auto square = testing::outline_of(shapes::rectangle(1, 1));
  const std::vector<Placement> start{{1, 0, {0, 0}}, {1, 0, {1.06, 0.0}}};
  const auto result = compact({square, square}, start, options_for(0.01));
  EXPECT_NEAR(placed_box({square, square}, result).size().x(), 2.01, 1e-4);
  EXPECT_GE(testing::smallest_distance({square, square}, result), 0.01);
  EXPECT_NEAR(testing::smallest_distance({square, square}, result), 0.01, 1e-6);
}

TEST(Compaction, ATurnedChartTurnsBack) {
  const auto square = testing::outline_of(shapes::rectangle(1, 1));
  const double angle_rad = 0.05;
  const std::vector<Placement> start{{1, 0, {0, 0}}, {std::cos(angle_rad), std::sin(angle_rad), {1.12, 0.02}}};
  const auto result = compact({square, square}, start, options_for(0.01));
  EXPECT_NEAR(placed_box({square, square}, result).area(), 2.01, 2e-3);
}

TEST(Compaction, ChartsInterlock) {
  const auto u = testing::outline_of(shapes::u_shape());
  // One open to the top, one turned over with a limb part of the way in the bay of the other.
  const std::vector<Placement> start{{1, 0, {0, 0}}, {-1, 0, {1.15, 1.5}}};
  ASSERT_GT(testing::smallest_distance({u, u}, start), 1e-3);
  const auto result = compact({u, u}, start, options_for(1e-3));
  EXPECT_LT(placed_box({u, u}, result).area(), 1.2 * 1.2);
  EXPECT_GE(testing::smallest_distance({u, u}, result), 1e-3);
}

TEST(Compaction, AFixedAspectCountsTheWholeBox) {
  const auto square = testing::outline_of(shapes::rectangle(1, 1));
  // In a square box only the longer side matters.
  const std::vector<Placement> start{{1, 0, {0, 0}}, {1, 0, {1.1, 0.05}}};
  const auto result = compact({square, square}, start, options_for(0.01, 1));
  EXPECT_NEAR(placed_box({square, square}, result).size().maxCoeff(), 2.01, 1e-3);
}

TEST(Compaction, RandomChartsNeverGetWorse) {
  for (int seed = 1; seed <= 10; ++seed) {
    std::vector<Outline> outlines;
    std::vector<Placement> start;
    for (int k = 0; k < 9; ++k) {
      outlines.push_back(testing::outline_of(shapes::random_star_polygon(10 * seed + k)));
      start.push_back({1, 0, {1.03 * (k % 3), 1.03 * (k / 3)}});
    }
    const double before = placed_box(outlines, start).area();
    const auto result = compact(outlines, start, options_for(0.02));
    EXPECT_LT(placed_box(outlines, result).area(), 0.9 * before);
    EXPECT_GE(testing::smallest_distance(outlines, result), 0.02);
  }
}

TEST(Compaction, ChartsThatAreTooNearAreDrawnApart) {
  for (int seed = 1; seed <= 10; ++seed) {
    std::vector<Outline> outlines;
    std::vector<Placement> start;
    for (int k = 0; k < 9; ++k) {
      // Long zigzags beside each other: corners of one go into bays of the next.
      shapes::Polygon zigzag;
      for (int j = 0; j <= 20; ++j) zigzag.outer.push_back({0.05 * j, 0.02 * (j % 2)});
      for (int j = 20; j >= 0; --j) zigzag.outer.push_back({0.05 * j, 0.02 * (j % 2) + 0.03});
      outlines.push_back(testing::outline_of(zigzag));
      start.push_back({1, 0, {0.0005 * ((seed * k) % 7), 0.034 * k}});
    }
    ASSERT_LT(testing::smallest_distance(outlines, start), 0.004);
    const auto result = compact(outlines, start, options_for(0.005));
    ASSERT_EQ(result.size(), outlines.size());
    EXPECT_GE(testing::smallest_distance(outlines, result), 0.005);
    EXPECT_LT(placed_box(outlines, result).area(), 1.2 * placed_box(outlines, start).area());
  }
}

TEST(Compaction, ChartsOfManyVerticesAreDrawnApartAsWell) {
  const auto disk = testing::outline_of(shapes::disk(0.5, 500));
  const std::vector<Outline> outlines(36, disk);
  std::vector<Placement> start;
  for (int k = 0; k < 36; ++k) start.push_back({1, 0, {1.02 * (k % 6), 1.02 * (k / 6)}});
  const auto result = compact(outlines, start, {0.03, 0, 0.06, [] {}});
  ASSERT_EQ(result.size(), outlines.size());
  EXPECT_GE(testing::smallest_distance(outlines, result), 0.03);
  EXPECT_LT(placed_box(outlines, result).area(), 1.03 * std::pow(1 + 5 * 1.03, 2));
}

TEST(Compaction, MoreVerticesOnTheSameOutlinesChangeNextToNothing) {
  constexpr int kParts = 20;  // of each edge
  double coarse = 0, fine = 0;
  for (int seed = 1; seed <= 5; ++seed) {
    std::vector<Outline> outlines, divided;
    std::vector<Placement> start;
    for (int k = 0; k < 9; ++k) {
      outlines.push_back(testing::outline_of(shapes::random_star_polygon(10 * seed + k)));
      Outline& last = divided.emplace_back(outlines.back());
      for (auto& loop : last.loops) {
        const auto corners = std::exchange(loop, {});
        for (std::size_t i = 0; i < corners.size(); ++i) {
          const Vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
          for (int part = 0; part < kParts; ++part) loop.push_back(a + static_cast<double>(part) / kParts * (b - a));
        }
      }
      start.push_back({1, 0, {1.03 * (k % 3), 1.03 * (k / 3)}});
    }
    coarse += placed_box(outlines, compact(outlines, start, options_for(0.02))).area();
    const auto result = compact(divided, start, options_for(0.02));
    fine += placed_box(divided, result).area();
    EXPECT_GE(testing::smallest_distance(divided, result), 0.02);
  }
  EXPECT_NEAR(fine, coarse, 0.02 * coarse);
}

TEST(Compaction, WhatDoesNotComeApartIsNothing) {
  const auto square = testing::outline_of(shapes::rectangle(1, 1));
  EXPECT_TRUE(compact({square, square}, {{1, 0, {0, 0}}, {1, 0, {0.3, 0.2}}}, options_for(0.01)).empty());
}

}  // namespace
}  // namespace atlas_refine
