// Flip and collision times against brute force.
#include "geometry/collision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geometry/boundary.h"
#include "geometry/plane.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

Vec2 at(const Moving& m, double t) { return m.position + t * m.displacement; }
Moving random_moving(Rng& rng) {
  return {Vec2(rng.uniform(-1, 1), rng.uniform(-1, 1)), Vec2(rng.uniform(-1, 1), rng.uniform(-1, 1))};
}

TEST(FlipTime, IsTheFirstZeroOfTheArea) {
  Rng rng(1);
  int flips = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Moving p[3] = {random_moving(rng), random_moving(rng), random_moving(rng)};
    const auto area = [&](double t) { return cross(at(p[1], t) - at(p[0], t), at(p[2], t) - at(p[0], t)); };
    if (area(0) < 1e-3) continue;
    const double time = flip_time(p[0], p[1], p[2]);
    double brute = std::numeric_limits<double>::infinity();
    for (int k = 1; k <= 20000 && std::isinf(brute); ++k) {
      if (area(k * 1e-4) <= 0) brute = k * 1e-4;
    }
    if (std::isinf(brute)) {
      EXPECT_GT(time, 2 - 1e-3);
    } else {
      EXPECT_NEAR(time, brute, 1.1e-4);
      ++flips;
    }
  }
  EXPECT_GT(flips, 100);
}

TEST(HitTime, IsTheFirstTouchOfPointAndEdge) {
  Rng rng(2);
  int hits = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Moving p = random_moving(rng), a = random_moving(rng), b = random_moving(rng);
    const double time = hit_time(p, a, b, 1.0);
    // A touch lies where the side changes while the projection is inside the edge.
    double brute = std::numeric_limits<double>::infinity();
    const auto side = [&](double t) { return cross(at(b, t) - at(a, t), at(p, t) - at(a, t)); };
    for (int k = 0; k < 10000 && std::isinf(brute); ++k) {
      const double t0 = k * 1e-4, t1 = t0 + 1e-4;
      if (side(t0) * side(t1) > 0) continue;
      const Vec2 edge = at(b, t1) - at(a, t1);
      const double along = edge.dot(at(p, t1) - at(a, t1)) / edge.squaredNorm();
      if (along > 0.001 && along < 0.999)
        brute = t1;
      else if (along > -0.001 && along < 1.001)
        brute = -1;  // too near an end to tell by sampling
    }
    if (brute < 0) continue;
    if (std::isinf(brute)) {
      EXPECT_TRUE(std::isinf(time)) << "trial " << trial;
    } else {
      EXPECT_NEAR(time, brute, 1.1e-4) << "trial " << trial;
      ++hits;
    }
  }
  EXPECT_GT(hits, 100);
}

TEST(HitTime, SeesAGrazedEndPoint) {
  const Moving point{Vec2(0, 1), Vec2(0, -2)};
  EXPECT_NEAR(hit_time(point, {Vec2(0, 0), Vec2::Zero()}, {Vec2(1, 0), Vec2::Zero()}, 1.0), 0.5, 1e-12);
  EXPECT_TRUE(std::isinf(hit_time(point, {Vec2(1e-5, 0), Vec2::Zero()}, {Vec2(1, 0), Vec2::Zero()}, 1.0)));
}

TEST(SmallestPositiveRoot, CoversEveryCase) {
  EXPECT_TRUE(std::isinf(smallest_positive_root(0, 0, 1)));
  EXPECT_DOUBLE_EQ(smallest_positive_root(0, -2, 1), 0.5);
  EXPECT_DOUBLE_EQ(smallest_positive_root(1, -3, 2), 1);
  EXPECT_DOUBLE_EQ(smallest_positive_root(1, 1, -2), 1);
  EXPECT_TRUE(std::isinf(smallest_positive_root(1, 0, 1)));
  EXPECT_NEAR(smallest_positive_root(1e-20, -1, 1e-3), 1e-3, 1e-15);
}

}  // namespace
}  // namespace atlas_refine
