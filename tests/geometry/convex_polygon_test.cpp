// Convexity: exact, and by a margin that affine maps leave alone.
#include "geometry/convex_polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace atlas_refine {
namespace {

std::vector<Vec2> regular(int corners) {
  std::vector<Vec2> out;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    out.emplace_back(std::cos(angle), std::sin(angle));
  }
  return out;
}

std::vector<Vec3> lifted(const std::vector<Vec2>& polygon, const Vec3& u, const Vec3& v) {
  std::vector<Vec3> out;
  for (const Vec2& p : polygon) out.push_back(p.x() * u + p.y() * v);
  return out;
}

TEST(ConvexPolygon, RegularPolygonsAreClearlyConvexHoweverManyCornersTheyHave) {
  for (const int corners : {3, 4, 5, 8, 32, 100}) {
    std::vector<Vec2> polygon = regular(corners);
    EXPECT_TRUE(is_clearly_convex(polygon)) << corners;
    EXPECT_TRUE(is_clearly_convex(lifted(polygon, {0, 1, 0}, {0, 0, -3}))) << corners;
    for (Vec2& p : polygon) p = {1000 * p.x() + 3 * p.y(), p.y()};
    EXPECT_TRUE(is_clearly_convex(polygon)) << "sheared, " << corners;
  }
}

TEST(ConvexPolygon, ACornerInTheMiddleOfASideIsNotConvex) {
  const std::vector<Vec2> divided = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}};
  EXPECT_FALSE(is_strictly_convex(divided));
  EXPECT_FALSE(is_clearly_convex(lifted(divided, {1, 0, 0}, {0, 1, 0})));
  std::vector<Vec2> bulging = divided;
  bulging[1].y() = std::nextafter(0.0, -1.0);
  EXPECT_TRUE(is_strictly_convex(bulging)) << "exact to the last bit";
  EXPECT_FALSE(is_clearly_convex(bulging));
}

TEST(ConvexPolygon, ANearlyStraightCornerIsNotClearlyConvexYetAboveNoise) {
  std::vector<Vec2> octagon = regular(8);
  const Vec2 chord = 0.5 * (octagon[0] + octagon[2]);
  octagon[1] = chord + 0.02 * (octagon[1] - chord);
  EXPECT_FALSE(is_clearly_convex(octagon));
  EXPECT_TRUE(is_convex_above_noise(octagon));
  octagon[1] = chord + 0.1 * (octagon[1] - chord);
  EXPECT_FALSE(is_convex_above_noise(octagon));
}

TEST(ConvexPolygon, DartsAndTurnedPolygonsAreNot) {
  const std::vector<Vec2> dart = {{0, 0}, {1, 0}, {0.25, 0.25}, {0, 1}};
  EXPECT_FALSE(is_strictly_convex(dart));
  EXPECT_FALSE(is_clearly_convex(lifted(dart, {1, 0, 0}, {0, 1, 0})));
  std::vector<Vec2> turned = regular(5);
  std::reverse(turned.begin(), turned.end());
  EXPECT_FALSE(is_strictly_convex(turned));
  EXPECT_TRUE(is_clearly_convex(lifted(turned, {1, 0, 0}, {0, 1, 0}))) << "in space there is no front";
}

TEST(ConvexPolygon, APolygonThatWindsTwiceIsNot) {
  std::vector<Vec2> twice;
  for (const Vec2& p : regular(5)) twice.push_back(p);
  const std::vector<Vec2> pentagram = {twice[0], twice[2], twice[4], twice[1], twice[3]};
  for (int i = 0; i < 5; ++i) EXPECT_EQ(corner_triangle(i, 5)[1], i);
  EXPECT_FALSE(is_strictly_convex(pentagram));
}

}  // namespace
}  // namespace atlas_refine
