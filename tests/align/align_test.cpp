// Stage 1 as a whole: axis-aligned charts at the surface's scale, the same for every number of threads.
#include "align/align.h"

#include "cut_checks.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

std::vector<Chart> many_charts() {
  std::vector<Chart> charts = {testing::charts_of(shapes::self_overlapping()).front()};
  for (const shapes::Named& shape : testing::many_polygons()) charts.push_back(testing::chart_of(shape.polygon, 0.12));
  return charts;
}

TEST(Align, EveryChartIsAxisAlignedWithoutFlips) {
  const std::vector<Chart> charts = many_charts();
  const std::vector<AxisAlignedChart> out = testing::aligned(charts, 0.004);
  ASSERT_EQ(out.size(), charts.size());
  for (std::size_t c = 0; c < out.size(); ++c) {
    SCOPED_TRACE(c);
    EXPECT_EQ(out[c].way, AxisAlignedChart::Way::Deformed);
    testing::expect_conforming(out[c].mesh);
    testing::expect_positive(out[c].mesh.uvs, out[c].mesh.triangles);
    testing::expect_axis_aligned(out[c]);
    EXPECT_EQ(out[c].holes_cut, static_cast<int>(charts[c].boundary_loops.size()) - 1);
    const Chart chart = out[c].mesh.to_chart(charts[c]);
    EXPECT_NEAR(dirichlet_sums({chart}).best_scale(), 1, 1e-9);
    EXPECT_LT(dirichlet_sums({chart}).best_energy(), 1.6);
    EXPECT_NEAR(testing::rest_area(chart), testing::rest_area(charts[c]), 1e-12);
  }
}

TEST(Align, ThreadsChangeNothing) {
  const std::vector<Chart> charts = many_charts();
  Monitor monitor;
  const auto one = align_charts(charts, {0.01, 1}, monitor), two = align_charts(charts, {0.01, 2}, monitor);
  for (std::size_t c = 0; c < charts.size(); ++c) {
    EXPECT_TRUE(testing::same_bits(one[c].mesh.uvs, two[c].mesh.uvs));
    EXPECT_EQ(one[c].quarter_turns, two[c].quarter_turns);
  }
}

TEST(Align, ChartsThatAreNotToBendStayAsTheyAre) {
  const std::vector<Chart> charts = testing::charts_of(unit_square());
  Monitor monitor;
  const auto out = align_charts(charts, {.freedom = {Freedom::Moves}}, monitor);
  EXPECT_EQ(out[0].way, AxisAlignedChart::Way::AsItIs);
  EXPECT_TRUE(out[0].boundary.empty());
  Chart chart = charts[0];
  chart.uvs = out[0].mesh.uvs;
  EXPECT_NEAR(dirichlet_sums({chart}).best_energy(), 1, 1e-12);
  EXPECT_NEAR(uv_box({chart}).area(), 1, 1e-9);
}

// One face of two triangles is a chart like any other.
TEST(Align, ChartsOfOneFaceAreAligned) {
  const auto out = testing::aligned(testing::charts_of(unit_square()));
  EXPECT_EQ(out[0].way, AxisAlignedChart::Way::Deformed);
  EXPECT_FALSE(out[0].boundary.empty());
}

int corner_count(const AxisAlignedChart& chart) {
  const std::vector<int> turns = corner_turns(chart.quarter_turns);
  return static_cast<int>(std::count_if(turns.begin(), turns.end(), [](int k) { return k != 0; }));
}

/// Ends shorter than the least segment of the usual sigma, straight and slanted.
TEST(Align, NarrowStripsKeepTheirEnds) {
  for (const double width : {0.01, 0.003}) {
    for (const double slant : {0.0, 0.1 * width}) {
      SCOPED_TRACE(width);
      const shapes::Polygon strip{{{0, 0}, {1, 0}, {1 + slant, width}, {slant, width}}, {}};
      const std::vector<Chart> charts = testing::charts_of(shapes::mesh(shapes::transformed(strip, 1, 0.3, {0, 0}), 0.25, 0));
      const AxisAlignedChart out = testing::aligned(charts, 0.004).front();
      EXPECT_EQ(out.way, AxisAlignedChart::Way::Deformed);
      testing::expect_axis_aligned(out);
      EXPECT_EQ(corner_count(out), 4);
      EXPECT_LT(dirichlet_sums(out.mesh.to_chart(charts[0])).best_energy(), 1.02);
    }
  }
}

/// So steep a surface that no plane chart of it is good: aligned, it is better than it was.
TEST(Align, WhatWasWorseBeforeIsNotTooDistorted) {
  const std::vector<Chart> charts = testing::charts_of(shapes::mesh(shapes::c_shape(), 0.1, 60));
  const AxisAlignedChart out = testing::aligned(charts, 0.004).front();
  EXPECT_EQ(out.way, AxisAlignedChart::Way::Deformed);
  const double before = dirichlet_sums(charts).best_energy(), after = dirichlet_sums(out.mesh.to_chart(charts[0])).best_energy();
  EXPECT_GT(after, 4);
  EXPECT_LT(after, before);
}

TEST(Align, LargerSigmaGivesFewerCorners) {
  const std::vector<Chart> charts = {testing::chart_of(shapes::comb(8), 0.05)};
  const auto corners = [&](double sigma) { return corner_count(testing::aligned(charts, sigma)[0]); };
  EXPECT_GT(corners(0.002), corners(0.1));
}

}  // namespace
}  // namespace atlas_refine
