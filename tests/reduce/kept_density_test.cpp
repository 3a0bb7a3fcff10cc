// What of a packing charts only hold by growing out of their densities.
#include "reduce/kept_density.h"

#include <gtest/gtest.h>

namespace atlas_refine {
namespace {

TEST(KeptDensity, NothingIsOutgrownAtAnyCommonScale) {
  EXPECT_EQ(used_by_outgrown({1, 2, 3}, {1, 2, 3}), 0);
  EXPECT_EQ(used_by_outgrown({9, 18, 27}, {1, 2, 3}), 0);
  EXPECT_TRUE(outgrown_charts({9, 18, 27}, {1, 2, 3}).empty());
}

TEST(KeptDensity, WhatAFewHaveBeyondOneAndAHalfTimesCounts) {
  // Nearly all is to be the first chart's: it is the mean, however large the other grows.
  const std::vector<double> wanted = {1e6, 1};
  EXPECT_NEAR(used_by_outgrown({1e6, 2}, wanted), 0, 1e-9);
  EXPECT_EQ(outgrown_charts({1e6, 4}, wanted), std::vector<int>{1});
  const double beyond = 1e6 - 1.5 * 1.5;
  EXPECT_NEAR(used_by_outgrown({1e6, 1e6}, wanted), beyond / (kMostOutgrown * 2e6), 0.1);
}

TEST(KeptDensity, ChartsThatShrinkHoldNothing) {
  EXPECT_EQ(used_by_outgrown({1e6, 0.01}, {1e6, 1}), 0);
  EXPECT_TRUE(outgrown_charts({1e6, 0.01}, {1e6, 1}).empty());
}

TEST(KeptDensity, FixedChartsDoNotCount) {
  EXPECT_EQ(used_by_outgrown({1, 1, 50}, {1, 1, 0}), 0);
  EXPECT_TRUE(outgrown_charts({1, 1, 50}, {1, 1, 0}).empty());
}

}  // namespace
}  // namespace atlas_refine
