// What charts take with the gap around them: Steiner's formula, its inverse, and a bound that disks reach.
#include "pack/room_for_gap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "charts.h"
#include "measure/distortion.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

TEST(RoomForGap, SquaresTakeTheirAreaAStripAlongEachSideAndADiskAtTheirCorners) {
  const auto charts = testing::charts_of(shapes::two_squares(0.5));
  const double gap = 0.1, grown = 2 * (1 + 4 * 0.5 * gap + 0.25 * std::numbers::pi * gap * gap);
  EXPECT_NEAR(RoomForGap(charts, {0.01}, 1).taken(gap, {2, 3}), grown / ((2 + gap) * (3 + gap)), 1e-12);
}

TEST(RoomForGap, WithTheGapOfAPartChartsTakeThatPart) {
  const auto charts = testing::charts_of(shapes::squares(30));
  for (const double value : {0.003, 0.02}) {
    const Gap gap{value, Gap::Unit::LongSide};
    const RoomForGap room(charts, gap, 2);
    const auto at = room.gap_at(0.8);
    ASSERT_TRUE(at);
    const Vec2 box(*at / value, 0.5 * *at / value);
    EXPECT_NEAR(gap.length(box), *at, 1e-12);
    EXPECT_NEAR(room.taken(*at, box), 0.8, 1e-9);
  }
}

TEST(RoomForGap, NoPartIsLeftWhereDisksOfTheGapAloneTakeMore) {
  const auto charts = testing::charts_of(shapes::squares(400));
  EXPECT_FALSE(RoomForGap(charts, {0.06, Gap::Unit::LongSide}, 1).gap_at(0.8));
}

TEST(RoomForGap, NoShapesOfTheseAreasCoverMoreThanDisks) {
  const auto charts = testing::charts_of(shapes::squares(400));
  const Gap gap{16.0 / 1024, Gap::Unit::LongSide};
  const double most = RoomForGap(charts, gap, 1).most_pe();
  // Disks that cover so much of a unit square, with half the gap around each, take what it has with as much around it.
  const double g = gap.value, shrink = std::sqrt(most / uv_area(charts));
  double grown = 0;
  for (const Chart& chart : charts) {
    const double radius = shrink * std::sqrt(uv_area(chart) / std::numbers::pi) + 0.5 * g;
    grown += std::numbers::pi * radius * radius;
  }
  EXPECT_NEAR(grown, (1 + g) * (1 + g), 1e-9);
  EXPECT_LT(most, 0.6);
}

}  // namespace
}  // namespace atlas_refine
