// Flat boundaries, near pairs against brute force, and which pairs face each other through the outside.
#include "geometry/boundary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "charts.h"
#include "geometry/box_tree.h"
#include "shapes.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

struct Flat {
  Boundary boundary;
  std::vector<Vec2> positions;
};

Flat flat(const Atlas& atlas) {
  const std::vector<Chart> charts = testing::charts_of(atlas);
  Flat result;
  std::vector<int> first;
  for (const Chart& chart : charts) {
    first.push_back(static_cast<int>(result.positions.size()));
    result.positions.insert(result.positions.end(), chart.uvs.begin(), chart.uvs.end());
  }
  result.boundary = make_boundary(charts, first);
  return result;
}

Box swept(const Vec2& position, const Vec2& displacement) {
  return {position.cwiseMin(position + displacement), position.cwiseMax(position + displacement)};
}

TEST(Boundary, LoopsAreClosedAndArcsAreMeasuredOnTheSurface) {
  const Flat ring = flat(shapes::mesh(shapes::ring(), 0.05, 0));
  const Boundary& b = ring.boundary;
  ASSERT_EQ(b.loop_length.size(), 2u);
  for (int e = 0; e < b.size(); ++e) {
    EXPECT_EQ(b.previous[b.next[e]], e);
    EXPECT_EQ(b.loop[b.next[e]], b.loop[e]);
    const double length = (ring.positions[b.vertex[b.next[e]]] - ring.positions[b.vertex[e]]).norm();
    const double step = std::fmod(b.arc[b.next[e]] - b.arc[e] + b.loop_length[b.loop[e]], b.loop_length[b.loop[e]]);
    EXPECT_NEAR(step, length, 1e-12);  // a flat surface: its lengths are those of the UVs
  }
  EXPECT_NEAR(b.loop_length[0], 48 * 2 * 0.5 * std::sin(std::acos(-1) / 48), 1e-9);
}

TEST(Boundary, ArcBetweenTakesTheShorterWayRound) {
  const Flat square = flat(shapes::mesh(shapes::rectangle(1, 1), 0.1, 0));
  const Boundary& b = square.boundary;
  ASSERT_EQ(b.size(), 40);
  for (int ahead = 0; ahead < 40; ++ahead) {
    int edge = 0;
    for (int k = 0; k < ahead; ++k) edge = b.next[edge];
    const double to_start = 0.1 * std::min(ahead, 40 - ahead), to_end = 0.1 * std::min((ahead + 1) % 40, 39 - ahead);
    EXPECT_NEAR(b.arc_between(0, edge), std::min(to_start, to_end), 1e-9) << ahead;
  }
}

TEST(NearPairs, AreThoseOfBruteForce) {
  const Atlas atlases[] = {shapes::mesh(shapes::comb(), 0.08), shapes::disk_in_ring(), shapes::squares(12, 0.02),
                           shapes::mesh(shapes::random_polygon(5), 0.1)};
  Rng rng(11);
  for (const Atlas& atlas : atlases) {
    const auto [b, positions] = flat(atlas);
    for (const double radius : {0.0, 0.01, 0.1}) {
      std::vector<Vec2> moves(positions.size(), Vec2::Zero());
      for (Vec2& move : moves) {
        move.x() = rng.uniform(-0.05, 0.05);
        move.y() = rng.uniform(-0.05, 0.05);
      }
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

TEST(ClosestOnSegment, IsTheNearestOfManySamples) {
  Rng rng(4);
  for (int trial = 0; trial < 200; ++trial) {
    const auto random = [&] { return Vec2(rng.uniform(-1, 1), rng.uniform(-1, 1)); };
    const Vec2 point = random(), start = random(), end = random();
    const Closest closest = closest_on_segment(point, start, end);
    double nearest = INFINITY;
    for (int k = 0; k <= 1000; ++k) nearest = std::min(nearest, (point - start - (k / 1000.0) * (end - start)).norm());
    EXPECT_LE(closest.distance, nearest + 1e-12);
    EXPECT_NEAR(closest.distance, nearest, 2e-3);
    EXPECT_NEAR((start + closest.along * (end - start) + closest.offset - point).norm(), 0, 1e-12);
  }
  EXPECT_EQ(closest_on_segment({1, 1}, {0, 0}, {0, 0}).distance, std::sqrt(2.0));
}

// In a U the two inner flanks face each other through the outside, an outer flank and its inner one through the chart.
TEST(FacesOutside, TellsTheSlotFromTheLimb) {
  const auto [b, positions] = flat(shapes::mesh(shapes::u_shape(), 0.1));
  const auto on_line = [&](int v, double x) {
    const Vec2& p = positions[b.vertex[v]];
    return std::abs(p.x() - x) < 1e-9 && p.y() > 0.35 && p.y() < 0.95;
  };
  int slot = 0, limb = 0;
  for (int point = 0; point < b.size(); ++point) {
    for (int edge = 0; edge < b.size(); ++edge) {
      if (!on_line(point, 0.2)) continue;
      const bool across_slot = on_line(edge, 0.6) && on_line(b.next[edge], 0.6);
      const bool across_limb = on_line(edge, 0) && on_line(b.next[edge], 0);
      if (!across_slot && !across_limb) continue;
      const Closest closest =
          closest_on_segment(positions[b.vertex[point]], positions[b.vertex[edge]], positions[b.vertex[b.next[edge]]]);
      EXPECT_EQ(faces_outside(b, positions, {point, edge}, closest), across_slot);
      ++(across_slot ? slot : limb);
    }
  }
  EXPECT_GT(slot, 20);
  EXPECT_GT(limb, 20);
}

}  // namespace
}  // namespace atlas_refine
