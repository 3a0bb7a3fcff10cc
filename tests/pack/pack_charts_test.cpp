// The packer as a whole: the gap and the box hold on every kind of chart, the answer is good and always the same.
#include "pack/pack_charts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "outlines.h"
#include "pack/layout.h"
#include "pack/turns.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

using testing::Charts;

/// Checks everything that a packing promises.
void expect_sound(const Charts& charts, const PackOptions& options, const Packing& packing) {
  ASSERT_EQ(packing.placements.size(), charts.outlines.size());
  EXPECT_GE(testing::smallest_distance(charts.outlines, packing.placements), options.gap);
  EXPECT_GT(testing::smallest_distance(charts.outlines, packing.placements), 0);
  const double slack = 1e-9 * packing.box.diagonal();
  for (std::size_t i = 0; i < charts.outlines.size(); ++i) {
    const Placement& placement = packing.placements[i];
    EXPECT_NEAR(std::hypot(placement.cosine, placement.sine), 1, 1e-14);
    for (const auto& loop : testing::placed(charts.outlines[i], placement).loops) {
      for (const Vec2& p : loop) {
        EXPECT_GE(p.minCoeff(), -slack);
        EXPECT_LE((p - packing.box.max).maxCoeff(), slack);
      }
    }
  }
  EXPECT_EQ(packing.box.min, Vec2(0, 0));
  EXPECT_NEAR(packing.pe, charts.area / packing.box.area(), 1e-12);
  if (options.box_aspect > 0) {
    EXPECT_NEAR(packing.box.size().x() / packing.box.size().y(), options.box_aspect, 1e-9);
  }
}

Packing pack(const Charts& charts, const PackOptions& options) {
  const Packing packing = pack_charts(charts.outlines, charts.areas, options);
  expect_sound(charts, options, packing);
  return packing;
}

Charts named_charts() {
  Charts charts;
  for (const auto& shape : shapes::named_polygons()) charts.add(shape.polygon);
  return charts;
}

Charts random_charts(int count, std::uint64_t seed) {
  Charts charts;
  for (int k = 0; k < count; ++k) {
    Rng rng(seed, k);
    const auto polygon = k % 2 ? shapes::random_polygon(seed + k) : shapes::random_star_polygon(seed + k);
    charts.add(shapes::transformed(polygon, rng.uniform(0.2, 1.0), rng.uniform(0, 6), {rng.uniform(), rng.uniform()}));
  }
  return charts;
}

TEST(PackCharts, NoChartNeedsNoBox) {
  const Packing packing = pack_charts({}, {}, {});
  EXPECT_TRUE(packing.placements.empty());
  EXPECT_EQ(packing.pe, 0);
}

TEST(PackCharts, OneChartGetsItsSmallestBox) {
  Charts charts;
  charts.add(shapes::transformed(shapes::rectangle(3, 1), 1, 0.7, {5, -2}));
  EXPECT_NEAR(pack(charts, {.gap = 0.1}).pe, 1, 1e-12);
  // In a square, the diagonal position: side (3 + 1) / sqrt 2.
  EXPECT_NEAR(pack(charts, {.box_aspect = 1}).pe, 3.0 / 8, 1e-12);
}

TEST(PackCharts, SquaresTileABox) {
  Charts charts;
  for (int k = 0; k < 16; ++k) charts.add(shapes::transformed(shapes::rectangle(1, 1), 1, 0.3 * k, {0, 0}));
  const double gap = 0.02;
  const double expected = 16 / std::pow(4 + 3 * gap, 2);
  EXPECT_GT(pack(charts, {.gap = gap, .box_aspect = 1}).pe, expected - 1e-5);
  EXPECT_GT(pack(charts, {.gap = gap}).pe, expected - 1e-5);
}

TEST(PackCharts, NamedShapesWithEveryKindOfBox) {
  const Charts charts = named_charts();
  for (const double aspect : {0.0, 1.0, 2.0, 0.5}) {
    EXPECT_GT(pack(charts, {.gap = 0.01, .box_aspect = aspect}).pe, 0.5) << "aspect " << aspect;
  }
}

TEST(PackCharts, SmallChartsGoIntoHolesAndBays) {
  Charts charts;
  charts.add(shapes::ring(0.4, 0.5));
  charts.add(shapes::disk(0.35));
  const Packing packing = pack(charts, {.gap = 0.02});
  EXPECT_NEAR(packing.box.area(), 1, 1e-2);
}

TEST(PackCharts, WhatIsLongerThanTheBoxLiesAslant) {
  // A cylinder's wall, between its caps: as long as the box upright, in a smaller one on the diagonal.
  for (const PackSearch search : {PackSearch::Thorough, PackSearch::Fair}) {
    Charts charts;
    charts.add(shapes::rectangle(2 * std::numbers::pi, 2));
    for (int cap = 0; cap < 2; ++cap) charts.add(shapes::disk(1));
    const double side = (2 * std::numbers::pi + 2) / std::sqrt(2);
    EXPECT_NEAR(pack(charts, {.gap = 0.01, .box_aspect = 1, .target_pe = 0.8, .search = search}).box.size().x(), side,
                0.02 * side);
  }
}

TEST(PackCharts, NestedShapesInterlock) {
  Charts charts;
  for (int k = 0; k < 4; ++k) charts.add(shapes::u_shape());
  // Side by side they fill 0.6 of their box; in a chain, limb in bay, 0.8.
  EXPECT_GT(pack(charts, {.gap = 0.005}).pe, 0.7);
}

TEST(PackCharts, RoughlyTheGapIsKeptAsWell) {
  pack(named_charts(), {.gap = 0.01, .target_pe = 0.9, .search = PackSearch::Rough});
}

TEST(PackCharts, FairlyTheBestRoughOneIsMadeSmaller) {
  double rough = 0, fair = 0;
  for (int seed = 1; seed <= 6; ++seed) {
    const Charts charts = random_charts(4 + seed, 100 * seed);
    const double gap = 0.01 * std::sqrt(charts.area);
    const double one = pack(charts, {.gap = gap, .search = PackSearch::Rough}).pe;
    const double other = pack(charts, {.gap = gap, .search = PackSearch::Fair}).pe;
    EXPECT_GE(other, one) << "seed " << seed;
    rough += one;
    fair += other;
  }
  EXPECT_GT(fair, 1.02 * rough);
}

TEST(PackCharts, WithoutAGapChartsStillDoNotTouch) { pack(named_charts(), {.gap = 0}); }

TEST(PackCharts, RandomChartsKeepTheGap) {
  for (int seed = 1; seed <= 12; ++seed) {
    const Charts charts = random_charts(2 + 2 * seed, 100 * seed);
    const double gap = std::sqrt(charts.area) * Rng(seed).uniform(0, 0.02);
    EXPECT_GT(pack(charts, {.gap = gap, .box_aspect = seed % 3 == 0 ? 1.0 : 0.0}).pe, 0.5) << "seed " << seed;
  }
}

TEST(PackCharts, VeryUnevenSizes) {
  Charts charts = random_charts(4, 7);
  for (int k = 0; k < 40; ++k) charts.add(shapes::transformed(shapes::star(), 0.001 * (k + 1), k, {0, 0}));
  charts.add(shapes::rectangle(4, 1e-4));
  pack(charts, {.gap = 1e-3});
}

/// By far the most of the box is gap then: on a grid that suited the charts, rasters would have thousands of cells a side and
/// strips hold few of them. Seven points in a square of side 1 are at best 0.5359 apart.
TEST(PackCharts, MuchSmallerThanTheGap) {
  constexpr double kGap = 1000;
  EXPECT_LT(pack(random_charts(7, 3), {.gap = kGap, .box_aspect = 1}).box.size().x(), 1.2 * kGap / 0.5359);
}

TEST(PackCharts, ALayoutGetsALargerGapWithoutAnotherSearch) {
  for (const double aspect : {0.0, 1.0}) {
    const Charts charts = random_charts(40, 40);
    const PackOptions options{.gap = 0.01, .box_aspect = aspect}, wider{.gap = 0.012, .box_aspect = aspect};
    const Packing packing = pack(charts, options);
    const auto apart = with_larger_gap(charts.outlines, charts.areas, packing, options.gap, wider);
    ASSERT_TRUE(apart);
    expect_sound(charts, wider, *apart);
    EXPECT_GT(apart->pe, 0.95 * packing.pe);
  }
}

TEST(PackCharts, FewChartsAndManyArePackedAnewForALargerGap) {
  for (const int count : {1, 8, kManyCharts + 1}) {
    Charts charts;
    for (int k = 0; k < count; ++k) charts.add(shapes::rectangle(1, 1));
    const PackOptions options{.gap = 0.01};
    EXPECT_FALSE(with_larger_gap(charts.outlines, charts.areas, pack(charts, options), options.gap, {.gap = 0.011}));
  }
}

TEST(PackCharts, SameBitsForEveryNumberOfThreads) {
  const Charts charts = random_charts(12, 3);
  PackOptions options{.gap = 0.01, .seed = 5};
  const Packing one = pack(charts, options);
  options.threads = 3;
  const Packing many = pack(charts, options);
  for (std::size_t i = 0; i < charts.outlines.size(); ++i) {
    EXPECT_EQ(one.placements[i].cosine, many.placements[i].cosine);
    EXPECT_EQ(one.placements[i].sine, many.placements[i].sine);
    EXPECT_EQ(one.placements[i].offset, many.placements[i].offset);
  }
}

TEST(PackCharts, StopsAtTheTarget) {
  const Charts charts = random_charts(12, 3);
  const Packing enough = pack(charts, {.gap = 0.01, .target_pe = 0.5});
  EXPECT_GE(enough.pe, 0.5);
  EXPECT_GT(pack(charts, {.gap = 0.01}).pe, enough.pe);
}

TEST(PackCharts, ManyChartsInFewSeconds) {
  Charts charts;
  for (int k = 0; k < 2000; ++k) {
    Rng rng(11, k);
    charts.add(shapes::transformed(shapes::random_star_polygon(k, 12), rng.uniform(0.3, 1), 0, {0, 0}));
  }
  const Packing packing = pack_charts(charts.outlines, charts.areas, {.gap = 0.01, .threads = 2});
  EXPECT_GT(packing.pe, 0.5);
}

/// Scraps among blobs: four charts of five are small.
Charts scraps_and_blobs(int count) {
  Charts charts;
  for (int k = 0; k < count; ++k) {
    Rng rng(12, k);
    const bool scrap = rng.uniform() < 0.8;
    const double size = (scrap ? 0.3 : 1.5) * std::exp(0.5 * rng.uniform(-1, 1));
    charts.add(shapes::transformed(scrap ? shapes::rectangle(1, 0.4) : shapes::random_star_polygon(k, 12), size, 0, {0, 0}));
  }
  return charts;
}

TEST(PackCharts, MoreChartsFillTheBoxAsWell) {
  const auto pe = [](int count) {
    const Charts charts = scraps_and_blobs(count);
    return pack_charts(charts.outlines, charts.areas, {.gap = 0.01, .threads = 2}).pe;
  };
  EXPECT_GT(pe(5000), pe(1100) - 0.02);
}

TEST(PackCharts, HundredsOfChartsNeedNoCompactionToFillTheBox) {
  const Charts charts = scraps_and_blobs(700);
  EXPECT_GT(pack_charts(charts.outlines, charts.areas, {.gap = 0.003}).pe, 0.82);
}

TEST(PackCharts, WorkIsNearlyLinearInCharts) {
  const auto work = [](int count) {
    const Charts charts = scraps_and_blobs(count);
    std::vector<GridChart> grid;
    const double cells = 256 * std::sqrt(count / 60.0), cell = std::sqrt(charts.area / 0.8) / cells;
    GreedyRule rule{.strip_width = static_cast<int>(cells), .many = true, .resume = true};
    for (const Outline& outline : charts.outlines) {
      auto& rasters = grid.emplace_back().rasters;
      for (const Turn& turn : turns_to_try(outline, 1)) rasters.push_back(rasterise(outline, turn, 0, cell));
      rule.order.push_back(static_cast<int>(rule.order.size()));
    }
    const auto size = [&](int chart) { return grid[chart].rasters[0].width * grid[chart].rasters[0].height; };
    std::stable_sort(rule.order.begin(), rule.order.end(), [&](int a, int b) { return size(a) > size(b); });
    Watch watch({});
    return static_cast<double>(place_greedily(grid, rule, watch).work);
  };
  EXPECT_LT(std::log2(work(4000) / work(1000)) / 2, 1.25);
}

/// Ticks of one packing, all in order.
int count_ticks(const Charts& charts, PackOptions options) {
  double last = 0;
  int ticks = 0;
  options.tick = [&](double fraction) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    ++ticks;
  };
  pack(charts, options);
  return ticks;
}

TEST(PackCharts, TicksInOrderAndCancels) {
  const Charts charts = random_charts(20, 9);
  for (const int threads : {1, 2}) {
    PackOptions options{.gap = 0.01, .threads = threads};
    const int all = count_ticks(charts, options);
    EXPECT_GT(all, 100);
    // Of several threads the one that ticks takes more or less of the work, so only one thread's last tick is known.
    std::vector<int> cancelled = {1, 50};
    if (threads == 1) cancelled.push_back(all - 1);
    for (const int cancelled_at : cancelled) {
      int ticks = 0;
      options.tick = [&](double) {
        if (++ticks == cancelled_at) throw std::runtime_error("cancelled");
      };
      EXPECT_THROW(pack_charts(charts.outlines, charts.areas, options), std::runtime_error);
      EXPECT_EQ(ticks, cancelled_at);
    }
  }
}

}  // namespace
}  // namespace atlas_refine
