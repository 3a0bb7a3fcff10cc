// What pieces are likely to lose, told by their outlines.
#include "needed/cut_outlines.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "charts.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

/// One chart without cuts.
struct Whole {
  std::vector<Chart> charts;
  CutAtlas atlas;
  SidePrices prices;
  RefineOptions options;
  ShapesAsTheyCame shapes;
  std::vector<ChartCuts> cuts;

  explicit Whole(const shapes::Polygon& polygon) : charts(testing::charts_of(shapes::mesh(polygon, 0.05, 0))) {
    atlas = whole_atlas(charts);
    shapes = shapes_as_they_came(charts, atlas, {});
    cuts.emplace_back(atlas.pieces[0], charts[0], prices, options.cut);
  }
  CutOutlines outlines() const { return {options, cuts, shapes}; }
  std::vector<Chord> chords() const { return necks(cuts[0].border(), 0.02, 20); }
};

TEST(CutOutlines, WhatFillsItsBoxLosesNothing) { EXPECT_EQ(Whole(shapes::rectangle(1, 0.6)).outlines().strain(), 0); }

TEST(CutOutlines, ACutAcrossAnSLetsItsPartsBePacked) {
  const Whole s(shapes::s_shape());
  const CutOutlines outlines = s.outlines();
  ASSERT_GT(outlines.strain(), 0.005);
  std::vector<double> strains;
  for (const Chord& chord : s.chords()) {
    const auto strain = outlines.strain_with({0, chord});
    ASSERT_TRUE(strain.has_value());
    strains.push_back(*strain);
  }
  ASSERT_GE(strains.size(), 4u);
  EXPECT_LT(*std::min_element(strains.begin(), strains.end()), 0.6 * outlines.strain());
}

TEST(CutOutlines, TheyAreThoseThatTheCutLeaves) {
  Whole s(shapes::s_shape());
  for (const Chord& chord : s.chords()) {
    Whole cut(shapes::s_shape());
    ASSERT_TRUE(cut.cuts[0].add(chord));
    EXPECT_NEAR(*s.outlines().strain_with({0, chord}), cut.outlines().strain(), 0.005);
  }
}

TEST(CutOutlines, FromAHoleToTheOutsideNothingIsParted) {
  const Whole ring(shapes::ring());
  const CutOutlines outlines = ring.outlines();
  ASSERT_EQ(ring.cuts[0].border().loops.size(), 2u);
  int across = 0;
  for (const Chord& chord : ring.chords()) {
    if (chord.cut_off > 0) continue;
    ++across;
    EXPECT_NEAR(*outlines.strain_with({0, chord}), outlines.strain(), 1e-3);
  }
  EXPECT_GT(across, 0);
}

TEST(CutOutlines, OfAWayToAPointInsideNothingIsKnown) {
  const Whole s(shapes::s_shape());
  const Border border = s.cuts[0].border();
  int inside = 0;
  while (std::find(border.loops[0].begin(), border.loops[0].end(), inside) != border.loops[0].end()) ++inside;
  const Chord way{.ends = {border.loops[0][0], inside}, .at = {border.at[0][0], s.charts[0].uvs[inside]}};
  EXPECT_FALSE(s.outlines().strain_with({0, way}).has_value());
}

}  // namespace
}  // namespace atlas_refine
