// Regions with holes, points inside and chords.
#include "geometry/triangulate_region.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/plane.h"

namespace atlas_refine {
namespace {

/// A square of side 4 with a square hole of side 2, and a point between them.
Region square_with_hole() {
  return {.points = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {2, 0.5}},
          .loops = {{0, 1, 2, 3}, {4, 5, 6, 7}},
          .chords = {},
          .near = std::vector<int>(9, -1)};
}

double area_of(const Region& region, const std::vector<Triangle>& triangles) {
  double area = 0;
  for (const Triangle& t : triangles) {
    const double doubled = doubled_area(region.points[t[0]], region.points[t[1]], region.points[t[2]]);
    EXPECT_GT(doubled, 0);
    area += 0.5 * doubled;
  }
  return area;
}

bool has_edge(const std::vector<Triangle>& triangles, int a, int b) {
  return std::any_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
    return std::count(t.begin(), t.end(), a) > 0 && std::count(t.begin(), t.end(), b) > 0;
  });
}

TEST(TriangulateRegion, LeavesHolesOut) {
  const Region region = square_with_hole();
  const auto triangles = triangulate_region(region);
  ASSERT_TRUE(triangles);
  EXPECT_DOUBLE_EQ(area_of(region, *triangles), 12);
  EXPECT_EQ(triangles->size(), 10u);
}

TEST(TriangulateRegion, HasTheChordsThatItIsAskedFor) {
  Region region{.points = {{0, 0}, {1, -0.2}, {2, 0}, {1, 0.2}}, .loops = {{0, 1, 2, 3}}, .chords = {}, .near = {-1, 0, 1, 2}};
  EXPECT_FALSE(has_edge(*triangulate_region(region), 0, 2));
  region.chords = {{0, 2}};
  EXPECT_TRUE(has_edge(*triangulate_region(region), 0, 2));
}

TEST(TriangulateRegion, RefusesLoopsThatMeet) {
  Region crossed = square_with_hole();
  crossed.points[4] = {-1, 1};
  EXPECT_FALSE(triangulate_region(crossed));
  Region doubled = square_with_hole();
  doubled.points[8] = doubled.points[4];
  EXPECT_FALSE(triangulate_region(doubled));
}

}  // namespace
}  // namespace atlas_refine
