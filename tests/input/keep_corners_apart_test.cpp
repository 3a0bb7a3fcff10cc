// Faces of which two corners would be one vertex of their chart.
#include "input/keep_corners_apart.h"

#include <gtest/gtest.h>

#include <array>

#include "input/split_charts.h"
#include "output_atlas.h"
#include "refine_checks.h"
#include "sheets.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

/// A sheet of so many columns and three rows, of which the middle one has no height and only its first faces: what a bevel of no
/// width leaves. Beyond them the rows above and below meet, though they have vertices of their own there.
Atlas sheet_with_thin_row(int columns, int thin) {
  const Atlas whole = sheet(columns, 3);
  Atlas out{whole.name, whole.positions, {0}, {}, {}};
  for (int f = 0; f < whole.face_count(); ++f) {
    if (f < columns || f >= 2 * columns || f < columns + thin) add_double(out, whole, f, false);
  }
  const auto lowered = [](double y) { return y > 0.15 ? y - 0.1 : y; };
  for (Vec3& position : out.positions) position.y() = lowered(position.y());
  for (Vec2& uv : out.corner_uvs) uv.y() = lowered(uv.y());
  return out;
}

/// A sheet of quads with one vertex instead of two neighbours, which one of the two faces at their edge has twice; the other is a
/// triangle.
Atlas sheet_with_doubled_corner() {
  const Atlas whole = sheet(4, 4);
  Atlas out{whole.name, whole.positions, {0}, {}, {}};
  for (int f = 0; f < whole.face_count(); ++f) {
    if (f != 9) add_double(out, whole, f, false);
  }
  for (int c = 0; c < out.corner_count(); ++c) {
    if (out.corner_vertices[c] != 12) continue;
    out.corner_vertices[c] = 11;
    out.corner_uvs[c] = whole.positions[11].head<2>();
  }
  const auto uv = [&](int v) -> Vec2 { return whole.positions[v].head<2>(); };
  add_face(out, {11, 17, 16}, {uv(11), uv(17), uv(16)});
  return out;
}

bool has_repeated_vertex(const Chart& chart) {
  for (const Triangle& t : chart.triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return true;
  }
  return false;
}

void expect_all_are_refined(const Atlas& atlas) {
  const RefineOptions options{.pe_bound = 0.9, .box_aspect = 1};
  const RefineResult result = refine(atlas, options);
  EXPECT_TRUE(result.bound_met);
  EXPECT_EQ(result.charts.size(), 1u);
  for (const ChartReport& chart : result.charts) EXPECT_NE(chart.fate, Fate::Left);
  EXPECT_TRUE(validate(testing::output(atlas, result)).valid());
}

TEST(CornersKeptApart, WhereARowOfThinFacesEnds) {
  for (const int thin : {1, 2, 3}) {
    const Atlas atlas = sheet_with_thin_row(4, thin);
    const ChartSet set = split_charts(atlas);
    ASSERT_EQ(set.charts.size(), 1u);
    EXPECT_FALSE(has_repeated_vertex(set.charts[0])) << thin;
    EXPECT_EQ(set.seam_edges, 1) << "the first edge that has no thin face, of vertices that are not the same";
    expect_all_are_refined(atlas);
    for (const Chart& chart : split_charts(with_noise(atlas, 3e-7)).charts) EXPECT_FALSE(has_repeated_vertex(chart)) << thin;
  }
}

TEST(CornersKeptApart, WhereAFaceHasAVertexTwiceAndWhereNothingIsWelded) {
  for (const Atlas& atlas : {sheet_with_doubled_corner(), unwelded(sheet_with_doubled_corner())}) {
    const ChartSet set = split_charts(atlas);
    ASSERT_EQ(set.charts.size(), 1u);
    EXPECT_FALSE(has_repeated_vertex(set.charts[0]));
    EXPECT_LE(set.seam_edges, 1);
    expect_all_are_refined(atlas);
  }
}

TEST(CornersKeptApart, WhatHasNoSuchFaceStaysJoined) {
  for (const Atlas& atlas : {sheet(5, 4), unwelded(sheet(5, 4)), pinched_sheet()}) {
    const EdgeJoins before = join_edges(atlas, Joining::AsMeant);
    EdgeJoins after = before;
    keep_corners_apart(atlas, after);
    EXPECT_EQ(after.partners, before.partners);
  }
}

TEST(KeepCornersApart, WhereABevelRunsOutItsEndIsNotSewnTogether) {
  // Two faces side by side that come to a point, where each has an edge without length between vertices of its own.
  for (const auto& [left, middle, right] : {std::array{0, 2, 1}, std::array{0, 1, 2}, std::array{2, 0, 1}}) {
    const Atlas atlas = flat_atlas({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, -0.1, 0}, {1, 0, 0}, {1, 0.1, 0}},
                                   {{3, 4, middle, left}, {4, 5, right, middle}});
    const ChartSet set = split_charts(atlas);
    ASSERT_EQ(set.charts.size(), 1u);
    EXPECT_EQ(set.charts[0].vertex_count(), 6);
    EXPECT_EQ(set.charts[0].boundary_loops.front().size(), 6u);
  }
}

}  // namespace
}  // namespace atlas_refine
