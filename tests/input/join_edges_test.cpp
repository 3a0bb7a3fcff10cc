// Edges that are one as their maker meant: noise, doubles, folds, coincident vertices, more than two faces.
#include "input/join_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "atlas_refine/measures.h"
#include "input/split_charts.h"
#include "shapes.h"
#include "sheets.h"
#include "support/thread_pool.h"

namespace atlas_refine {
namespace {

/// How many charts have so many faces.
std::map<int, int> chart_sizes(const ChartSet& set) {
  std::map<int, int> sizes;
  for (const Chart& chart : set.charts) {
    std::vector<int> faces = chart.triangle_faces;
    ++sizes[static_cast<int>(std::unique(faces.begin(), faces.end()) - faces.begin())];
  }
  return sizes;
}

using Sizes = std::map<int, int>;

TEST(AsMeant, NoiseBetweenTheSidesOfAnEdgeIsNoSeam) {
  for (const double noise : {1e-9, 3e-7, 3e-6}) {
    for (const Atlas& atlas : {with_noise(sheet(6, 5), noise), with_noise(unwelded(sheet(6, 5)), noise)}) {
      const ChartSet set = split_charts(atlas);
      EXPECT_EQ(set.charts.size(), 1u);
      EXPECT_EQ(set.charts[0].vertex_count(), 42);
      EXPECT_EQ(set.seam_edges, 0);
      EXPECT_TRUE(set.defects.empty());
      EXPECT_TRUE(validate(atlas).valid());
      EXPECT_EQ(split_charts(atlas, Joining::Exact).charts.size(), 30u);
    }
  }
}

TEST(AsMeant, ChartsThatAreNearButNotNoiseStayTwo) {
  // An atlas of a thousandth of the tile: 1e-5 is a tenth of its edges there.
  Atlas atlas = sheet(6, 1);
  for (int c = 12; c < 24; ++c) atlas.corner_uvs[c].x() += 1e-2;
  for (Vec2& uv : atlas.corner_uvs) uv *= 1e-3;
  EXPECT_EQ(split_charts(atlas).charts.size(), 2u);
  // Edges far shorter than the distance that would be noise on others.
  Atlas tiny = sheet(2, 1);
  for (Vec2& uv : tiny.corner_uvs) uv *= 1e-3;
  shift_face(tiny, 1, {6e-6, 0});
  add_face(tiny, {0, 1, 4}, {{0.5, 0.5}, {1, 0.5}, {0.5, 1}});
  EXPECT_EQ(split_charts(tiny).charts.size(), 3u);
}

TEST(AsMeant, NoiseDoesNotTurnAThinFaceOver) {
  // The second face is thinner than the noise: with the first corners' values at both of its ends it would be flipped.
  Atlas atlas = flat_atlas({{0, 0, 0}, {1, 0, 0}, {0.5, 0.5, 0}, {0.5, -1.5e-6, 0}}, {{0, 1, 2}, {1, 0, 3}});
  atlas.corner_uvs[0].y() = atlas.corner_uvs[1].y() = -2e-6;
  EXPECT_EQ(split_charts(atlas).charts.size(), 1u);
  EXPECT_TRUE(split_charts(atlas).defects.empty());
}

TEST(AsMeant, EdgesWithoutLengthInSpaceAreNotTorn) {
  Atlas atlas = sheet(4, 4);
  atlas.positions[12] = atlas.positions[11];
  for (const Atlas& each : {atlas, unwelded(atlas), with_noise(unwelded(atlas), 3e-7)}) {
    const ChartSet set = split_charts(each);
    EXPECT_EQ(set.charts.size(), 1u);
    EXPECT_EQ(set.charts[0].vertex_count(), 25);
    EXPECT_TRUE(validate(each).valid());
  }
}

TEST(AsMeant, FrontAndBackOfASheetAreTwoChartsWhetherOrNotTheyShareVertices) {
  for (const Atlas& atlas : {double_sided(4, 3), unwelded(double_sided(4, 3)), with_noise(unwelded(double_sided(4, 3)), 3e-7)}) {
    const ChartSet set = split_charts(atlas);
    EXPECT_EQ(chart_sizes(set), (Sizes{{12, 2}}));
    EXPECT_FALSE(set.mirrored[0]);
    EXPECT_TRUE(set.mirrored[1]);
    EXPECT_TRUE(set.defects.empty());
    EXPECT_TRUE(set.folds.empty());
  }
}

TEST(AsMeant, ADuplicateFaceIsAChartAndItsSheetStaysWhole) {
  for (const bool turned : {false, true}) {
    Atlas atlas = sheet(5, 5);
    add_double(atlas, atlas, 12, turned);
    add_double(atlas, atlas, 0, turned);
    for (const Atlas& each : {atlas, shuffled(atlas), unwelded(atlas), with_noise(atlas, 3e-7)}) {
      const ChartSet set = split_charts(each);
      EXPECT_EQ(chart_sizes(set), (Sizes{{1, 2}, {25, 1}}));
      EXPECT_TRUE(set.defects.empty());
    }
  }
}

TEST(AsMeant, ADuplicatedPatchIsOneChartInAnyOrderOfFaces) {
  Atlas atlas = sheet(6, 6);
  for (const int f : {14, 15, 20, 21}) add_double(atlas, atlas, f, false);
  EXPECT_EQ(chart_sizes(split_charts(atlas)), (Sizes{{4, 1}, {36, 1}}));
  EXPECT_EQ(chart_sizes(split_charts(shuffled(atlas))), (Sizes{{4, 1}, {36, 1}}));
}

TEST(AsMeant, AFinDoesNotTearTheSheetItStandsOn) {
  Atlas atlas = sheet(6, 4);
  const int base = static_cast<int>(atlas.positions.size());
  for (int i = 2; i <= 4; ++i) atlas.positions.push_back({0.1 * i, 0.2, 0.1});
  for (int i = 2; i < 4; ++i) {
    const int v = 2 * 7 + i;
    add_face(atlas, {v, v + 1, base + i - 1, base + i - 2},
             {{0.1 * i, 0.2}, {0.1 * i + 0.1, 0.2}, {0.1 * i + 0.1, 0.28}, {0.1 * i, 0.28}});
  }
  // The UVs of the sheet itself, to the last bit.
  for (int c = 24 * 4; c < atlas.corner_count(); ++c) {
    if (atlas.corner_vertices[c] < base) atlas.corner_uvs[c] = atlas.positions[atlas.corner_vertices[c]].head<2>();
  }
  EXPECT_EQ(chart_sizes(split_charts(atlas)), (Sizes{{2, 1}, {24, 1}}));
}

/// Three sides of a box around its corner, and the same box turned by half around one of its edges.
Atlas boxes_at_an_edge() {
  Atlas atlas = flat_atlas({{0, 0, 0}, {0, 0, 1}}, {});
  for (const double sign : {1.0, -1.0}) {
    const int v = static_cast<int>(atlas.positions.size());
    for (const Vec3& p : {Vec3(1, 0, 0), Vec3(1, 0, 1), Vec3(0, 1, 1), Vec3(0, 1, 0), Vec3(1, 1, 0)})
      atlas.positions.emplace_back(sign * p.x(), sign * p.y(), p.z());
    add_face(atlas, {0, v, v + 1, 1}, {{1, 0}, {2, 0}, {2, 1}, {1, 1}});
    add_face(atlas, {0, 1, v + 2, v + 3}, {{1, 0}, {1, 1}, {0, 1}, {0, 0}});
    add_face(atlas, {0, v + 3, v + 4, v}, {{1, 0}, {0, 0}, {0, -1}, {1, -1}});
  }
  return atlas;
}

TEST(AsMeant, BoxesThatMeetAtAnEdgeInSpaceAndInTheUVsAreWholeEach) {
  const Atlas atlas = boxes_at_an_edge();
  EXPECT_EQ(chart_sizes(split_charts(atlas)), (Sizes{{3, 2}}));
  EXPECT_EQ(chart_sizes(split_charts(unwelded(atlas))), (Sizes{{3, 2}}));
}

TEST(AsMeant, EdgesArePairedAlikeOnAnyNumberOfThreads) {
  const Atlas atlas = shapes::combine(std::vector<Atlas>(2000, boxes_at_an_edge()));
  const EdgeJoins alone = join_edges(atlas, Joining::AsMeant);
  EXPECT_EQ(std::count(alone.partners.begin(), alone.partners.end(), -1), 2000 * 2 * 8);
  for (const int threads : {2, 5}) {
    const ThreadPoolScope pool(threads);
    const EdgeJoins joins = join_edges(atlas, Joining::AsMeant, {}, threads);
    EXPECT_EQ(joins.partners, alone.partners);
    EXPECT_EQ(joins.alike, alone.alike);
  }
}

TEST(AsMeant, PagesOfABookAreChartsOfTheirOwn) {
  Atlas atlas = flat_atlas({{0, 0, 0}, {0, 1, 0}}, {});
  for (int page = 0; page < 5; ++page) {
    const int v = static_cast<int>(atlas.positions.size());
    atlas.positions.push_back({1, 0, 0.1 * page});
    atlas.positions.push_back({1, 1, 0.1 * page});
    add_face(atlas, {0, v, v + 1, 1}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  }
  const ChartSet set = split_charts(atlas);
  EXPECT_EQ(set.charts.size(), 5u);
  EXPECT_TRUE(set.defects.empty());
}

TEST(AsMeant, MirroredHalvesArePartedAtTheirCommonLine) {
  const ChartSet set = split_charts(mirrored_halves());
  EXPECT_EQ(chart_sizes(set), (Sizes{{12, 2}}));
  EXPECT_TRUE(set.mirrored[0]);
  EXPECT_FALSE(set.mirrored[1]);
  EXPECT_TRUE(set.defects.empty());
  ASSERT_EQ(set.folds.size(), 1u);
  EXPECT_EQ(set.folds[0].charts, (std::vector<int>{0, 1}));
  ASSERT_EQ(set.folds[0].edges.size(), 4u);
  for (const FoldEdge& edge : set.folds[0].edges) {
    EXPECT_EQ(edge.charts, (std::array<int, 2>{0, 1}));
    for (const auto& [a, b] : edge.ends) EXPECT_EQ(set.points[0][a], set.points[1][b]);
  }
  EXPECT_EQ(set.seam_edges, 0);
}

TEST(AsMeant, AStripFoldedManyTimesIsPartedAtEveryFold) {
  Atlas atlas = sheet(240, 1);
  for (int c = 0; c < atlas.corner_count(); ++c) {
    const int step = atlas.corner_vertices[c] % 241 % 8;
    atlas.corner_uvs[c].x() = 0.1 * std::min(step, 8 - step);
  }
  const ChartSet set = split_charts(atlas);
  EXPECT_EQ(chart_sizes(set), (Sizes{{4, 60}}));
  EXPECT_TRUE(set.defects.empty());
}

TEST(AsMeant, AFewFlippedFacesStayInTheirChart) {
  Atlas atlas = sheet(10, 10);
  const Vec2 away(0.25, 0);  // an inner vertex pulled over its right neighbours
  for (int c = 0; c < atlas.corner_count(); ++c) {
    if (atlas.corner_vertices[c] == 5 * 11 + 5) atlas.corner_uvs[c] += away;
  }
  for (const Atlas& each : {atlas, unwelded(atlas)}) {
    const ChartSet set = split_charts(each);
    EXPECT_EQ(set.charts.size(), 1u);
    EXPECT_TRUE(set.folds.empty());
    EXPECT_FALSE(set.defects.empty());
  }
}

TEST(AsMeant, FacesDrawnOverTheWholeWidthAreTheDefects) {
  // A tube whose last column runs back to u = 0: it covers as much of the map as all others.
  constexpr int kColumns = 12, kRows = 3;
  Atlas atlas = sheet(kColumns, kRows);
  for (int c = 0; c < atlas.corner_count(); ++c) {
    int& v = atlas.corner_vertices[c];
    const int column = v % (kColumns + 1);
    if (column == kColumns) v -= kColumns;
    atlas.corner_uvs[c].x() = 0.1 * (column % kColumns);
  }
  for (int v = 0; v < static_cast<int>(atlas.positions.size()); ++v) {
    const double angle = 2 * M_PI * (v % (kColumns + 1)) / kColumns;
    atlas.positions[v] = Vec3(std::cos(angle), std::sin(angle), 0.5 * (v / (kColumns + 1)));
  }
  const ChartSet set = split_charts(atlas);
  EXPECT_EQ(set.charts.size(), 1u);
  EXPECT_FALSE(set.mirrored[0]);
  ASSERT_EQ(set.defects.size(), static_cast<std::size_t>(kRows));
  for (const FaceDefect& defect : set.defects) EXPECT_EQ(defect.face % kColumns, kColumns - 1);
}

TEST(AsMeant, APinchDrawnApartByNoiseIsOnePoint) {
  const Atlas atlas = pinched_sheet();
  EXPECT_TRUE(validate(atlas).valid());
  EXPECT_TRUE(validate(with_noise(atlas, 3e-7)).valid()) << validate(with_noise(atlas, 3e-7)).problem;
}

TEST(AsMeant, ThousandsOfFacesAtOneEdgeEnd) {
  Atlas atlas = flat_atlas({{0, 0, 0}, {1, 0, 0}}, {});
  for (int k = 0; k < 20000; ++k) {
    const int v = static_cast<int>(atlas.positions.size());
    atlas.positions.push_back({0.5, 1, 0.001 * k});
    add_face(atlas, k % 2 ? std::vector<int>{0, 1, v} : std::vector<int>{1, 0, v},
             k % 2 ? std::vector<Vec2>{{0, 0}, {1, 0}, {0.5, 1}} : std::vector<Vec2>{{1, 0}, {0, 0}, {0.5, -1}});
  }
  EXPECT_EQ(split_charts(atlas).charts.size(), 20000u);
}

}  // namespace
}  // namespace atlas_refine
