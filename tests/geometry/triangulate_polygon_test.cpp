// Polygons: every triangulation is positive in the UV plane and covers the polygon.
#include "geometry/triangulate_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "geometry/plane.h"
#include "geometry/predicates.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

std::vector<Vec3> lifted(const std::vector<Vec2>& uvs) {
  std::vector<Vec3> positions;
  for (const Vec2& uv : uvs) positions.push_back({uv.x(), uv.y(), 0});
  return positions;
}

double area(const std::vector<Vec2>& uvs, const std::vector<Triangle>& triangles) {
  double doubled = 0;
  for (const Triangle& t : triangles) doubled += doubled_area(uvs[t[0]], uvs[t[1]], uvs[t[2]]);
  return 0.5 * doubled;
}

void expect_good(const std::vector<Vec2>& uvs) {
  const auto triangles = triangulate_polygon(uvs, lifted(uvs));
  ASSERT_TRUE(triangles.has_value());
  EXPECT_EQ(triangles->size(), uvs.size() - 2);
  for (const Triangle& t : *triangles) EXPECT_EQ(orientation(uvs[t[0]], uvs[t[1]], uvs[t[2]]), 1);
  EXPECT_NEAR(area(uvs, *triangles), area(uvs, polygon_fan(static_cast<int>(uvs.size()))), 1e-12);
}

TEST(TriangulatePolygon, ConvexPolygonsKeepTheFan) {
  const std::vector<Vec2> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(triangulate_polygon(square, lifted(square)), polygon_fan(4));
}

TEST(TriangulatePolygon, AConcaveCornerTakesTheOtherDiagonal) {
  const std::vector<Vec2> dart = {{0, 0}, {1, 1}, {0, 0.2}, {-1, 1}};
  const std::vector<Vec2> turned = {dart[1], dart[2], dart[3], dart[0]};
  expect_good(dart);
  expect_good(turned);
}

TEST(TriangulatePolygon, CollinearCornersGiveNoEmptyTriangle) {
  expect_good({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}});
  expect_good({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {1.5, 1}, {0, 1}});
}

TEST(TriangulatePolygon, RandomPolygons) {
  for (int seed = 0; seed < 50; ++seed) expect_good(shapes::random_polygon(seed).outer);
}

/// A square with a square hole, reached along an edge to and fro; corner 4 is corner 0 again, corner 9 is corner 5.
std::vector<Vec2> keyhole() { return {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}, {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}}; }

TEST(TriangulatePolygon, AKeyholeIsOpenedAlongItsBridge) {
  std::vector<Vec2> uvs = keyhole();
  for (std::size_t start = 0; start < uvs.size(); ++start) {
    expect_good(uvs);
    std::rotate(uvs.begin(), uvs.begin() + 1, uvs.end());
  }
  // Each side of the polygon is a side of one triangle: corners at one place are told apart by the triangles around them.
  std::set<std::pair<int, int>> sides;
  const auto triangles = triangulate_polygon(uvs, lifted(uvs));
  ASSERT_TRUE(triangles.has_value());
  for (const Triangle& t : *triangles) {
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(sides.emplace(t[k], t[(k + 1) % 3]).second);
  }
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(sides.contains({i, (i + 1) % 10})) << i;
}

TEST(TriangulatePolygon, PolygonsThatComeToAPlaceTwice) {
  expect_good({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}, {1, 2}, {2, 1}});  // a hole that touches the outline
  expect_good({{0, 0}, {3, 0}, {3, 3}, {1, 1}, {3, 3}, {0, 3}});          // an edge that ends inside
  const auto refused = [](const std::vector<Vec2>& uvs) { return !triangulate_polygon(uvs, lifted(uvs)).has_value(); };
  EXPECT_TRUE(refused({{0, 0}, {3, 0}, {3, 3}, {4, 4}, {3, 3}, {0, 3}}));  // one that ends outside
  EXPECT_TRUE(
      refused({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}, {1, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 1}}));  // a hole wound as the outline
  EXPECT_TRUE(refused({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}, {3, 0}, {3, 3}, {0, 3}}));          // twice around
}

TEST(TriangulatePolygon, AFoldInSpaceTakesTheOtherDiagonal) {
  // Convex in the UV plane, concave in space at corner 3: the diagonal 0-2 would fold the surface.
  const std::vector<Vec2> uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.7, 0.2, 0}};
  const auto triangles = triangulate_polygon(uvs, positions);
  ASSERT_TRUE(triangles.has_value());
  EXPECT_EQ(triangles->size(), 2u);
}

TEST(TriangulatePolygon, PolygonsThatAreNotSimpleAreRefused) {
  const std::vector<Vec2> bow_tie = {{0, 0}, {1, 1}, {1, 0}, {0, 1.5}};
  const std::vector<Vec2> clockwise = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  const std::vector<Vec2> flat = {{0, 0}, {1, 0}, {2, 0}, {3, 0}};
  const std::vector<Vec2> point = {{1, 1}, {1, 1}, {1, 1}, {1, 1}};
  const std::vector<Vec2> doubled_corner = {{0, 0}, {1, 0}, {1, 1}, {1, 1}};
  const std::vector<Vec2> touching = {{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}};
  for (const auto& uvs : {bow_tie, clockwise, flat, point, doubled_corner, touching}) {
    EXPECT_FALSE(triangulate_polygon(uvs, lifted(uvs)).has_value());
  }
}

}  // namespace
}  // namespace atlas_refine
