// Which charts are laid onto an axis: panels, planks and letters, not blobs.
#include "pack/straight_border.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "charts.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

Chart chart_of(const shapes::Polygon& polygon) { return testing::charts_of(shapes::mesh(polygon, 0.05))[0]; }

/// Of all borders' length the part that lies on an axis.
double axis_parallel_share(const Chart& chart) {
  double on_axis = 0, all = 0;
  const auto& loop = chart.boundary_loops.front();
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec2 edge = chart.uvs[loop[(k + 1) % loop.size()]] - chart.uvs[loop[k]];
    all += edge.norm();
    if (edge.cwiseAbs().minCoeff() < 1e-9 * edge.norm()) on_axis += edge.norm();
  }
  return on_axis / all;
}

const shapes::Polygon kLetter{{{0, 0},
                               {0.6, 0},
                               {0.6, 0.2},
                               {0.2, 0.2},
                               {0.2, 0.4},
                               {0.5, 0.4},
                               {0.5, 0.6},
                               {0.2, 0.6},
                               {0.2, 0.8},
                               {0.6, 0.8},
                               {0.6, 1},
                               {0, 1}},
                              {}};

TEST(StraightBorder, PanelsPlanksAndLettersAreLaidOntoAnAxisExactly) {
  for (const shapes::Polygon& polygon : {shapes::rectangle(1, 0.7), shapes::rectangle(1, 0.05), kLetter, shapes::comb()}) {
    for (const double turn_rad : {0.3, -0.2, 1.1, 2.9, 0.0}) {
      Chart chart = chart_of(shapes::transformed(polygon, 2, turn_rad, {1, 3}));
      const auto turn = turn_onto_axis(chart);
      ASSERT_TRUE(turn);
      EXPECT_LE(std::abs(turn->sine), std::sin(0.2501 * std::numbers::pi));  // the smallest turn that does it
      EXPECT_NEAR(turn->cosine * turn->cosine + turn->sine * turn->sine, 1, 1e-14);
      for (Vec2& uv : chart.uvs) uv = turn->apply(uv);
      EXPECT_GT(axis_parallel_share(chart), 0.99) << turn_rad;
    }
  }
}

TEST(StraightBorder, WhatLiesOnAnAxisIsNotTurned) {
  const auto turn = turn_onto_axis(chart_of(shapes::rectangle(1, 0.4)));
  ASSERT_TRUE(turn);
  EXPECT_EQ(turn->cosine, 1);
  EXPECT_EQ(turn->sine, 0);
}

TEST(StraightBorder, OneStraightSideOfARoundChartIsEnough) {
  shapes::Polygon half = shapes::disk(0.5, 96);
  std::erase_if(half.outer, [](const Vec2& p) { return p.y() < -1e-9; });
  Chart chart = chart_of(shapes::transformed(half, 1, 0.4, {0, 0}));
  const auto turn = turn_onto_axis(chart);
  ASSERT_TRUE(turn);
  EXPECT_NEAR(std::atan2(turn->sine, turn->cosine), -0.4, 1e-9);
}

TEST(StraightBorder, BlobsAreLeftAlone) {
  EXPECT_FALSE(turn_onto_axis(chart_of(shapes::disk(0.5, 24))));
  EXPECT_FALSE(turn_onto_axis(chart_of(shapes::disk(0.5, 200))));
  EXPECT_FALSE(turn_onto_axis(chart_of(shapes::spiral())));
}

}  // namespace
}  // namespace atlas_refine
