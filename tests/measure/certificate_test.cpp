// The certificate: what it accepts, and every kind of overlap that it must find.
#include "measure/certificate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "input/split_charts.h"
#include "shapes.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

std::vector<Chart> placed(const Atlas& atlas) { return charts_as_placed(split_charts(atlas)); }

TEST(Certificate, AcceptsGoodAtlases) {
  for (const shapes::Named& named : shapes::named_polygons()) {
    EXPECT_EQ(certify_charts(placed(shapes::mesh(named.polygon))).problem, "") << named.name;
  }
  EXPECT_TRUE(certify_charts(placed(shapes::two_squares(0.01))).valid());
  EXPECT_TRUE(certify_charts(placed(shapes::disk_in_ring())).valid());
  EXPECT_TRUE(certify_charts(placed(shapes::squares(50))).valid());
  EXPECT_TRUE(validate(shapes::quad_grid(5, 4)).valid());
}

TEST(Certificate, FindsFlips) {
  const Validity validity = validate(shapes::with_flipped_face(shapes::mesh(shapes::rectangle(1, 1), 0.1)));
  EXPECT_FALSE(validity.valid());
  EXPECT_GT(validity.flipped_faces, 0);
  EXPECT_EQ(validity.chart, 0);
  EXPECT_GE(validity.face, 0);
}

TEST(Certificate, FindsChartsThatTouchOrCross) {
  EXPECT_GT(validate(shapes::touching_charts()).crossings, 0);
  EXPECT_GT(validate(shapes::two_squares(-0.1)).crossings, 0);
  EXPECT_EQ(validate(shapes::two_squares(std::ldexp(1.0, -40))).crossings, 0);
}

TEST(Certificate, FindsAChartThatCrossesItself) {
  const Validity validity = validate(shapes::self_overlapping());
  EXPECT_EQ(validity.flipped_faces, 0);
  EXPECT_GT(validity.crossings, 0);
  EXPECT_NE(validity.problem.find("touches or crosses itself"), std::string::npos) << validity.problem;
}

TEST(Certificate, FindsAChartInsideAnother) {
  const Atlas large = shapes::mesh(shapes::rectangle(1, 1), 0.2);
  const Atlas small = shapes::mesh(shapes::transformed(shapes::rectangle(0.2, 0.2), 1, 0.3, {0.4, 0.4}), 0.1);
  for (const Atlas& atlas : {shapes::combine({large, small}), shapes::combine({small, large})}) {
    const Validity validity = validate(atlas);
    EXPECT_EQ(validity.crossings, 0);
    EXPECT_NE(validity.problem.find("overlaps chart"), std::string::npos) << validity.problem;
  }
}

TEST(Certificate, FindsTheSameChartTwice) {
  const Atlas square = unit_square();
  EXPECT_FALSE(validate(shapes::combine({square, square})).valid());
}

/// A ring that winds twice around: two nested counterclockwise loops and no crossing, all triangles positive. The two branch
/// points inside it have an angle sum of 4 pi.
TEST(Certificate, FindsAnOverlapThatNoBoundaryShows) {
  Chart chart;
  // A disk, and a second disk glued to it along a slit of one edge, crosswise: sheets change at the slit.
  // Vertices: slit ends p, q; outer hexagon of each sheet.
  chart.uvs = {{-0.2, 0}, {0.2, 0}};
  for (double radius : {1.0, 2.0}) {
    for (int i = 0; i < 6; ++i) chart.uvs.push_back({radius * std::cos(i * M_PI / 3), radius * std::sin(i * M_PI / 3)});
  }
  for (int sheet = 0; sheet < 2; ++sheet) {
    const auto outer = [&](int i) { return 2 + 6 * sheet + i % 6; };
    for (int i : {0, 5}) chart.triangles.push_back({1, outer(i), outer(i + 1)});
    for (int i : {2, 3}) chart.triangles.push_back({0, outer(i), outer(i + 1)});
    chart.triangles.push_back({1, outer(1), outer(2)});
    chart.triangles.push_back({0, outer(4), outer(5)});
    chart.triangles.push_back({0, 1, outer(2)});  // above the slit
    chart.triangles.push_back({1, 0, outer(5)});  // below the slit: on the other sheet's side it is joined crosswise
    std::vector<int> loop;
    for (int i = 0; i < 6; ++i) loop.push_back(outer(i));
    chart.boundary_loops.push_back(loop);
  }
  chart.triangle_faces.assign(chart.triangles.size(), 0);
  const Validity validity = certify_charts({chart});
  EXPECT_EQ(validity.flipped_faces, 0);
  EXPECT_EQ(validity.crossings, 0);
  EXPECT_NE(validity.problem.find("overlaps itself"), std::string::npos) << validity.problem;
}

/// One chart of two triangles that meet at (0, 0).
Validity pinched(const Vec2& second_from, const Vec2& second_to, bool one_point) {
  Chart chart;
  chart.uvs = {{0, 0}, {1, -0.2}, {1, 0.2}, {0, 0}, second_from, second_to};
  chart.triangles = {{0, 1, 2}, {3, 4, 5}};
  chart.triangle_faces = {0, 1};
  chart.boundary_loops = {{0, 1, 2}, {3, 4, 5}};
  return certify_charts({chart}, {{0, 1, 2, one_point ? 0 : 3, 4, 5}});
}

TEST(Certificate, APinchIsNoContactWhereTheFansStayApart) {
  EXPECT_TRUE(pinched({-1, 0.2}, {-1, -0.2}, true).valid());
  EXPECT_FALSE(pinched({-1, 0.2}, {-1, -0.2}, false).valid());
  EXPECT_TRUE(pinched({0.9, 0.9}, {-0.9, 0.8}, true).valid());
  EXPECT_EQ(pinched({0.9, 0.9}, {-0.9, 0.8}, true).crossings, 0);
}

TEST(Certificate, FansThatReachIntoEachOtherAreAContact) {
  EXPECT_FALSE(pinched({0.9, 0}, {-0.9, 0.8}, true).valid());     // begins inside the first
  EXPECT_FALSE(pinched({0.5, 0.05}, {0.5, 0.08}, true).valid());  // lies inside it
  EXPECT_FALSE(pinched({2, -0.5}, {2, 0.5}, true).valid());       // lies around it
  EXPECT_FALSE(pinched({0.5, 0.1}, {-0.9, 0.8}, true).valid());   // shares a side with it
}

TEST(Certificate, AHoleWhoseCornersAreAllPinchesIsLeftOpen) {
  Chart chart;
  std::vector<int> points;
  for (const int corner : {0, 2, 5, 8, 10}) {  // a checkerboard: every inner vertex belongs to two quads
    const int x = corner % 4, y = corner / 4, first = chart.vertex_count();
    for (const auto& [dx, dy] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
      chart.uvs.push_back({static_cast<double>(x + dx), static_cast<double>(y + dy)});
      points.push_back((y + dy) * 4 + x + dx);
    }
    chart.triangles.push_back({first, first + 1, first + 2});
    chart.triangles.push_back({first, first + 2, first + 3});
    chart.boundary_loops.push_back({first, first + 1, first + 2, first + 3});
  }
  chart.triangle_faces.assign(chart.triangles.size(), 0);
  EXPECT_TRUE(certify_charts({chart}, {points}).valid()) << certify_charts({chart}, {points}).problem;
  // A small chart in one of the holes is apart from it; one inside a quad is not.
  for (const auto& [x, valid] : {std::pair(1.2, true), {0.2, false}}) {
    Chart small;
    small.uvs = {{x, 0.3}, {x + 0.4, 0.3}, {x + 0.2, 0.6}};
    small.triangles = {{0, 1, 2}};
    small.triangle_faces = {0};
    small.boundary_loops = {{0, 1, 2}};
    EXPECT_EQ(certify_charts({chart, small}, {points, {100, 101, 102}}).valid(), valid) << x;
  }
}

TEST(Certificate, ALoopThatTouchesItselfAtAPinchIsStillWound) {
  // A ring that is closed by a touch only: two tips meet at P, and the loop around it comes to P twice.
  Atlas atlas = flat_atlas({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {1, 1, 0}},
                           {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 8, 7}});
  // The last quad ends at a corner of its own: the ring is open there from (0, 0) to (1, 1), and folded out at the outer corner.
  atlas.positions.push_back({-1, 1, 0});
  atlas.corner_vertices[13] = 9;
  atlas.corner_uvs[13] = {-1, 1};
  EXPECT_TRUE(validate(atlas).valid()) << validate(atlas).problem;
  const ChartSet set = split_charts(atlas);
  ASSERT_EQ(set.charts.size(), 1u);
  EXPECT_EQ(set.charts[0].boundary_loops.size(), 1u);
  // A chart inside the ring's hole is apart from it.
  const Atlas inside = shapes::mesh(shapes::transformed(shapes::rectangle(0.2, 0.2), 1, 0.3, {1.4, 1.4}), 0.2);
  EXPECT_TRUE(validate(shapes::combine({atlas, inside})).valid());
}

TEST(Certificate, CountsMirroredCharts) {
  const Validity validity = validate(shapes::mirrored(shapes::two_squares(0.1)));
  EXPECT_EQ(validity.mirrored_charts, 2);
  EXPECT_EQ(validity.flipped_faces, 0);
  EXPECT_EQ(validity.crossings, 0);
  EXPECT_EQ(validity.problem, "chart 0 is mirrored");
}

TEST(Certificate, ManyStackedChartsEnd) {
  std::vector<Atlas> stack(300, unit_square());
  EXPECT_EQ(validate(shapes::combine(stack)).crossings, 10000);
}

TEST(Certificate, FixedChartsMayOverlapEachOtherButNobodyElse) {
  // Two squares on each other, and a third beside, across or within them.
  const auto squares = [](double x, double size) {
    const auto square = [](double side, const Vec2& at) {
      return shapes::mesh(shapes::transformed(shapes::rectangle(1, 1), side, 0, at), 0.3);
    };
    return split_charts(shapes::combine({square(1, {0, 0}), square(1, {0.5, 0.2}), square(size, {x, 0.3})})).charts;
  };
  const Freedoms two = {Freedom::Fixed, Freedom::Fixed, Freedom::Moves};
  const std::vector<Chart> beside = squares(2, 1), across = squares(1.2, 1), in_one = squares(0.1, 0.2),
                           in_both = squares(0.7, 0.2);
  EXPECT_TRUE(certify_charts(beside, {}, two).valid());
  EXPECT_FALSE(certify_charts(beside).valid());
  EXPECT_FALSE(certify_charts(beside, {}, {Freedom::Fixed, Freedom::Bends, Freedom::Bends}).valid());
  EXPECT_FALSE(certify_charts(across, {}, two).valid());
  EXPECT_FALSE(certify_charts(in_one, {}, two).valid());
  EXPECT_FALSE(certify_charts(in_both, {}, two).valid());
  EXPECT_TRUE(certify_charts(in_one, {}, {Freedom::Fixed, Freedom::Fixed, Freedom::Fixed}).valid());
  EXPECT_NEAR(gap_between_charts(beside, two), 0.5, 1e-12);
  EXPECT_EQ(gap_between_charts(beside), 0);
  EXPECT_EQ(gap_between_charts(across, two), 0);
}

TEST(Gaps, BetweenTwoSquares) {
  EXPECT_NEAR(gap_between_charts(placed(shapes::two_squares(0.125))), 0.125, 1e-12);
  EXPECT_EQ(gap_between_charts(placed(shapes::touching_charts())), 0);
  EXPECT_EQ(gap_between_charts(placed(shapes::two_squares(-0.25))), 0);  // crossing
  EXPECT_EQ(gap_between_charts(placed(unit_square())), std::numeric_limits<double>::infinity());
}

TEST(Gaps, BetweenADiskAndTheRingAroundIt) {
  const std::vector<Chart> charts = placed(shapes::disk_in_ring());
  double expected = std::numeric_limits<double>::infinity();
  for (const Vec2& p : charts[0].uvs) {
    for (const Vec2& q : charts[1].uvs) expected = std::min(expected, (p - q).norm());
  }
  const double gap = gap_between_charts(charts);
  EXPECT_LE(gap, expected);
  EXPECT_GT(gap, 0.8 * expected);
}

TEST(Gaps, WithinASlit) {
  // A square with a slit 0.02 wide from the right edge to the middle, wide open at no other place.
  const shapes::Polygon slit{{{0, 0}, {1, 0}, {1, 0.49}, {0.5, 0.49}, {0.5, 0.51}, {1, 0.51}, {1, 1}, {0, 1}}, {}};
  const std::vector<Chart> charts = placed(shapes::mesh(slit, 0.05, 0));
  EXPECT_NEAR(gap_within_charts(charts, 0.1, 0.1)[0], 0.02, 1e-12);
  EXPECT_EQ(gap_within_charts(charts, 0.1, 0.01)[0], std::numeric_limits<double>::infinity());  // out of reach
  EXPECT_EQ(gap_within_charts(charts, 2.5, 0.1)[0], std::numeric_limits<double>::infinity());   // no points that far apart
}

TEST(Gaps, WithinAConvexChartThereIsNone) {
  EXPECT_EQ(gap_within_charts(placed(shapes::mesh(shapes::disk(0.5))), 0.05, 1)[0], std::numeric_limits<double>::infinity());
}

TEST(Gaps, AThinNeckIsNoGap) {
  // Two squares joined by a bridge 0.02 wide: its borders face each other through the chart.
  const shapes::Polygon neck{{{0, 0},
                              {0.4, 0},
                              {0.4, 0.19},
                              {0.6, 0.19},
                              {0.6, 0},
                              {1, 0},
                              {1, 0.4},
                              {0.6, 0.4},
                              {0.6, 0.21},
                              {0.4, 0.21},
                              {0.4, 0.4},
                              {0, 0.4}},
                             {}};
  EXPECT_NEAR(gap_within_charts(placed(shapes::mesh(neck, 0.05, 0)), 0.45, 1)[0], 0.2, 1e-9);
}

}  // namespace
}  // namespace atlas_refine
