// What is listed of a search, what is chosen from it, and that both are one.
#include "needed/cut_outcomes.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace atlas_refine {
namespace {

/// Growth and E_d of each.
Outcomes outcomes(const std::vector<std::pair<double, double>>& of) {
  Outcomes out;
  for (const auto& [growth, distortion] : of)
    out.squeezed.push_back({.trial = {.growth = growth, .distortion = distortion}, .solution = {}});
  return out;
}

Outcomes nearly_at_a_limit() { return outcomes({{0, 1.2}, {0.04, 1.00008}, {0.03, 1.00012}, {0.05, 1.00007}, {0.1, 1.00001}}); }

TEST(Outcomes, OfThoseThatHardlyDifferTheFirstIsListed) {
  Outcomes found = nearly_at_a_limit();
  const RefineOptions options;
  const CutReport report = found.report({options, 1}, found.squeezed[2]);
  ASSERT_EQ(report.trade_off.size(), 3U);
  EXPECT_EQ(report.trade_off[1].distortion, 1.00012);
  EXPECT_EQ(report.chosen, 1);
}

TEST(Outcomes, WhatIsWrittenIsListedWhereALimitPartsIt) {
  Outcomes found = nearly_at_a_limit();
  RefineOptions options;
  options.max_distortion = 1.0001;
  const Wish wish{options, 1};
  const SqueezedTrial& written = found.best(wish);
  EXPECT_EQ(written.trial.growth, 0.04);
  const CutReport report = found.report(wish, written);
  ASSERT_EQ(report.trade_off.size(), 4U);
  EXPECT_EQ(report.trade_off[report.chosen].boundary_growth, written.trial.growth);
  EXPECT_EQ(report.trade_off[report.chosen].distortion, written.trial.distortion);
}

TEST(Outcomes, WhatIsAsGoodIsNotListedBesideWhatIsWritten) {
  Outcomes found = outcomes({{0, 1.2}, {0.04, 1.01}, {0.0401, 1.01005}, {0.1, 1.001}});
  const RefineOptions options;
  const CutReport report = found.report({options, 1}, found.squeezed[2]);
  ASSERT_EQ(report.trade_off.size(), 3U);
  EXPECT_EQ(report.chosen, 1);
  EXPECT_EQ(report.trade_off[1].distortion, 1.01005);
}

TEST(Outcomes, PointsAreNumberedAsListed) {
  Outcomes found = nearly_at_a_limit();
  RefineOptions options;
  options.max_distortion = 1.0001;
  const Wish wish{options, 1};
  const CutReport all = found.report(wish, found.best(wish));
  for (int k = 0; k < static_cast<int>(all.trade_off.size()); ++k) {
    options.point = k;
    const SqueezedTrial& point = found.point(wish);
    EXPECT_EQ(point.trial.distortion, all.trade_off[k].distortion);
    EXPECT_EQ(found.report(wish, point).chosen, k);
    EXPECT_EQ(found.report(wish, point).trade_off.size(), all.trade_off.size());
  }
}

}  // namespace
}  // namespace atlas_refine
