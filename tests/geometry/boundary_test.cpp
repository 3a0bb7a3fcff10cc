// Flat boundaries, and which pairs face each other through the outside.
#include "geometry/boundary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flat_boundary.h"
#include "shapes.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

TEST(Boundary, LoopsAreClosedAndArcsAreMeasuredOnTheSurface) {
  const FlatBoundary ring = flat_boundary(shapes::mesh(shapes::ring(), 0.05, 0));
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
  const FlatBoundary square = flat_boundary(shapes::mesh(shapes::rectangle(1, 1), 0.1, 0));
  const Boundary& b = square.boundary;
  ASSERT_EQ(b.size(), 40);
  for (int ahead = 0; ahead < 40; ++ahead) {
    int edge = 0;
    for (int k = 0; k < ahead; ++k) edge = b.next[edge];
    const double to_start = 0.1 * std::min(ahead, 40 - ahead), to_end = 0.1 * std::min((ahead + 1) % 40, 39 - ahead);
    EXPECT_NEAR(b.arc_between(0, edge), std::min(to_start, to_end), 1e-9) << ahead;
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
  const auto [b, positions] = flat_boundary(shapes::mesh(shapes::u_shape(), 0.1));
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
