// A polygon that has become concave is mended, and only around it.
#include "repair/convex_again.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "charts.h"
#include "measure/certificate.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

/// Cells of six corners, one corner of an inner cell pulled in so far that the cell is concave, yet its triangles stay positive.
Chart with_dent() {
  Chart chart = testing::charts_of(shapes::honeycomb(8, 8)).at(0);
  const Vec2 middle = chart.uvs[chart.guards[chart.guards.size() / 2].triangle[0]];
  const int v = chart.guards[chart.guards.size() / 2].triangle[1];
  for (double part = 0.1; part < 1 && all_guards_hold(chart); part += 0.1) {
    Chart dented = chart;
    dented.uvs[v] += part * (middle - dented.uvs[v]);
    if (!certify_charts({dented}).valid()) break;
    chart = dented;
  }
  return chart;
}

TEST(ConvexAgain, ADentIsTakenOutAndNothingFarMoves) {
  const Chart dented = with_dent();
  ASSERT_FALSE(all_guards_hold(dented));
  Monitor monitor;
  const Chart mended = convex_again(dented, 1, monitor);
  EXPECT_TRUE(all_guards_hold(mended));
  testing::expect_certified({mended});
  int moved = 0;
  for (int v = 0; v < dented.vertex_count(); ++v) moved += mended.uvs[v] != dented.uvs[v];
  EXPECT_GT(moved, 0);
  EXPECT_LT(moved, dented.vertex_count() / 2);
  EXPECT_TRUE(testing::same_bits(mended.uvs, convex_again(dented, 2, monitor).uvs));
}

TEST(ConvexAgain, WhatIsConvexStaysBitForBit) {
  const Chart chart = testing::charts_of(shapes::honeycomb(4, 4)).at(0);
  Monitor monitor;
  EXPECT_TRUE(testing::same_bits(convex_again(chart, 1, monitor).uvs, chart.uvs));
}

}  // namespace
}  // namespace atlas_refine
