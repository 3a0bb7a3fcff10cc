// Cuts that open holes: what they are thought to free.
#include "seams/cut_places.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "input/split_charts.h"
#include "shapes.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

/// The one chart of an atlas, to be cut along edges.
struct Whole {
  ChartSet set;
  CutAtlas whole = whole_atlas(set.charts);
  SidePrices prices;
  ChartCuts cuts{whole.pieces[0], set.charts[0], prices, Cut::Edges};

  explicit Whole(const Atlas& atlas) : set(split_charts(atlas)) {}
  std::vector<CutPlace> places() const {
    return cut_places({{&cuts, &set.charts[0], {{set.charts[0].uvs[0], 0.2}, {set.charts[0].uvs[1], 0.1}}}}, 20, 0);
  }
};

Atlas flat_ring() { return shapes::mesh(shapes::ring(), 0.1, 0); }

TEST(CutPlaces, TheBorderTurnsAsOnTheSurface) {
  for (const double turn : Whole(tube_as_ring(12, 3, 0.3)).cuts.turns()) EXPECT_NEAR(turn, 0, 1e-9);
  const Whole flat(flat_ring());
  const std::vector<double> turns = flat.cuts.turns();
  ASSERT_EQ(turns.size(), 2U);
  EXPECT_NEAR(std::abs(turns[0]), 2 * std::numbers::pi, 1e-6);
  EXPECT_NEAR(turns[0] + turns[1], 0, 1e-6);
}

TEST(CutPlaces, AlongATubeACutFreesAllOfIt) {
  const std::vector<CutPlace> places = Whole(tube_as_ring(12, 3, 0)).places();
  ASSERT_FALSE(places.empty());
  for (const CutPlace& place : places) EXPECT_NEAR(place.freed, 0.3, 1e-9);
}

TEST(CutPlaces, FromAHoleInWhatIsFlatItFreesNothing) {
  const std::vector<CutPlace> places = Whole(flat_ring()).places();
  ASSERT_FALSE(places.empty());
  for (const CutPlace& place : places) EXPECT_NEAR(place.freed, 0, 1e-9);
}

TEST(CutPlaces, OnceItIsOpenNoHoleIsLeft) {
  Whole tube(tube_as_ring(12, 3, 0.5));
  ASSERT_TRUE(tube.cuts.add(tube.cuts.ways_from_holes().front()));
  EXPECT_TRUE(tube.cuts.ways_from_holes().empty());
  for (const CutPlace& place : tube.places()) EXPECT_EQ(place.freed, 0);
}

TEST(CutPlaces, TheShortestWayIsStraightOnTheSurfaceHoweverItRunsThroughTheUvs) {
  Whole tube(tube_as_ring(12, 3, 0.5));
  const std::vector<Chord> ways = tube.cuts.ways_from_holes();
  ASSERT_EQ(ways.size(), 1U);
  ASSERT_TRUE(tube.cuts.add(ways[0]));
  EXPECT_NEAR(tube.cuts.length(), 3, 1e-9);
}

}  // namespace
}  // namespace atlas_refine
