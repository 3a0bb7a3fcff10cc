// Near pairs against brute force, and those of a boundary that moves against a search of its own each time.
#include "geometry/near_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "flat_boundary.h"
#include "geometry/box_tree.h"
#include "shapes.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

Box swept(const Vec2& position, const Vec2& displacement) {
  return {position.cwiseMin(position + displacement), position.cwiseMax(position + displacement)};
}

std::vector<Atlas> atlases() {
  return {shapes::mesh(shapes::comb(), 0.08), shapes::disk_in_ring(), shapes::squares(12, 0.02),
          shapes::mesh(shapes::random_polygon(5), 0.1)};
}

std::vector<Vec2> random_moves(std::size_t count, double longest, Rng& rng) {
  std::vector<Vec2> moves;
  for (std::size_t k = 0; k < count; ++k) moves.emplace_back(rng.uniform(-longest, longest), rng.uniform(-longest, longest));
  return moves;
}

TEST(NearPairs, AreThoseOfBruteForce) {
  Rng rng(11);
  for (const Atlas& atlas : atlases()) {
    const auto [b, positions] = flat_boundary(atlas);
    for (const double radius : {0.0, 0.01, 0.1}) {
      const std::vector<Vec2> moves = random_moves(positions.size(), 0.05, rng);
      const std::vector<PointEdge> pairs = near_pairs(b, positions, moves, radius);
      const auto key = [](const PointEdge& p) { return std::tuple(p.point, p.edge); };
      EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end(), [&](const auto& p, const auto& q) { return key(p) < key(q); }));
      std::size_t found = 0, near = 0;
      for (int point = 0; point < b.size(); ++point) {
        for (int edge = 0; edge < b.size(); ++edge) {
          const bool listed = found < pairs.size() && key(pairs[found]) == std::tuple(point, edge);
          if (listed) ++found;
          const bool neighbours = edge == point || b.next[edge] == point;
          const bool through_the_chart = b.chart[edge] == b.chart[point] && b.loop[edge] != b.loop[point];
          const int p = b.vertex[point], from = b.vertex[edge], to = b.vertex[b.next[edge]];
          const Box first = swept(positions[from], moves[from]), second = swept(positions[to], moves[to]);
          const Box whole{first.min.cwiseMin(second.min), first.max.cwiseMax(second.max)};
          const double distance = box_distance(swept(positions[p], moves[p]), whole);
          const bool must_be = !neighbours && !through_the_chart && distance <= radius;
          // The search may take a square for the circle of its radius.
          const bool may_be = !neighbours && !through_the_chart && distance <= std::sqrt(2.0) * radius + 1e-12;
          EXPECT_TRUE(listed || !must_be) << point << " " << edge;
          EXPECT_TRUE(!listed || may_be) << point << " " << edge;
          near += must_be;
        }
      }
      EXPECT_EQ(found, pairs.size());
      EXPECT_GT(near, 0u);
    }
  }
}

/// As an optimisation asks: at rest, along a step, along a part of it; steps grow and shrink.
TEST(NearPairs, OfABoundaryThatMovesAreThoseOfASearchEachTime) {
  Rng rng(12);
  for (const Atlas& atlas : atlases()) {
    auto [b, positions] = flat_boundary(atlas);
    NearPairs near;
    std::size_t some = 0;
    const auto check = [&](const std::vector<Vec2>& moves, double radius) {
      const auto expected = near_pairs(b, positions, moves, radius), found = near.find(b, positions, moves, radius);
      some += found.size();
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t k = 0; k < found.size(); ++k)
        EXPECT_EQ(std::tuple(found[k].point, found[k].edge), std::tuple(expected[k].point, expected[k].edge));
    };
    for (int iteration = 0; iteration < 40; ++iteration) {
      const double longest = 0.03 * std::pow(0.5 + 0.5 * std::cos(0.4 * iteration), 4), radius = iteration < 30 ? 0.05 : 0.1;
      const std::vector<Vec2> moves = random_moves(positions.size(), longest, rng);
      check({}, radius);
      check(moves, 0);
      check(moves, radius);
      for (std::size_t v = 0; v < positions.size(); ++v) positions[v] += moves[v];
    }
    EXPECT_GT(some, 0u);
  }
}

}  // namespace
}  // namespace atlas_refine
