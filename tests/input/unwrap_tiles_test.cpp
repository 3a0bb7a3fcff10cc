// Maps that start again at the edge of the tile: the faces in between.
#include "input/unwrap_tiles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "atlas_refine/refine.h"
#include "closed_shapes.h"
#include "refine_checks.h"
#include "shapes.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

/// A tube without ends of columns x rows quads; once around is `tiles` tiles, and the last column runs back to 0.
Atlas tube(int columns, int rows, double tiles = 1) {
  std::vector<Vec3> positions;
  std::vector<std::vector<int>> faces;
  for (int k = 0; k < columns * (rows + 1); ++k) {
    const double angle_rad = 2 * std::numbers::pi * (k % columns) / columns;
    positions.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 0.3 * (k / columns));
  }
  for (int f = 0; f < columns * rows; ++f) {
    const int row = f / columns * columns, i = f % columns, next = (i + 1) % columns;
    faces.push_back({row + i, row + next, row + columns + next, row + columns + i});
  }
  Atlas atlas = flat_atlas(positions, faces);
  for (int c = 0; c < atlas.corner_count(); ++c) {
    const int v = atlas.corner_vertices[c];
    atlas.corner_uvs[c] = {tiles * (v % columns) / columns, 0.05 * (v / columns)};
  }
  return atlas;
}

TEST(UnwrapTiles, TheLastColumnOfATubeIsMovedOn) {
  for (const double tiles : {1.0, 3.0, -1.0}) {
    const Atlas atlas = tube(24, 5, tiles);
    const UnwrappedTiles out = unwrap_tiles(atlas, {}, {});
    ASSERT_EQ(out.faces.size(), 5u);
    for (const int f : out.faces) EXPECT_EQ(f % 24, 23);
    EXPECT_EQ(out.torn.size(), 5u);
    EXPECT_EQ(measure(testing::with_corner_uvs(atlas, out.corner_uvs)).chart_count, 1);
    const RefineResult result = refine(atlas, {.pe_bound = 0.9});
    EXPECT_TRUE(validate(testing::with_corner_uvs(atlas, result.corner_uvs)).valid());
  }
}

TEST(UnwrapTiles, APrismOfThreeSidesIsUnwrapped) { EXPECT_EQ(unwrap_tiles(tube(3, 2), {}, {}).faces.size(), 2u); }

TEST(UnwrapTiles, ATorusIsUnwrappedBothWays) {
  const Atlas torus = shapes::wrapped(shapes::torus(24, 12));
  const UnwrappedTiles out = unwrap_tiles(torus, {}, {});
  EXPECT_EQ(out.faces.size(), 24u + 12u - 1);
  EXPECT_EQ(out.torn.size(), 24u + 12u);
  EXPECT_TRUE(validate(testing::with_corner_uvs(torus, out.corner_uvs)).valid());
}

TEST(UnwrapTiles, AVertexWhoseUvWasLostIsNoMapThatStartsAgain) {
  for (const int lost : {121, 144, 60, 222}) {
    Atlas atlas = shapes::quad_grid(20, 20);
    const std::vector<Vec2> before = atlas.corner_uvs;
    for (int c = 0; c < atlas.corner_count(); ++c)
      atlas.corner_uvs[c] = atlas.corner_vertices[c] == lost ? Vec2(Vec2::Zero()) : Vec2(3 * before[c]);
    EXPECT_TRUE(unwrap_tiles(atlas, {}, {}).torn.empty()) << lost;
    EXPECT_EQ(refine(atlas, {.pe_bound = 0.7}).added_seams, 0) << lost;
  }
}

TEST(UnwrapTiles, LargeFacesStay) {
  // Two quads folded onto each other, and quads of nearly a tile each: nothing says that these start again.
  Atlas folded = strip(2);
  for (Vec2& uv : folded.corner_uvs) uv = {uv.x() == 1 ? 0.8 : 0, uv.y()};
  EXPECT_TRUE(unwrap_tiles(folded, {}, {}).faces.empty());
  Atlas tiled = strip(6);
  for (Vec2& uv : tiled.corner_uvs) uv *= 0.9;
  EXPECT_TRUE(unwrap_tiles(tiled, {}, {}).faces.empty());
  // One face over the whole tile beside small ones of the same density.
  const Atlas wide = flat_atlas({{0, 0, 0}, {9, 0, 0}, {9, 1, 0}, {0, 1, 0}, {10, 0, 0}, {10, 1, 0}, {11, 0, 0}, {11, 1, 0}},
                                {{0, 1, 2, 3}, {1, 4, 5, 2}, {4, 6, 7, 5}});
  EXPECT_TRUE(unwrap_tiles(wide, {}, {}).faces.empty());
}

TEST(UnwrapTiles, AMapThatIsFoldedElsewhereTooIsLeftToOthers) {
  Atlas atlas = tube(24, 5);
  // Four columns run backwards, and span next to nothing.
  for (Vec2& uv : atlas.corner_uvs) uv.x() = uv.x() > 0.3 && uv.x() < 0.5 ? 0.8 - uv.x() : uv.x();
  EXPECT_TRUE(unwrap_tiles(atlas, {}, {}).faces.empty());
}

TEST(UnwrapTiles, ChartsThatAreKeptStay) {
  const Atlas atlas = tube(24, 5);
  std::vector<char> kept(atlas.face_count(), 0);
  kept[7] = 1;
  EXPECT_TRUE(unwrap_tiles(atlas, {}, kept).faces.empty());
}

TEST(UnwrapTiles, AWrappedTubeStaysOneChartAndFlat) {
  const Atlas atlas = tube(24, 5);
  const RefineResult result = refine(atlas, {.pe_bound = 0.9});
  EXPECT_EQ(result.charts.size(), 1u);
  EXPECT_EQ(result.added_seams, 5);
  EXPECT_EQ(result.new_seams.size(), 5u);
  ASSERT_EQ(result.repairs.size(), 1u);
  EXPECT_EQ(result.repairs[0].faces.size(), 5u);
  EXPECT_LT(result.after.distortion, 1.2);
  EXPECT_EQ(result.after.seam_edges, result.before.seam_edges + 5);
  EXPECT_NE(result.intervention, Intervention::Unchanged);
  EXPECT_TRUE(validate(testing::with_corner_uvs(atlas, result.corner_uvs)).valid());
}

TEST(UnwrapTiles, AWrappedTorusNeedsNoPermission) {
  const RefineResult result = refine(shapes::wrapped(shapes::torus(24, 12)), {.pe_bound = 0.6});
  EXPECT_EQ(result.added_seams, 24 + 12);
  EXPECT_TRUE(result.bound_met);
}

}  // namespace
}  // namespace atlas_refine
