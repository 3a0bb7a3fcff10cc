// Flips that unfold, and those that cannot.
#include "repair/untangle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/predicates.h"
#include "geometry/rest_triangle.h"

namespace atlas_refine {
namespace {

constexpr int kSides = 8;

/// A regular polygon's fan, its corners fixed in their order or against it; the middle, which is free, lies outside.
Tangle fan(bool mirrored, std::vector<Vec2>& uvs) {
  const RestTriangle rest = rest_from_plane(Vec2(0, 0), Vec2(1, 0), Vec2(0.7, 0.7), 1);
  Tangle out;
  for (int k = 0; k < kSides; ++k) {
    const double angle = (mirrored ? -2 : 2) * std::numbers::pi * k / kSides;
    uvs.emplace_back(std::cos(angle), std::sin(angle));
    out.triangles.push_back({kSides, k, (k + 1) % kSides});
    out.inverse_edges.push_back(rest.inverse_edges);
    out.weights.push_back(rest.area);
  }
  uvs.emplace_back(2, 0.3);
  out.fixed.assign(kSides, 1);
  out.fixed.push_back(0);
  return out;
}

TEST(Untangle, TurnsFlippedTrianglesBack) {
  std::vector<Vec2> uvs;
  const Tangle tangle = fan(false, uvs);
  Monitor monitor;
  const auto out = untangle(tangle, uvs, 1, monitor);
  ASSERT_TRUE(out);
  EXPECT_LT((*out)[kSides].norm(), 1e-3);
  for (const Triangle& t : tangle.triangles) EXPECT_GT(orientation((*out)[t[0]], (*out)[t[1]], (*out)[t[2]]), 0);
}

TEST(Untangle, FindsNothingWhereTheFixedVerticesAreMirrored) {
  std::vector<Vec2> uvs;
  const Tangle tangle = fan(true, uvs);
  Monitor monitor;
  EXPECT_FALSE(untangle(tangle, uvs, 1, monitor));
}

}  // namespace
}  // namespace atlas_refine
