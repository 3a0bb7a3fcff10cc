// Prices of edges: diagonals, sharp edges, edges wanted and not.
#include "input/price_sides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "small_atlases.h"

namespace atlas_refine {
namespace {

/// The price of the edge between two vertices of the input, from either side; 0 where the sides differ.
double price_between(const Atlas& atlas, const ChartSet& set, const std::vector<SidePrices>& prices, int a, int b) {
  std::vector<double> found;
  for (std::size_t c = 0; c < set.charts.size(); ++c) {
    std::vector<int> vertex(set.charts[c].vertex_count());
    for (std::size_t k = 0; k < set.corners.size(); ++k) {
      if (set.corners[k].chart == static_cast<int>(c)) vertex[set.corners[k].vertex] = atlas.corner_vertices[k];
    }
    for (std::size_t t = 0; t < prices[c].size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const int from = vertex[set.charts[c].triangles[t][k]], to = vertex[set.charts[c].triangles[t][(k + 1) % 3]];
        if (std::minmax(from, to) == std::minmax(a, b)) found.push_back(prices[c][t][k]);
      }
    }
  }
  return found.empty() || found.front() != found.back() ? 0 : found.front();
}

/// Two quads that meet in the edge 2-3, the second one bent down by `bend_rad`.
Atlas bent(double bend_rad) {
  Atlas atlas = strip(2);
  for (int v : {4, 5}) atlas.positions[v] = Vec3(1 + std::cos(bend_rad), atlas.positions[v].y(), -std::sin(bend_rad));
  return atlas;
}

RefineOptions edges() {
  RefineOptions options;
  options.cut = Cut::Edges;
  return options;
}

double price_of_fold(double bend_rad, const RefineOptions& options = edges()) {
  const Atlas atlas = bent(bend_rad);
  const ChartSet set = split_charts(atlas);
  return price_between(atlas, set, price_sides(atlas, set, options), 2, 3);
}

TEST(PriceSides, DiagonalsStayWhole) {
  const Atlas atlas = strip(1);
  const ChartSet set = split_charts(atlas);
  const auto prices = price_sides(atlas, set, edges());
  EXPECT_TRUE(price_between(atlas, set, prices, 0, 3) == kNoSeam || price_between(atlas, set, prices, 1, 2) == kNoSeam);
  for (const Triangle side : {Triangle{0, 1}, Triangle{0, 2}, Triangle{2, 3}, Triangle{1, 3}})
    EXPECT_EQ(price_between(atlas, set, prices, side[0], side[1]), 1);
}

TEST(PriceSides, SharpEdgesAreCheap) {
  EXPECT_EQ(price_of_fold(0), 1);
  EXPECT_NEAR(price_of_fold(0.25 * std::numbers::pi), 0.75, 1e-12);
  EXPECT_NEAR(price_of_fold(0.5 * std::numbers::pi), 0.5, 1e-12);
  EXPECT_NEAR(price_of_fold(0.7 * std::numbers::pi), 0.5, 1e-12);
}

TEST(PriceSides, HiddenEdgesAreCheap) {
  // A fold inwards is seen from fewer sides.
  EXPECT_LT(price_of_fold(-0.25 * std::numbers::pi), 0.74);
  EXPECT_GT(price_of_fold(-0.25 * std::numbers::pi), 0.7);
  Atlas under = strip(2);
  under.positions.insert(under.positions.end(), {{-9, -9, 2}, {9, -9, 2}, {0, 9, 2}});
  for (const int v : {6, 7, 8}) {
    under.corner_vertices.push_back(v);
    under.corner_uvs.push_back(under.positions[v].head<2>());
  }
  under.face_offsets.push_back(under.corner_count());
  const ChartSet set = split_charts(under);
  EXPECT_LT(price_between(under, set, price_sides(under, set, edges()), 2, 3), 0.6);
}

TEST(PriceSides, EdgesWantedAndNot) {
  RefineOptions options = edges();
  options.prefer_seam = {{3, 2}};
  EXPECT_NEAR(price_of_fold(0, options), 0.1, 1e-12);
  EXPECT_NEAR(price_of_fold(0.5 * std::numbers::pi, options), 0.05, 1e-12);
  options.no_seam = {{2, 3}};
  EXPECT_EQ(price_of_fold(0, options), kNoSeam);
}

TEST(PriceSides, WhereFacesAreDividedOnlyForbiddenEdgesDiffer) {
  const Atlas atlas = bent(1);
  const ChartSet set = split_charts(atlas);
  RefineOptions options;
  EXPECT_TRUE(price_sides(atlas, set, options).front().empty());
  options.no_seam = {{2, 3}};
  const auto prices = price_sides(atlas, set, options);
  EXPECT_EQ(price_between(atlas, set, prices, 2, 3), kNoSeam);
  EXPECT_EQ(price_between(atlas, set, prices, 0, 1), 1);
  EXPECT_NE(price_between(atlas, set, prices, 0, 3) + price_between(atlas, set, prices, 1, 2), kNoSeam);
}

TEST(PriceSides, DoubledVerticesAreOneEdge) {
  Atlas atlas = bent(0);
  for (int v : {2, 3}) {
    const int copy = static_cast<int>(atlas.positions.size());
    atlas.positions.push_back(Vec3(atlas.positions[v]));
    std::replace(atlas.corner_vertices.begin() + 4, atlas.corner_vertices.end(), v, copy);
  }
  const ChartSet set = split_charts(atlas);
  ASSERT_EQ(set.charts.size(), 1);
  RefineOptions options = edges();
  options.no_seam = {{6, 7}};
  const auto prices = price_sides(atlas, set, options);
  int forbidden = 0;
  for (const auto& sides : prices.front()) forbidden += static_cast<int>(std::count(sides.begin(), sides.end(), kNoSeam));
  EXPECT_EQ(forbidden, 2 + 4) << "both sides of the edge, and of each of the two diagonals";
}

}  // namespace
}  // namespace atlas_refine
