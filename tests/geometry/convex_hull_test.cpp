// The hull is convex, made of input points and holds them all; judged by exact predicates.
#include "geometry/convex_hull.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/predicates.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

void expect_hull(const std::vector<Vec2>& points) {
  const std::vector<Vec2> hull = convex_hull(points);
  const std::size_t n = hull.size();
  ASSERT_GE(n, 3u);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 &a = hull[k], &b = hull[(k + 1) % n];
    EXPECT_NE(std::find(points.begin(), points.end(), a), points.end());
    EXPECT_EQ(orientation(a, b, hull[(k + 2) % n]), 1);
    for (const Vec2& p : points) EXPECT_GE(orientation(a, b, p), 0);
  }
}

TEST(ConvexHull, OfRandomPoints) {
  for (int seed = 0; seed < 20; ++seed) {
    Rng rng(seed);
    std::vector<Vec2> points;
    for (int k = 0; k < 100; ++k) points.emplace_back(rng.uniform(), rng.uniform());
    expect_hull(points);
  }
}

// Tenths are not exact in binary, so the points of a turned grid's rows are collinear but for their last bits.
TEST(ConvexHull, OfAlmostCollinearPoints) {
  std::vector<Vec2> points;
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 20; ++column) points.emplace_back(0.1 * column - 0.3 * row, 0.3 * column + 0.1 * row);
  }
  expect_hull(points);
}

TEST(ConvexHull, OfPointsOnALine) {
  EXPECT_EQ(convex_hull({{1, 1}, {1, 1}, {1, 1}}), (std::vector<Vec2>{{1, 1}}));
  const std::vector<Vec2> ends = convex_hull({{1, 1}, {0, 0}, {3, 3}, {2, 2}, {0, 0}});
  EXPECT_EQ(ends.size(), 2u);
  EXPECT_NE(std::find(ends.begin(), ends.end(), Vec2(0, 0)), ends.end());
  EXPECT_NE(std::find(ends.begin(), ends.end(), Vec2(3, 3)), ends.end());
  EXPECT_TRUE(convex_hull({}).empty());
}

}  // namespace
}  // namespace atlas_refine
