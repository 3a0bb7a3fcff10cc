// Charts placed anew: rigid, apart by the gap of the box that came out, the same from every number of threads.
#include "pack/place_charts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "atlas_refine/error.h"
#include "charts.h"
#include "pack/pack_charts.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

using testing::box_sides;
using testing::charts_of;

std::vector<Chart> several() {
  std::vector<Atlas> atlases;
  for (const auto& [name, polygon] : shapes::named_polygons()) atlases.push_back(shapes::mesh(polygon, 0.1));
  return charts_of(shapes::combine(atlases));
}

class PlaceCharts : public ::testing::TestWithParam<PlaceOptions> {};

TEST_P(PlaceCharts, MovesRigidlyAndKeepsTheGap) {
  const std::vector<Chart> charts = several();
  Monitor monitor;
  const std::vector<Chart> placed = place_charts(charts, GetParam(), monitor);
  ASSERT_EQ(placed.size(), charts.size());
  testing::expect_certified(placed);
  for (std::size_t c = 0; c < charts.size(); ++c) {
    const Vec2 turned = placed[c].uvs[1] - placed[c].uvs[0], before = charts[c].uvs[1] - charts[c].uvs[0];
    const double cosine = turned.dot(before) / before.squaredNorm();
    const double sine = (before.x() * turned.y() - before.y() * turned.x()) / before.squaredNorm();
    EXPECT_NEAR(cosine * cosine + sine * sine, 1, 1e-9);
    for (std::size_t v = 0; v < charts[c].uvs.size(); ++v) {
      const Vec2 way = charts[c].uvs[v] - charts[c].uvs[0];
      const Vec2 expected = placed[c].uvs[0] + Vec2(cosine * way.x() - sine * way.y(), sine * way.x() + cosine * way.y());
      EXPECT_NEAR((placed[c].uvs[v] - expected).norm(), 0, 1e-9);
    }
  }
  EXPECT_GE(gap_between_charts(placed), GetParam().gap.length(box_sides(placed, GetParam().box_aspect)));
}

INSTANTIATE_TEST_SUITE_P(
    GapsAndBoxes, PlaceCharts,
    ::testing::Values(PlaceOptions{.target_pe = 0.5}, PlaceOptions{.gap = {0.02}, .target_pe = 0.5},
                      PlaceOptions{.box_aspect = 1, .target_pe = 0.5},
                      PlaceOptions{.target_pe = 0.9, .rotate = Rotate::QuarterTurns},
                      PlaceOptions{.target_pe = 0.9, .rotate = Rotate::None}, PlaceOptions{.target_pe = 0.9, .align_axes = true},
                      PlaceOptions{.gap = {8.0 / 1024, Gap::Unit::LongSide}, .box_aspect = 3, .target_pe = 0.45}));

TEST(PlaceCharts, TheBitsDoNotDependOnTheThreads) {
  const std::vector<Chart> charts = several();
  Monitor monitor;
  const auto one = place_charts(charts, {.threads = 1}, monitor), two = place_charts(charts, {.threads = 2}, monitor);
  for (std::size_t c = 0; c < charts.size(); ++c) EXPECT_TRUE(testing::same_bits(one[c].uvs, two[c].uvs));
}

TEST(PlaceCharts, OneChartFindsItsSmallestBox) {
  const Atlas atlas = shapes::mesh(shapes::transformed(shapes::rectangle(1, 0.4), 1, 0.7, {3, 5}), 0.1);
  const std::vector<Chart> charts = charts_of(atlas);
  Monitor monitor;
  const std::vector<Chart> placed = place_charts(charts, {.target_pe = 0.99}, monitor);
  EXPECT_LT(testing::packing_efficiency(charts), 0.7);
  EXPECT_GT(testing::packing_efficiency(placed), 0.999);
}

TEST(PlaceCharts, ChartsTurnAsTheyMay) {
  const std::vector<Chart> charts = several();
  Monitor monitor;
  for (const Rotate rotate : {Rotate::QuarterTurns, Rotate::None}) {
    const std::vector<Chart> placed = place_charts(charts, {.target_pe = 0.9, .rotate = rotate}, monitor);
    for (std::size_t c = 0; c < charts.size(); ++c) {
      const Vec2 turned = placed[c].uvs[1] - placed[c].uvs[0], before = charts[c].uvs[1] - charts[c].uvs[0];
      const double along = turned.dot(before) / before.squaredNorm();
      EXPECT_NEAR(along, rotate == Rotate::None ? 1 : std::round(along), 1e-9);
    }
  }
}

TEST(PlaceCharts, OneChartTurnsAsItMay) {
  const std::vector<Chart> wide = charts_of(shapes::mesh(shapes::rectangle(1, 0.4), 0.1));
  const std::vector<Chart> tilted = charts_of(shapes::mesh(shapes::transformed(shapes::rectangle(1, 0.4), 1, 0.3, {0, 0}), 0.1));
  Monitor monitor;
  const auto sides = [&](const std::vector<Chart>& charts, const PlaceOptions& options) {
    return box_sides(place_charts(charts, options, monitor));
  };
  EXPECT_LT(sides(wide, {.box_aspect = 0.5, .rotate = Rotate::QuarterTurns}).x(), 0.41);
  EXPECT_GT(sides(wide, {.box_aspect = 0.5, .rotate = Rotate::None}).x(), 0.99);
  EXPECT_NEAR(sides(tilted, {.rotate = Rotate::None}).x(), box_sides(tilted).x(), 1e-12);
  EXPECT_NEAR(sides(tilted, {.align_axes = true}).maxCoeff(), 1, 1e-12);
}

TEST(PlaceCharts, InRowsWhereTheseReachTheTarget) {
  std::vector<Atlas> faces;
  for (int k = 0; k < 300; ++k) faces.push_back(shapes::mesh(shapes::transformed(shapes::rectangle(1, 1.5), 1, k, {0, 0}), 2));
  const std::vector<Chart> charts = charts_of(shapes::combine(faces));
  Monitor monitor;
  const PlaceOptions options{.gap = {0.002}, .box_aspect = 1, .target_pe = 0.8};
  const auto placed = place_in_rows(charts, options, monitor);
  ASSERT_TRUE(placed);
  testing::expect_certified(*placed);
  EXPECT_GE(testing::packing_efficiency(*placed, 1), options.target_pe);
  EXPECT_GE(gap_between_charts(*placed), options.gap.length(box_sides(*placed, 1)));
  EXPECT_FALSE(place_in_rows(charts, {.gap = {0.006}, .box_aspect = 1, .target_pe = 0.8}, monitor));
}

TEST(PlaceCharts, CanBeCancelled) {
  Monitor monitor;
  monitor.cancel();
  EXPECT_THROW(place_charts(several(), {}, monitor), RefineError);
}

TEST(PlaceCharts, RefusesANeedleByItsFace) {
  std::vector<Chart> charts = several();
  Chart& needle = charts[3];
  needle.uvs[needle.triangles[5][0]].x() += 1e6;
  Monitor monitor;
  try {
    place_charts(charts, {}, monitor);
    FAIL() << "nothing was refused";
  } catch (const RefineError& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadInput);
    EXPECT_EQ(error.chart(), 3);
    const Triangle& named = needle.triangles[std::find(needle.triangle_faces.begin(), needle.triangle_faces.end(), error.face()) -
                                             needle.triangle_faces.begin()];
    EXPECT_EQ(std::count(named.begin(), named.end(), needle.triangles[5][0]), 1);
  }
}

TEST(PlaceChartsAgain, WhatChangedIsMovedLikewise) {
  const Placement motion{0.6, -0.8, Vec2(3, -7)};
  const std::vector<Vec2> from = {{1, 2}, {1.1, 2}, {4, 6}, {0, 3}};
  std::vector<Vec2> to, changed = from, wanted;
  for (const Vec2& uv : from) to.push_back(motion.apply(uv));
  changed[1] += Vec2(0.01, 0.02);
  for (const Vec2& uv : changed) wanted.push_back(motion.apply(uv));
  const std::vector<Vec2> moved = moved_likewise(changed, from, to);
  for (std::size_t v = 0; v < wanted.size(); ++v) EXPECT_LT((moved[v] - wanted[v]).norm(), 1e-14);
}

}  // namespace
}  // namespace atlas_refine
