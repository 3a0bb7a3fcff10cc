// What cuts are compared with: the distortion that the charts would have without them.
#include "whole.h"

#include <gtest/gtest.h>

#include "atlas_refine/refine.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

std::optional<double> without_cuts(const Atlas& atlas, double pe_bound, double most) {
  const RefineOptions options{.pe_bound = pe_bound};
  const InputAtlas input = read_atlas(atlas, options);
  Monitor monitor;
  Journal journal(monitor, nullptr, options.box_aspect);
  return distortion_without_cuts({input, options, monitor, journal, 1, options}, most);
}

TEST(WithoutCuts, IsWhatTheSqueezeComesTo) {
  for (const double bound : {0.7, 0.85}) {
    const Atlas atlas = shapes::mesh(shapes::s_shape(), 0.08);
    const double squeezed = refine(atlas, {.pe_bound = bound}).after.distortion;
    const auto told = without_cuts(atlas, bound, 2);
    ASSERT_TRUE(told);
    EXPECT_NEAR(*told, squeezed, 0.1 * (squeezed - 1));
    // Asked for clearly less than there is: nothing.
    EXPECT_FALSE(without_cuts(atlas, bound, 1 + 0.7 * (squeezed - 1)));
    EXPECT_TRUE(without_cuts(atlas, bound, 1 + 1.3 * (squeezed - 1)));
  }
}

TEST(WithoutCuts, ChartsThatOverlapThemselvesAreComparedAsTheyAreMended) {
  const Atlas atlas = shapes::self_overlapping();
  const double squeezed = refine(atlas, {.pe_bound = 0.7}).after.distortion;
  const auto told = without_cuts(atlas, 0.7, 100);
  ASSERT_TRUE(told);
  EXPECT_NEAR(*told, squeezed, 0.1 * (squeezed - 1));
}

}  // namespace
}  // namespace atlas_refine
