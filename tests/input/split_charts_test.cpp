// Charts from UV connectivity: welding, windings, mirrors, defects, n-gons, bad arrays.
#include "input/split_charts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "atlas_refine/error.h"
#include "geometry/half_edge_mesh.h"
#include "geometry/predicates.h"
#include "shapes.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

void expect_invariants(const Atlas& atlas, const ChartSet& set) {
  ASSERT_EQ(static_cast<int>(set.corners.size()), atlas.corner_count());
  for (int c = 0; c < atlas.corner_count(); ++c) {
    const CornerRef ref = set.corners[c];
    Vec2 uv = set.charts[ref.chart].uvs[ref.vertex];
    if (set.mirrored[ref.chart]) uv.x() = -uv.x();
    EXPECT_EQ(uv, atlas.corner_uvs[c]);
  }
  for (const Chart& chart : set.charts) {
    ASSERT_EQ(chart.surface.size(), chart.triangles.size());
    ASSERT_EQ(chart.triangle_faces.size(), chart.triangles.size());
    for (const RestTriangle& rest : chart.surface) {
      EXPECT_TRUE(rest.inverse_edges.allFinite());
      EXPECT_GT(rest.area, 0);
    }
    if (!set.defects.empty()) continue;
    for (const Triangle& t : chart.triangles) EXPECT_EQ(orientation(chart.uvs[t[0]], chart.uvs[t[1]], chart.uvs[t[2]]), 1);
  }
}

TEST(SplitCharts, OneChartOfTwoTriangles) {
  const Atlas atlas = unit_square();
  const ChartSet set = split_charts(atlas);
  expect_invariants(atlas, set);
  ASSERT_EQ(set.charts.size(), 1u);
  EXPECT_EQ(set.charts[0].vertex_count(), 4);
  EXPECT_EQ(set.charts[0].boundary_loops.size(), 1u);
  EXPECT_EQ(set.seam_edges, 0);
  EXPECT_TRUE(set.defects.empty());
}

TEST(SplitCharts, ASeamIsWhereUvsDiffer) {
  Atlas atlas = strip(3);
  shift_face(atlas, 1, {0, 2});
  const ChartSet set = split_charts(atlas);
  expect_invariants(atlas, set);
  EXPECT_EQ(set.charts.size(), 3u);
  EXPECT_EQ(set.seam_edges, 2);
  EXPECT_DOUBLE_EQ(set.seam_length, 2);
}

TEST(SplitCharts, VerticesDoubledForNormalsKeepTheChartWhole) {
  Atlas atlas = unit_square();
  atlas.positions.push_back(atlas.positions[0]);
  atlas.positions.push_back(atlas.positions[2]);
  atlas.corner_vertices[3] = 4;  // the second face has vertices of its own at the diagonal
  atlas.corner_vertices[4] = 5;
  const ChartSet set = split_charts(atlas);
  EXPECT_EQ(set.charts.size(), 1u);
  EXPECT_EQ(set.charts[0].vertex_count(), 4);
  EXPECT_EQ(set.seam_edges, 0);
}

TEST(SplitCharts, MoreThanTwoFacesAtAnEdgeAreASeam) {
  Atlas atlas = flat_atlas({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, -1, 0}, {0.5, -1, 1}}, {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}});
  const ChartSet set = split_charts(atlas);
  EXPECT_EQ(set.charts.size(), 3u);
  EXPECT_EQ(set.seam_edges, 1);
}

TEST(SplitCharts, FacesOfOppositeWindingAreJoined) {
  Atlas atlas = strip(3);
  std::reverse(atlas.corner_vertices.begin() + 4, atlas.corner_vertices.begin() + 8);
  std::reverse(atlas.corner_uvs.begin() + 4, atlas.corner_uvs.begin() + 8);
  const ChartSet set = split_charts(atlas);
  expect_invariants(atlas, set);
  EXPECT_EQ(set.charts.size(), 1u);
  EXPECT_FALSE(set.mirrored[0]);
  EXPECT_TRUE(set.defects.empty());
  EXPECT_EQ(set.seam_edges, 0);
}

TEST(SplitCharts, MirroredChartsAreTurnedOver) {
  const Atlas atlas = shapes::mirrored(shapes::mesh(shapes::c_shape(), 0.1));
  const ChartSet set = split_charts(atlas);
  expect_invariants(atlas, set);
  ASSERT_EQ(set.charts.size(), 1u);
  EXPECT_TRUE(set.mirrored[0]);
  EXPECT_TRUE(set.defects.empty());
}

TEST(SplitCharts, APlacedMirroredChartIsWhereTheInputHasIt) {
  const Atlas atlas = shapes::mirrored(shapes::mesh(shapes::c_shape(), 0.1));
  const ChartSet set = split_charts(atlas);
  const Chart placed = charts_as_placed(set)[0];
  for (int c = 0; c < atlas.corner_count(); ++c) EXPECT_EQ(placed.uvs[set.corners[c].vertex], atlas.corner_uvs[c]);
  for (const Triangle& t : placed.triangles) EXPECT_EQ(orientation(placed.uvs[t[0]], placed.uvs[t[1]], placed.uvs[t[2]]), 1);
}

TEST(SplitCharts, FlippedAndEmptyFacesAreDefects) {
  Atlas atlas = strip(3);
  atlas.corner_uvs[1] = atlas.corner_uvs[2] = atlas.corner_uvs[3] = atlas.corner_uvs[0];
  const ChartSet set = split_charts(atlas);
  ASSERT_EQ(set.defects.size(), 1u);
  EXPECT_EQ(set.defects[0].kind, FaceDefect::Kind::ZeroArea);
  EXPECT_EQ(set.defects[0].face, 0);

  const Atlas flipped = shapes::with_flipped_face(shapes::mesh(shapes::rectangle(1, 1), 0.1));
  const ChartSet flipped_set = split_charts(flipped);
  EXPECT_EQ(flipped_set.charts.size(), 1u);
  ASSERT_FALSE(flipped_set.defects.empty());
  EXPECT_EQ(flipped_set.defects[0].kind, FaceDefect::Kind::Flipped);
}

TEST(SplitCharts, ABowTieIsADefectThoughItsAreaIsPositive) {
  Atlas atlas = flat_atlas({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}});
  atlas.corner_uvs = {{0, 0}, {1, 0.6}, {1, 0}, {0, 1}};
  EXPECT_EQ(split_charts(atlas).defects.size(), 1u);
}

TEST(SplitCharts, FrontAndBackOfASheetAreTwoCharts) {
  Atlas atlas = flat_atlas({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {3, 5, 4}});
  const ChartSet set = split_charts(atlas);
  EXPECT_EQ(set.charts.size(), 2u);
  EXPECT_TRUE(set.mirrored[1]);
  EXPECT_TRUE(set.defects.empty());
}

TEST(SplitCharts, AMoebiusBandIsCutNotTwisted) {
  // Five quads in a ring, the last joined to the first with a half twist, UVs equal across every edge.
  Atlas atlas;
  atlas.face_offsets = {0};
  for (int i = 0; i < 10; ++i) atlas.positions.push_back({static_cast<double>(i / 2), static_cast<double>(i % 2), 0.1 * i * i});
  for (int i = 0; i < 5; ++i) {
    const int next_low = i < 4 ? 2 * i + 2 : 1, next_high = i < 4 ? 2 * i + 3 : 0;
    for (int v : {2 * i, next_low, next_high, 2 * i + 1}) {
      atlas.corner_vertices.push_back(v);
      atlas.corner_uvs.push_back(atlas.positions[v].head<2>());
    }
    atlas.face_offsets.push_back(atlas.corner_count());
  }
  const ChartSet set = split_charts(atlas);
  ASSERT_EQ(set.charts.size(), 1u);
  EXPECT_EQ(set.seam_edges, 1);
  EXPECT_FALSE(set.defects.empty());  // the last quad runs back over all others
}

TEST(SplitCharts, APinchedVertexBecomesTwo) {
  Atlas atlas = flat_atlas({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
  const ChartSet set = split_charts(atlas);
  EXPECT_EQ(set.charts.size(), 2u);
}

TEST(SplitCharts, TheOuterLoopComesFirst) {
  const ChartSet set = split_charts(shapes::mesh(shapes::ring(), 0.05));
  ASSERT_EQ(set.charts.size(), 1u);
  const Chart& chart = set.charts[0];
  ASSERT_EQ(chart.boundary_loops.size(), 2u);
  for (int v : chart.boundary_loops[0]) EXPECT_GT(chart.uvs[v].norm(), 0.45);
  for (int v : chart.boundary_loops[1]) EXPECT_LT(chart.uvs[v].norm(), 0.3);
  EXPECT_EQ(mesh_topology(chart.vertex_count(), chart.triangles).euler_characteristic, 0);
}

TEST(SplitCharts, QuadsAndNGonsKeepTheirFace) {
  const Atlas atlas = shapes::quad_grid(4, 3);
  const ChartSet set = split_charts(atlas);
  expect_invariants(atlas, set);
  ASSERT_EQ(set.charts.size(), 1u);
  EXPECT_EQ(set.charts[0].triangles.size(), 24u);
  EXPECT_EQ(set.charts[0].triangle_faces.back(), 11);
}

TEST(SplitCharts, FacesWithoutAreaInSpaceCountNext) {
  Atlas atlas = unit_square();
  for (Vec3& p : atlas.positions) p.y() = 0;  // the whole surface is a line
  expect_invariants(atlas, split_charts(atlas));
  atlas = strip(2);
  atlas.positions[5] = atlas.positions[4];  // one triangle is
  const ChartSet set = split_charts(atlas);
  expect_invariants(atlas, set);
}

TEST(SplitCharts, PermutedFacesGiveTheSameCharts) {
  const Atlas atlas = shapes::squares(20);
  Atlas reversed = atlas;
  reversed.face_offsets = {0};
  reversed.corner_vertices.clear();
  reversed.corner_uvs.clear();
  for (int f = atlas.face_count(); f-- > 0;) {
    for (int c = atlas.face_offsets[f]; c < atlas.face_offsets[f + 1]; ++c) {
      reversed.corner_vertices.push_back(atlas.corner_vertices[c]);
      reversed.corner_uvs.push_back(atlas.corner_uvs[c]);
    }
    reversed.face_offsets.push_back(reversed.corner_count());
  }
  EXPECT_EQ(split_charts(atlas).charts.size(), 20u);
  EXPECT_EQ(split_charts(reversed).charts.size(), 20u);
}

void expect_bad_input(const Atlas& atlas, const std::string& part) {
  try {
    split_charts(atlas);
    ADD_FAILURE() << "accepted, expected: " << part;
  } catch (const RefineError& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadInput);
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(SplitCharts, BadArraysAreNamed) {
  expect_bad_input(Atlas(), "no faces");
  Atlas atlas = unit_square();
  atlas.name = "cube";
  atlas.corner_vertices[4] = 7;
  expect_bad_input(atlas, "object 'cube': face 1 uses vertex 7 of 4");
  atlas.corner_vertices[4] = -1;
  expect_bad_input(atlas, "vertex -1");
  atlas = unit_square();
  atlas.corner_uvs[5].x() = std::numeric_limits<double>::quiet_NaN();
  expect_bad_input(atlas, "face 1: a UV is not a finite number");
  atlas = unit_square();
  atlas.positions[2].z() = std::numeric_limits<double>::infinity();
  expect_bad_input(atlas, "vertex 2");
  atlas = unit_square();
  atlas.corner_uvs.pop_back();
  expect_bad_input(atlas, "5 UVs for 6 corners");
  atlas = unit_square();
  atlas.face_offsets = {0, 2, 6};
  expect_bad_input(atlas, "face 0 has fewer than 3 corners");
  atlas.face_offsets = {0, 9, 6};
  expect_bad_input(atlas, "out of order");
  atlas.face_offsets = {0, 3};
  expect_bad_input(atlas, "do not cover");
}

}  // namespace
}  // namespace atlas_refine
