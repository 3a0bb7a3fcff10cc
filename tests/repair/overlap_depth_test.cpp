// How deep a chart lies on itself, told by rings around its bad triangles.
#include "repair/overlap_depth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "charts.h"
#include "measure/certificate.h"
#include "repair/untangle_chart.h"
#include "repair_checks.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

constexpr int kColumns = 60, kRows = 6;

/// Where a column and a row of the strip are that goes `turns` times around, each turn 0.4 rows farther out.
Vec2 at(double column, double row, double turns) {
  const double turn = turns * column / kColumns, angle_rad = 2 * std::numbers::pi * turn;
  return (10 - row + 0.4 * turn) * Vec2(std::cos(angle_rad), std::sin(angle_rad));
}

Atlas ring_of(double turns) {
  Atlas atlas = shapes::quad_grid(kColumns, kRows);
  for (Vec2& corner : atlas.corner_uvs) corner = at(kColumns * corner.x(), kColumns * corner.y(), turns);
  return atlas;
}

/// One inner vertex lies beyond its neighbours, halfway around.
Chart ring_with_a_flip(double turns) {
  const Vec2 place = at(30, 3, turns);
  return testing::charts_of(testing::with_vertex_moved(ring_of(turns), place, at(31.5, 3, turns) - place)).at(0);
}

/// The depth where rings are the columns from that vertex on.
int depth_by_columns(double turns) {
  const Chart flat = testing::charts_of(shapes::quad_grid(kColumns, kRows)).at(0);
  std::vector<int> ring;
  for (const Vec2& uv : flat.uvs) ring.push_back(std::abs(static_cast<int>(std::lround(kColumns * uv.x())) - 30));
  return overlap_depth(testing::charts_of(ring_of(turns)).at(0), ring);
}

TEST(OverlapDepth, IsZeroWhereAChartLiesOnItselfNowhere) { EXPECT_EQ(depth_by_columns(0.9), 0); }

TEST(OverlapDepth, BordersThatAllButTouchDoNotCount) {
  EXPECT_FALSE(certify_charts(testing::charts_of(ring_of(1.0001))).valid());
  EXPECT_EQ(depth_by_columns(1.0001), 0);
}

TEST(OverlapDepth, IsThatOfTheFarthestVertexAndTriangle) {
  // Vertices of the last column, 30 away, lie in triangles from 29 on. Where 3.5 columns lie on each other, those of the third
  // last, 28 away, do so in triangles from 28 on.
  EXPECT_EQ(depth_by_columns(60.25 / 60), 29);
  EXPECT_EQ(depth_by_columns(60 / 56.5), 28);
}

TEST(OverlapDepth, AChartThatLiesOnItselfFarFromItsFlipIsNotMendedInPlace) {
  Monitor monitor;
  EXPECT_TRUE(untangle_chart(ring_with_a_flip(0.9), false, 1, monitor));
  EXPECT_FALSE(untangle_chart(ring_with_a_flip(1.5), false, 1, monitor));
  EXPECT_TRUE(untangle_chart(ring_with_a_flip(1.5), true, 1, monitor)) << "where it may overlap itself";
}

}  // namespace
}  // namespace atlas_refine
