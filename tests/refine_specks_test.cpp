// Charts smaller than the gap beside large ones: they keep their shapes, and nothing waits for them.
#include <gtest/gtest.h>

#include "refine_checks.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

/// A disk, which has to bend, and specks, each `scale` times as long as it.
Atlas disk_and_specks(int count, double scale) {
  const auto part = [](std::uint64_t seed, double size, const Vec2& at) {
    return shapes::mesh(shapes::transformed(shapes::random_star_polygon(seed), size, 0, at), 0.15 * size, 0.3);
  };
  std::vector<Atlas> parts = {part(1, 1, {0, 0})};
  for (int k = 0; k < count; ++k) parts.push_back(part(2 + k, scale, {2 + 0.1 * k, 0}));
  return shapes::combine(parts);
}

double largest_stretch(const RefineResult& result, std::size_t first) {
  double out = 1;
  for (std::size_t c = first; c < result.charts.size(); ++c) out = std::max(out, result.charts[c].stretch_max);
  return out;
}

TEST(Specks, KeepTheirShapesAndLetTheBoundBeHeld) {
  struct Case {
    int count;
    double scale;
  };
  for (const auto [count, scale] : {Case{5, 1e-5}, {20, 1e-3}}) {
    for (const double aspect : {0.0, 1.0}) {
      const Atlas atlas = disk_and_specks(count, scale);
      const RefineOptions options{.pe_bound = 0.85, .box_aspect = aspect};
      const RefineResult result = refine(atlas, options);
      testing::expect_sound(atlas, result, options);
      EXPECT_TRUE(result.bound_met);
      EXPECT_EQ(result.gap.value, Gap{}.value);
      const double before = largest_stretch(refine(atlas, {.pe_bound = 0.01, .box_aspect = aspect}), 1);
      EXPECT_LT(largest_stretch(result, 1), 1.2 * before) << count << " specks, aspect " << aspect;
      EXPECT_LT(result.after.distortion, 1.1);
      EXPECT_LT(result.iterations, 200);
    }
  }
}

TEST(Specks, AreMendedWhereTheyAreDistorted) {
  Atlas atlas = disk_and_specks(5, 1e-3);
  const Atlas disk = shapes::mesh(shapes::random_star_polygon(1), 0.15, 0.3);
  for (std::size_t c = disk.corner_uvs.size(); c < atlas.corner_uvs.size(); ++c) atlas.corner_uvs[c].y() *= 4;
  const RefineOptions options{.pe_bound = 0.7};
  const RefineResult result = refine(atlas, options);
  testing::expect_sound(atlas, result, options);
  for (std::size_t c = 1; c < result.charts.size(); ++c)
    EXPECT_LT(result.charts[c].distortion_after, 0.8 * result.charts[c].distortion_before);
}

}  // namespace
}  // namespace atlas_refine
