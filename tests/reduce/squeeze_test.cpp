// Several starts and the ladder of gaps.
#include "reduce/squeeze.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <thread>

#include "charts.h"
#include "coarsen/coarse_atlas.h"
#include "measure/certificate.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

using testing::charts_of;

/// The same charts in another start; an objective belongs to their triangles.
std::vector<Chart> turned(std::vector<Chart> charts, double angle_rad) {
  for (Chart& chart : charts) {
    for (Vec2& uv : chart.uvs) uv = Eigen::Rotation2Dd(angle_rad) * uv;
  }
  return charts;
}

TEST(Squeeze, KeepsTheBetterOfTwoStarts) {
  const std::vector<Chart> upright = charts_of(shapes::mesh(shapes::u_shape(), 0.1));
  const std::vector<Chart> tilted = turned(upright, 0.8);
  Monitor monitor;
  const SqueezeOptions options{.pe_bound = 0.85, .gaps = {Gap{}}};
  const Objective objective = make_objective(upright);
  const double one = squeeze({{upright}}, objective, options, monitor).outcome.energy,
               other = squeeze({{tilted}}, objective, options, monitor).outcome.energy;
  const Squeezed both = squeeze({{tilted}, {upright}}, objective, options, monitor);
  EXPECT_EQ(both.outcome.energy, std::min(one, other));
  EXPECT_TRUE(both.outcome.reached);
}

TEST(Squeeze, ReducesTheGapOnlyAsFarAsNeeded) {
  const std::vector<Chart> charts = charts_of(shapes::squares(16, 0.4));
  Monitor monitor;
  SqueezeOptions options{.pe_bound = 0.85, .gaps = {Gap{0.03}, Gap{0.01}, Gap{0.001}}};
  const Squeezed squeezed = squeeze({{charts}}, make_objective(charts), options, monitor);
  EXPECT_TRUE(squeezed.outcome.reached);
  EXPECT_EQ(squeezed.gap.value, 0.01);
  EXPECT_FALSE(squeezed.gap_note.empty());
  const std::vector<Chart> after = testing::with_uvs(charts, squeezed.outcome.uvs);
  EXPECT_GE(gap_between_charts(after), squeezed.gap.length(testing::box_sides(after)) * (1 - 1e-9));
  options.pe_bound = 0.6;
  EXPECT_EQ(squeeze({{charts}}, make_objective(charts), options, monitor).gap.value, 0.03);
}

TEST(Squeeze, EndsWithTheBestStartWhereItIsToFinish) {
  const std::vector<Chart> upright = charts_of(shapes::mesh(shapes::u_shape(), 0.1));
  const std::vector<Chart> tilted = turned(upright, 0.8);
  Monitor monitor;
  monitor.finish();
  const SqueezeOptions options{.pe_bound = 0.95, .gaps = {Gap{}, Gap{0.001}}};
  const Squeezed squeezed = squeeze({{tilted}, {upright}}, make_objective(upright), options, monitor);
  EXPECT_EQ(squeezed.outcome.status, ReduceStatus::Stopped);
  EXPECT_EQ(squeezed.iterations, 0);
  EXPECT_EQ(squeezed.gap.value, Gap{}.value);
  EXPECT_NEAR(squeezed.outcome.pe, testing::packing_efficiency(upright), 1e-9);
}

// Coarse charts that are stopped on their way are carried over as far as they came.
TEST(Squeeze, WhatCoarseChartsHaveReachedIsNotLostWhereItIsToFinish) {
  const std::vector<Chart> charts = charts_of(shapes::mesh(shapes::spiral(3), 0.01));
  ASSERT_TRUE(coarsen(charts, make_objective(charts), {}));
  const double pe_at_start = testing::packing_efficiency(charts);
  Monitor monitor;
  std::jthread user([&] {
    while (monitor.snapshot().pe < pe_at_start + 0.1) std::this_thread::yield();
    monitor.finish();
  });
  const Squeezed squeezed = squeeze({{charts}}, make_objective(charts), {.pe_bound = 0.999, .gaps = {Gap{}}}, monitor);
  EXPECT_EQ(squeezed.outcome.status, ReduceStatus::Stopped);
  EXPECT_FALSE(squeezed.outcome.reached);
  EXPECT_GT(squeezed.outcome.pe, pe_at_start + 0.08);
  EXPECT_TRUE(certify_charts(testing::with_uvs(charts, squeezed.outcome.uvs)).valid());
}

TEST(AutomaticGaps, StartWithTheLargestThatTheBoundCanHold) {
  const std::vector<Chart> charts = charts_of(shapes::squares(400, 0.4));
  const double half_perimeter = 0.5 * uv_perimeter(charts), area = uv_area(charts);
  for (const double most_taken : {1.0, kMostTakenBent}) {
    const std::vector<Gap> gaps = automatic_gaps(charts, 0.85, 1, 0, most_taken);
    const double most_covered = 0.85 + 0.15 * most_taken;
    const Vec2 box = sides_of_area(area / 0.85, 1);
    const auto covered = [&](double value) { return (area + Gap{value}.length(box) * half_perimeter) / box.prod(); };
    EXPECT_LT(covered(gaps.front().value), 1.02 * most_covered);
    EXPECT_GT(covered(gaps.front().value / 0.6), most_covered) << "a larger one was possible";
    EXPECT_GT(gaps.size(), 2u);
  }
}

TEST(Squeeze, TheBitsDoNotDependOnTheThreads) {
  const std::vector<Chart> charts = charts_of(shapes::disk_in_ring());
  const auto run = [&](int threads) {
    Monitor monitor;
    return squeeze({{charts}, {charts}}, make_objective(charts), {.pe_bound = 0.8, .gaps = {Gap{}}, .threads = threads}, monitor);
  };
  const Squeezed one = run(1), two = run(2);
  for (std::size_t c = 0; c < charts.size(); ++c) EXPECT_TRUE(testing::same_bits(one.outcome.uvs[c], two.outcome.uvs[c]));
}

}  // namespace
}  // namespace atlas_refine
