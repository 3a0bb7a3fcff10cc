// The summary for people and the report for programs tell the same of a result.
#include "report.h"

#include <gtest/gtest.h>

#include <limits>

#include "atlas_refine/refine.h"

namespace atlas_refine::cli {
namespace {

RefineResult result_that_fell_back() {
  RefineResult result;
  result.intervention = Intervention::Squeezed;
  result.bound_met = true;
  result.ended = Ended::Stalled;
  result.after.box_width = 1;
  result.after.box_height = 0.712;
  result.after.unit_square_share = 0.5696;
  result.after.gap_between = std::numeric_limits<double>::infinity();
  result.repairs = {{.what = "mirrored, turned over", .charts = {3}}};
  result.fallbacks = {"cut first, squeezed instead"};
  return result;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Report, TheSummaryHasALineForEachRepairAndFallbackAndTheBox) {
  const std::string text = summary({}, result_that_fell_back(), {});
  EXPECT_TRUE(holds(text, "\n  repair: chart 3: mirrored, turned over\n")) << text;
  EXPECT_TRUE(holds(text, "\n  fallback: cut first, squeezed instead\n")) << text;
  EXPECT_TRUE(holds(text, "\n  box          1.000 x 0.712, 57.0 % of the unit square\n")) << text;
}

TEST(Report, TheReportHasFallbacksAndWhyItEnded) {
  const std::string text = json_report({}, {}, result_that_fell_back(), {});
  EXPECT_TRUE(holds(text, "\"fallbacks\": [\n    \"cut first, squeezed instead\"\n  ]")) << text;
  EXPECT_TRUE(holds(text, "\"ended\": \"stalled\"")) << text;
  EXPECT_TRUE(holds(text, "\"gap_between\": null")) << text;
}

}  // namespace
}  // namespace atlas_refine::cli
