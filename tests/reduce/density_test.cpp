// Relative scales of charts: one density for all, or each its own.
#include "reduce/density.h"

#include <gtest/gtest.h>

#include "charts.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

std::vector<Chart> of_two_scales() {
  const shapes::Polygon star = shapes::star();
  Atlas large = shapes::mesh(star, 0.1);
  for (Vec2& uv : large.corner_uvs) uv = 3 * uv + Vec2(4, 0);
  return testing::charts_of(shapes::combine({shapes::mesh(star, 0.1), large}));
}

TEST(Density, EqualScalesTheUvs) {
  std::vector<Chart> charts = of_two_scales();
  EXPECT_TRUE(set_density(charts, Density::Equal));
  EXPECT_NEAR(uv_area(charts[0]), uv_area(charts[1]), 1e-9);
  for (const Chart& chart : charts) EXPECT_NEAR(dirichlet_sums(chart).best_scale(), 1, 1e-12);
  EXPECT_FALSE(set_density(charts, Density::Equal));
}

TEST(Density, KeepScalesTheSurfaceInstead) {
  const std::vector<Chart> before = of_two_scales();
  std::vector<Chart> charts = before;
  EXPECT_FALSE(set_density(charts, Density::Keep));
  for (std::size_t c = 0; c < charts.size(); ++c) {
    EXPECT_TRUE(testing::same_bits(charts[c].uvs, before[c].uvs));
    EXPECT_NEAR(dirichlet_sums(charts[c]).best_scale(), 1, 1e-12);
    EXPECT_NEAR(dirichlet_sums(charts[c]).best_energy(), dirichlet_sums(before[c]).best_energy(), 1e-12);
  }
}

}  // namespace
}  // namespace atlas_refine
