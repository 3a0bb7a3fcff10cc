// Rest shapes keep lengths, and slivers never give infinities.
#include "geometry/rest_triangle.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace atlas_refine {
namespace {

TEST(RestTriangle, KeepsLengthsAndArea) {
  const Vec3 a(1, 2, 3), b(4, 0, 5), c(-1, 3, 7);
  const RestTriangle rest = rest_from_space(a, b, c);
  const Mat2 edges = rest.inverse_edges.inverse();
  EXPECT_NEAR(edges.col(0).norm(), (b - a).norm(), 1e-12);
  EXPECT_NEAR(edges.col(1).norm(), (c - a).norm(), 1e-12);
  EXPECT_NEAR((edges.col(1) - edges.col(0)).norm(), (c - b).norm(), 1e-12);
  EXPECT_NEAR(0.5 * edges.determinant(), rest.area, 1e-12);
  EXPECT_GT(rest.area, 0);
}

TEST(RestTriangle, SliversHaveNoShape) {
  EXPECT_EQ(rest_from_space({0, 0, 0}, {1, 0, 0}, {0.5, 1e-9, 0}).area, 0);
  EXPECT_EQ(rest_from_space({0, 0, 0}, {1, 0, 0}, {2, 0, 0}).area, 0);
  EXPECT_EQ(rest_from_space({1, 1, 1}, {1, 1, 1}, {1, 1, 1}).area, 0);
  EXPECT_EQ(rest_from_space({0, 0, 0}, {1e-200, 0, 0}, {0, 1e-200, 0}).area, 0);
  EXPECT_EQ(rest_from_plane({0, 0}, {0, 1}, {1, 0}, 1).area, 0);  // clockwise
  EXPECT_GT(rest_from_space({0, 0, 0}, {1, 0, 0}, {0.5, 1e-5, 0}).area, 0);
}

TEST(RestTriangle, ARaisedSliverKeepsItsLongestSide) {
  const std::array<Vec3, 3> line = {Vec3(0, 0, 0), Vec3(3, 0, 4), Vec3(1.5, 0, 2)};
  for (int turn = 0; turn < 3; ++turn) {
    const RestTriangle rest = rest_raised(line[turn], line[(turn + 1) % 3], line[(turn + 2) % 3], 0.02);
    const Mat2 edges = rest.inverse_edges.inverse();
    EXPECT_NEAR(std::max({edges.col(0).norm(), edges.col(1).norm(), (edges.col(1) - edges.col(0)).norm()}), 5, 1e-12);
    EXPECT_NEAR(rest.area, 0.5 * 5 * (0.02 * 5), 1e-12);
    EXPECT_GT(edges.determinant(), 0);
  }
  EXPECT_GT(rest_raised({0, 0, 0}, {0, 0, 0}, {1, 0, 0}, 0.02).area, 0);  // two corners at one point
  EXPECT_EQ(rest_raised({1, 1, 1}, {1, 1, 1}, {1, 1, 1}, 0.02).area, 0);
}

TEST(RestTriangle, ARaisedTriangleThatIsHighEnoughIsItself) {
  const Vec3 a(1, 2, 3), b(4, 0, 5), c(-1, 3, 7);
  const Mat2 edges = rest_raised(a, b, c, 0.02).inverse_edges.inverse();
  EXPECT_NEAR(edges.col(0).norm(), (b - a).norm(), 1e-12);
  EXPECT_NEAR(edges.col(1).norm(), (c - a).norm(), 1e-12);
}

TEST(RestTriangle, ThePlaneAtAScale) {
  const RestTriangle rest = rest_from_plane({0, 0}, {1, 0}, {0, 1}, 3);
  EXPECT_NEAR(rest.area, 4.5, 1e-12);
  EXPECT_NEAR((rest.inverse_edges - Mat2::Identity() / 3).norm(), 0, 1e-12);
}

TEST(RestTriangle, TheEquilateral) {
  const Mat2 edges = rest_equilateral(2).inverse_edges.inverse();
  EXPECT_NEAR(0.5 * edges.determinant(), 2, 1e-12);
  EXPECT_NEAR(edges.col(0).norm(), edges.col(1).norm(), 1e-12);
  EXPECT_NEAR(edges.col(0).norm(), (edges.col(1) - edges.col(0)).norm(), 1e-12);
}

}  // namespace
}  // namespace atlas_refine
