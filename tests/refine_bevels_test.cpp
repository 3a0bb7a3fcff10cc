// Charts along whose borders a narrow bevel runs: its faces neither give way to the pressure of contacts nor stop the steps.
#include <gtest/gtest.h>

#include <iterator>

#include "refine_checks.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

/// A cross of arms 1 wide and 3 long with rows of faces `width` wide along its border.
Atlas bevelled_cross(double width) {
  const double at[] = {0, width, 0.33, 0.66, 1, 1 + width, 1.33, 1.66, 2 - width, 2, 2.33, 2.66, 3 - width, 3};
  constexpr int kLines = std::size(at);
  const auto within = [&](int k) { return at[k] >= 1 && at[k + 1] <= 2; };
  std::vector<Vec3> positions;
  std::vector<int> numbers(kLines * kLines, -1);
  const auto vertex = [&](int i, int j) {
    int& number = numbers[i * kLines + j];
    if (number < 0) {
      number = static_cast<int>(positions.size());
      positions.push_back({at[i], at[j], 0});
    }
    return number;
  };
  std::vector<std::vector<int>> faces;
  for (int i = 0; i + 1 < kLines; ++i) {
    for (int j = 0; j + 1 < kLines; ++j) {
      if (within(i) || within(j)) faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return flat_atlas(positions, faces);
}

TEST(Bevels, NarrowFacesAreNotCrushedByContacts) {
  for (const double width : {1e-3, 1e-4, 1e-5}) {
    for (const double aspect : {0.0, 1.0}) {
      const Atlas atlas = bevelled_cross(width);
      const RefineOptions options{.pe_bound = 0.8, .box_aspect = aspect};
      const RefineResult result = refine(atlas, options);
      testing::expect_sound(atlas, result, options);
      EXPECT_TRUE(result.bound_met);
      EXPECT_LT(result.after.stretch_max, 8) << width << ", aspect " << aspect;
      EXPECT_LT(result.after.distortion, 1.04);
    }
  }
}

}  // namespace
}  // namespace atlas_refine
