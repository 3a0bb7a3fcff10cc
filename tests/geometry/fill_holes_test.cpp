// Holes of a square.
#include "geometry/fill_holes.h"

#include <gtest/gtest.h>

#include "charts.h"
#include "geometry/plane.h"
#include "geometry/tutte.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

Chart with_two_holes() {
  shapes::Polygon square = shapes::rectangle(10, 10);
  for (const double x : {2.5, 7.5}) {
    const shapes::Polygon hole = shapes::transformed(shapes::disk(1.5, 12), 1, 0, {x, 5});
    square.holes.emplace_back(hole.outer.rbegin(), hole.outer.rend());
  }
  return testing::charts_of(shapes::mesh(square, 0.7)).front();
}

double area(const Chart& chart, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    const double own = 0.5 * doubled_area(chart.uvs[t[0]], chart.uvs[t[1]], chart.uvs[t[2]]);
    EXPECT_GT(own, 0);
    sum += own;
  }
  return sum;
}

TEST(FillHoles, AsInUvsLeavesNothingEmpty) {
  const Chart chart = with_two_holes();
  const Filling filling = fill_as_in_uvs(chart, longest_loop(chart));
  EXPECT_TRUE(filling.fans.empty());
  const Vec2 box = uv_box({chart}).size();
  EXPECT_NEAR(area(chart, chart.triangles) + area(chart, filling.triangles), box.prod(), 1e-9 * box.prod());
}

TEST(FillHoles, WhoseBordersCrossGetAFan) {
  Chart chart = with_two_holes();
  const std::size_t outer = longest_loop(chart);
  ASSERT_EQ(outer, 0U);
  std::swap(chart.uvs[chart.boundary_loops[1][0]], chart.uvs[chart.boundary_loops[1][4]]);
  const Filling filling = fill_as_in_uvs(chart, outer);
  EXPECT_EQ(filling.fans, std::vector<std::size_t>{1});
  EXPECT_FALSE(filling.triangles.empty());
  EXPECT_EQ(fill_by_fans(chart, outer).fans, (std::vector<std::size_t>{1, 2}));
}

}  // namespace
}  // namespace atlas_refine
