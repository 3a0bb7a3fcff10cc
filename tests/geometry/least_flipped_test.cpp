// Polygons that cross themselves: divided so that next to nothing runs backwards.
#include "geometry/least_flipped.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "crossing_polygons.h"
#include "geometry/plane.h"
#include "geometry/triangulate_polygon.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

std::vector<Vec3> lifted(const std::vector<Vec2>& uvs) {
  std::vector<Vec3> out;
  for (const Vec2& uv : uvs) out.emplace_back(0.6 * uv.x(), uv.y(), 0.8 * uv.x());
  return out;
}

std::vector<int> numbers(std::size_t count) {
  std::vector<int> out(count);
  std::iota(out.begin(), out.end(), 0);
  return out;
}

double flipped_area(const std::vector<Vec2>& uvs, const std::vector<Triangle>& triangles) {
  double doubled = 0;
  for (const Triangle& t : triangles) doubled -= std::min(0.0, doubled_area(uvs[t[0]], uvs[t[1]], uvs[t[2]]));
  return 0.5 * doubled;
}

std::vector<Triangle> divided(const std::vector<Vec2>& uvs, const std::vector<Vec3>& positions) {
  const auto triangles = least_flipped(FlippedArea(uvs, positions), numbers(uvs.size()));
  EXPECT_TRUE(triangles.has_value());
  EXPECT_EQ(triangles->size(), uvs.size() - 2);
  return *triangles;
}

TEST(LeastFlipped, NothingOfASimplePolygonIsFlipped) {
  for (int seed = 0; seed < 30; ++seed) {
    const std::vector<Vec2> uvs = shapes::random_polygon(seed).outer;
    EXPECT_EQ(flipped_area(uvs, divided(uvs, lifted(uvs))), 0) << seed;
  }
}

TEST(LeastFlipped, OfNotchesThatCrossByAHairNoMoreThanTheHairIs) {
  for (const double by : {1e-3, 1e-5, 1e-7}) {
    const std::vector<Vec2> uvs = testing::crossing_notches(by);
    ASSERT_FALSE(triangulate_polygon(uvs, lifted(uvs)).has_value());
    EXPECT_LT(flipped_area(uvs, divided(uvs, lifted(uvs))), by);
    EXPECT_GT(flipped_area(uvs, polygon_fan(static_cast<int>(uvs.size()))), 0.1);
  }
}

TEST(LeastFlipped, APolygonOfSeveralHundredCornersIsDividedToo) {
  std::vector<Vec2> uvs = shapes::random_star_polygon(1, 400).outer;
  std::swap(uvs[100], uvs[103]);
  EXPECT_LT(flipped_area(uvs, divided(uvs, lifted(uvs))), 0.01);
}

TEST(LeastFlipped, WhatTheUvsTellNothingOfIsDividedAsInSpace) {
  const std::vector<Vec2> comb = shapes::comb(3).outer;
  for (const Vec2& squashed_by : {Vec2(1, 0), Vec2(0, 0)}) {
    std::vector<Vec2> uvs = comb;
    for (Vec2& uv : uvs) uv = uv.cwiseProduct(squashed_by);
    EXPECT_EQ(flipped_area(comb, divided(uvs, lifted(comb))), 0);
    EXPECT_EQ(flipped_area(comb, divided(comb, lifted(uvs))), 0);
  }
}

TEST(LeastFlipped, TheMirrorImageIsDividedAlike) {
  const std::vector<Vec2> uvs = testing::crossing_notches(1e-5);
  std::vector<Vec2> mirrored = uvs;
  for (Vec2& uv : mirrored) uv.x() = -uv.x();
  EXPECT_EQ(divided(uvs, lifted(uvs)), divided(mirrored, lifted(uvs)));
}

TEST(LeastFlipped, NoTriangleHasTwoCornersOfOneVertex) {
  // A keyhole whose hole crosses the outline by a hair; corners 4 and 9 are 0 and 5 again.
  const std::vector<Vec2> uvs = {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}, {1, 1}, {1, 2}, {3.00001, 2}, {2, 1}, {1, 1}};
  const std::vector<int> vertices = {0, 1, 2, 3, 0, 4, 5, 6, 7, 4};
  const auto triangles = least_flipped(FlippedArea(uvs, lifted(uvs)), vertices);
  ASSERT_TRUE(triangles.has_value());
  for (const Triangle& t : *triangles) {
    EXPECT_EQ((std::set<int>{vertices[t[0]], vertices[t[1]], vertices[t[2]]}.size()), 3u);
  }
  EXPECT_LT(flipped_area(uvs, *triangles), 1e-4);
}

}  // namespace
}  // namespace atlas_refine
