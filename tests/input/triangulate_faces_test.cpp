// Whose triangles: quads by both diagonals, polygons as their reader divides them, else by a fan, else by ears.
#include "input/triangulate_faces.h"

#include <numbers>

#include "atlas_refine/error.h"
#include "charts.h"
#include "crossing_polygons.h"
#include "geometry/predicates.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

std::vector<Vec3> regular(int corners) {
  std::vector<Vec3> out;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    out.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  return out;
}

Atlas one_face(const std::vector<Vec3>& positions) {
  std::vector<int> face(positions.size());
  for (std::size_t i = 0; i < face.size(); ++i) face[i] = static_cast<int>(i);
  return flat_atlas(positions, {face});
}

const std::vector<Vec3> kDart = {{0, 0, 0}, {1, 0, 0}, {0.25, 0.25, 0}, {0, 1, 0}};

TEST(TriangulateFaces, AConcaveQuadIsGuardedByTheDiagonalThatWorks) {
  for (int turn = 0; turn < 4; ++turn) {
    std::vector<Vec3> corners = kDart;
    std::rotate(corners.begin(), corners.begin() + turn, corners.end());
    const ChartSet set = split_charts(one_face(corners));
    EXPECT_TRUE(set.defects.empty());
    EXPECT_TRUE(set.charts[0].guards.empty());
    EXPECT_EQ(set.readings[0].fan, turn % 2 == 0);
    EXPECT_TRUE(set.readings[0].ears);
    EXPECT_FALSE(set.readings[0].diagonals);
  }
}

TEST(TriangulateFaces, AQuadThatIsFoldedInSpaceOnlyIsKeptConvexAndNotMeasured) {
  Atlas atlas = one_face(kDart);
  atlas.corner_uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const Chart chart = split_charts(atlas).charts[0];
  ASSERT_EQ(chart.guards.size(), 2u);
  for (const Guard& guard : chart.guards) {
    EXPECT_EQ(guard.share, 0);
    EXPECT_GT(guard.shape.area, 0);
  }
  EXPECT_DOUBLE_EQ(dirichlet_sums(chart).area, chart.surface.area());
}

TEST(TriangulateFaces, TheEarsOfAConvexPolygonAreGuarded) {
  for (const int corners : {5, 6, 9}) {
    const Chart chart = split_charts(one_face(regular(corners))).charts[0];
    EXPECT_EQ(static_cast<int>(chart.triangles.size()), corners - 2);
    EXPECT_EQ(static_cast<int>(chart.guards.size()), corners - 2) << "two ears are the fan's own";
  }
}

TEST(TriangulateFaces, ANearlyStraightCornerIsGuardedToo) {
  std::vector<Vec3> octagon = regular(8);
  const Vec3 chord = 0.5 * (octagon[2] + octagon[4]);
  octagon[3] = chord + 0.02 * (octagon[3] - chord);
  const Chart chart = split_charts(one_face(octagon)).charts[0];
  EXPECT_TRUE(std::any_of(chart.guards.begin(), chart.guards.end(), [](const Guard& guard) {
    return guard.triangle == Triangle{2, 3, 4};
  }));
}

TEST(TriangulateFaces, TheReadersTrianglesAreTaken) {
  Atlas atlas = one_face(regular(5));
  atlas.triangles = {{1, 2, 3}, {3, 4, 1}, {4, 0, 1}};
  const ChartSet set = split_charts(atlas);
  EXPECT_EQ(set.charts[0].triangles, (std::vector<Triangle>{{0, 1, 4}, {1, 2, 3}, {1, 3, 4}}));
  for (const Guard& guard : set.charts[0].guards) EXPECT_NE(guard.triangle, (Triangle{0, 1, 4}));
  // In the other winding they are the same.
  for (auto& t : atlas.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(split_charts(atlas).charts[0].triangles, set.charts[0].triangles);
}

TEST(TriangulateFaces, ReadersTrianglesThatDoNotMakeUpThePolygonArePassedOver) {
  Atlas atlas = one_face(regular(5));
  const std::vector<Triangle> fan = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  for (const auto& triangles : std::vector<std::vector<std::array<int, 3>>>{{{0, 1, 2}},
                                                                            {{0, 1, 2}, {0, 1, 2}, {0, 3, 4}},
                                                                            {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}},
                                                                            {{0, 1, 1}, {0, 2, 3}, {0, 3, 4}}}) {
    atlas.triangles = triangles;
    EXPECT_EQ(split_charts(atlas).charts[0].triangles, fan);
  }
}

TEST(TriangulateFaces, ReadersTrianglesThatAreFlippedInTheUvPlaneArePassedOver) {
  Atlas atlas = one_face(kDart);
  atlas.triangles = {{0, 1, 3}, {1, 2, 3}};
  const Chart chart = split_charts(atlas).charts[0];
  for (const Triangle& t : chart.triangles) EXPECT_GT(orientation(chart.uvs[t[0]], chart.uvs[t[1]], chart.uvs[t[2]]), 0);
}

TEST(TriangulateFaces, OfAFaceThatCrossesItselfTheReadersTrianglesAreTakenWhereTheyFlipNoMoreThanTheyMust) {
  Atlas atlas = testing::plate(testing::crossing_notches(1e-6));
  const std::vector<Triangle> good = {{0, 1, 2}, {0, 2, 9}, {2, 3, 4}, {2, 4, 5}, {2, 5, 8}, {2, 8, 9}, {5, 6, 7}, {5, 7, 8}};
  atlas.triangles.assign(good.begin(), good.end());
  EXPECT_EQ(split_charts(atlas).charts[0].triangles, good);
  const std::vector<Triangle> fan = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 7}, {0, 7, 8}, {0, 8, 9}};
  atlas.triangles.assign(fan.begin(), fan.end());
  EXPECT_NE(split_charts(atlas).charts[0].triangles, fan);
}

TEST(TriangulateFaces, ACornerThatIsStraightInTheUvsOnlyIsNotGuarded) {
  for (const double beside : {1e-2, 1e-4, 1e-6}) {
    Atlas atlas = one_face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    atlas.corner_uvs[1] = {0.5 + beside, 0.5 - beside};
    const ChartSet set = split_charts(atlas);
    EXPECT_TRUE(set.defects.empty());
    EXPECT_EQ(set.charts[0].guards.empty(), beside < 1e-3) << beside;
  }
}

TEST(TriangulateFaces, AReadersTriangleAcrossTwoFacesIsRefused) {
  Atlas atlas = strip(2);
  for (const std::array<int, 3>& triangle : {std::array<int, 3>{0, 1, 5}, {0, 1, 8}, {-1, 1, 2}}) {
    atlas.triangles = {triangle};
    EXPECT_THROW(split_charts(atlas), RefineError);
  }
}

TEST(TriangulateFaces, AFanThatIsPositiveInAConcavePolygonIsKeptSo) {
  // Concave at corner 3, and seen whole from corner 0; its reader divides it otherwise.
  Atlas atlas = one_face({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 0.9, 0}, {0, 1, 0}});
  atlas.triangles = {{0, 1, 3}, {1, 2, 3}, {0, 3, 4}};
  const ChartSet set = split_charts(atlas);
  EXPECT_TRUE(set.readings[0].fan);
  EXPECT_FALSE(set.readings[0].diagonals);
  ASSERT_EQ(set.charts[0].guards.size(), 2u);
  for (const Guard& guard : set.charts[0].guards) EXPECT_EQ(guard.share, 0);
}

TEST(TriangulateFaces, ValidateCountsWhatOtherReadersSee) {
  std::vector<Vec3> turned = kDart;
  std::rotate(turned.begin(), turned.begin() + 1, turned.end());
  const Validity validity = validate(one_face(turned));
  EXPECT_TRUE(validity.valid());
  EXPECT_EQ(validity.triangulations.fan_flipped, 1);
  EXPECT_EQ(validity.triangulations.ears_flipped, 0);
  EXPECT_EQ(validity.triangulations.not_convex, 1);
}

}  // namespace
}  // namespace atlas_refine
