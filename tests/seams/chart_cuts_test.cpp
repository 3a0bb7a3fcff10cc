// Cuts on one chart: where they run, what they leave.
#include "seams/chart_cuts.h"

#include <gtest/gtest.h>

#include <set>

#include "cut_checks.h"
#include "input/price_sides.h"
#include "sheets.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

/// A sheet of 10 x 6 quads, 1 x 0.6, and cuts on it.
struct Sheet {
  Atlas atlas = sheet(10, 6);
  ChartSet set = split_charts(atlas);
  CutAtlas whole = whole_atlas(set.charts);
  SidePrices prices;
  ChartCuts cuts;

  explicit Sheet(Cut cut, const RefineOptions& asked = {})
      : prices(price(cut, asked)), cuts(whole.pieces[0], set.charts[0], prices, cut) {}

  SidePrices price(Cut cut, RefineOptions options) const {
    options.cut = cut;
    const std::vector<SidePrices> all = price_sides(atlas, set, options);
    return all.empty() ? SidePrices() : all[0];
  }
  int vertex(double x, double y) const {
    for (int v = 0; v < set.charts[0].vertex_count(); ++v) {
      if ((set.charts[0].uvs[v] - Vec2(x, y)).norm() < 1e-9) return v;
    }
    return -1;
  }
  Chord chord(const Vec2& from, const Vec2& to) const {
    const int a = vertex(from.x(), from.y()), b = vertex(to.x(), to.y());
    return {.ends = {a, b}, .at = {set.charts[0].uvs[a], set.charts[0].uvs[b]}};
  }
};

TEST(ChartCuts, AcrossFacesTheyRunStraight) {
  Sheet sheet(Cut::Split);
  ASSERT_TRUE(sheet.cuts.add(sheet.chord({0.3, 0}, {0.6, 0.6})));
  EXPECT_NEAR(sheet.cuts.length(), std::hypot(0.3, 0.6), 0.02);
  EXPECT_NEAR(sheet.cuts.smallest_part(), 0.27, 0.02);
  testing::expect_conforming(sheet.cuts.mesh());
  testing::expect_positive(sheet.cuts.mesh().uvs, sheet.cuts.mesh().triangles);
  const Border border = sheet.cuts.border();
  ASSERT_EQ(border.loops.size(), 2u);
  for (std::size_t l = 0; l < 2; ++l) {
    for (std::size_t k = 0; k < border.loops[l].size(); ++k)
      EXPECT_EQ(sheet.cuts.mesh().uvs[border.loops[l][k]], border.at[l][k]);
  }
}

TEST(ChartCuts, AlongEdgesNoFaceIsDivided) {
  Sheet sheet(Cut::Edges);
  ASSERT_TRUE(sheet.cuts.add(sheet.chord({0.3, 0}, {0.6, 0.6})));
  EXPECT_EQ(sheet.cuts.mesh().vertex_count(), sheet.set.charts[0].vertex_count());
  EXPECT_NEAR(sheet.cuts.length(), 0.9, 1e-9);  // quads have no diagonals to run along
}

TEST(ChartCuts, AlongEdgesTheyKeepOffThoseThatMustStayWhole) {
  RefineOptions options;
  for (int row = 2; row < 4; ++row) options.no_seam.push_back({row * 11 + 5, (row + 1) * 11 + 5});  // of the column x = 0.5
  Sheet sheet(Cut::Edges, options);
  ASSERT_TRUE(sheet.cuts.add(sheet.chord({0.5, 0}, {0.5, 0.6})));
  EXPECT_NEAR(sheet.cuts.length(), 0.8, 1e-9);
}

TEST(ChartCuts, AWayToAPointInsideLeavesOnePart) {
  Sheet sheet(Cut::Split);
  ASSERT_TRUE(sheet.cuts.add(sheet.chord({0.5, 0}, {0.5, 0.3})));
  EXPECT_NEAR(sheet.cuts.smallest_part(), 0.6, 1e-9);
  EXPECT_EQ(sheet.cuts.border().loops.size(), 1u);
}

TEST(ChartCuts, TheSecondMayEndOnTheFirst) {
  Sheet sheet(Cut::Split);
  ASSERT_TRUE(sheet.cuts.add(sheet.chord({0.5, 0}, {0.5, 0.6})));
  ASSERT_TRUE(sheet.cuts.add(sheet.chord({1, 0.3}, {0.5, 0.3})));
  EXPECT_NEAR(sheet.cuts.smallest_part(), 0.15, 1e-9);
  EXPECT_EQ(sheet.cuts.border().loops.size(), 3u);
}

// Its vertices would no longer be neighbours.
TEST(ChartCuts, NoneCrossesAnother) {
  Sheet sheet(Cut::Split);
  ASSERT_TRUE(sheet.cuts.add(sheet.chord({0.3, 0}, {0.6, 0.6})));
  const double length = sheet.cuts.length();
  const int vertices = sheet.cuts.mesh().vertex_count();
  EXPECT_FALSE(sheet.cuts.add(sheet.chord({0, 0.5}, {1, 0.1})));
  EXPECT_EQ(sheet.cuts.length(), length);
  EXPECT_EQ(sheet.cuts.mesh().vertex_count(), vertices);
}

TEST(ChartCuts, WhatLeadsNowhereChangesNothing) {
  Sheet sheet(Cut::Split);
  EXPECT_FALSE(sheet.cuts.add({.ends = {0, 100000}, .at = {Vec2(0, 0), Vec2(1, 1)}}));
  Chord elsewhere = sheet.chord({0.5, 0}, {0.5, 0.6});
  elsewhere.at[1].x() += 0.01;  // the vertex is not where it was when the chord was found
  EXPECT_FALSE(sheet.cuts.add(elsewhere));
  EXPECT_FALSE(sheet.cuts.add(sheet.chord({0.2, 0}, {0.8, 0})));  // along the border
  EXPECT_EQ(sheet.cuts.length(), 0);
  EXPECT_EQ(sheet.cuts.mesh().triangle_count(), static_cast<int>(sheet.set.charts[0].triangles.size()));
}

/// A plank of one face, 20 x 1.
struct Plank {
  ChartSet set = split_charts(plank(20));
  CutAtlas whole = whole_atlas(set.charts);
  SidePrices prices;
  ChartCuts cuts;

  explicit Plank(Cut cut) : cuts(whole.pieces[0], set.charts[0], prices, cut) {}

  /// Number of the place at this point of the border.
  int place(const Vec2& at) const {
    const Border border = cuts.border();
    for (std::size_t l = 0; l < border.loops.size(); ++l) {
      for (std::size_t k = 0; k < border.loops[l].size(); ++k) {
        if ((border.at[l][k] - at).norm() < 1e-9) return border.loops[l][k];
      }
    }
    return 1000;
  }
  Chord across(double x) const { return {.ends = {place({x, 0}), place({x, 1})}, .at = {Vec2(x, 0), Vec2(x, 1)}}; }
};

TEST(ChartCuts, LongFacesAreCutAcrossAtEvenPlaces) {
  Plank plank(Cut::Split);
  const std::vector<Chord> found = necks(plank.cuts.border(), 0.4, 5);
  ASSERT_EQ(found.size(), 5u);
  for (const Chord& chord : found) EXPECT_NEAR(chord.length(), 1, 1e-9);
  EXPECT_EQ(plank.cuts.mesh().vertex_count(), 4);
  EXPECT_FALSE(plank.cuts.divides_border());
  for (const double x : {5.0, 10.0, 1.0}) ASSERT_TRUE(plank.cuts.add(plank.across(x)));
  EXPECT_TRUE(plank.cuts.divides_border());
  EXPECT_NEAR(plank.cuts.length(), 3, 1e-9);  // near the end too, where the diagonal's end is near
  EXPECT_NEAR(plank.cuts.smallest_part(), 1, 1e-9);
  EXPECT_EQ(plank.cuts.border().loops.size(), 4u);
  testing::expect_conforming(plank.cuts.mesh());
  testing::expect_positive(plank.cuts.mesh().uvs, plank.cuts.mesh().triangles);
}

TEST(ChartCuts, PlacesWhereNoCutEndsAreNoVertices) {
  Plank plank(Cut::Split);
  ASSERT_TRUE(plank.cuts.add(plank.across(5)));
  const SplitMesh& mesh = plank.cuts.mesh();
  int on_long_edges = 0;
  for (const Vec2& uv : mesh.uvs) on_long_edges += uv.x() > 0 && uv.x() < 20 && (uv.y() == 0 || uv.y() == 1);
  EXPECT_EQ(on_long_edges, 2);
  const int vertices = mesh.vertex_count();
  Chord wrong = plank.across(10);
  wrong.ends[1] = wrong.ends[0];
  EXPECT_FALSE(plank.cuts.add(wrong));
  wrong = plank.across(10);
  wrong.at[1] = wrong.at[0] + Vec2(1, 0);
  EXPECT_FALSE(plank.cuts.add(wrong));
  EXPECT_EQ(mesh.vertex_count(), vertices);
}

// They keep their numbers, so that what is known of a cut holds beside others.
TEST(ChartCuts, PlacesAreTheSameAfterOtherCuts) {
  Plank plank(Cut::Split);
  const Chord chord = plank.across(10);
  ASSERT_TRUE(plank.cuts.add(plank.across(5)));
  EXPECT_EQ(plank.across(10).ends, chord.ends);
  ASSERT_TRUE(plank.cuts.add(chord));
  EXPECT_NEAR(plank.cuts.length(), 2, 1e-9);
}

TEST(ChartCuts, AlongEdgesALongFaceHasNoPlaces) {
  Plank plank(Cut::Edges);
  EXPECT_EQ(plank.cuts.border().loops[0].size(), 4u);
}

}  // namespace
}  // namespace atlas_refine
