// Charts along whose borders a narrow bevel runs: its faces neither give way to the pressure of contacts nor stop the steps.
#include <gtest/gtest.h>

#include <cstddef>

#include "refine_checks.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

/// A cross of arms 1 wide and 3 long, of the faces between these lines both ways.
template <std::size_t kLines>
Atlas cross(const double (&at)[kLines], double arm_end) {
  const auto within = [&](std::size_t k) { return at[k] >= 1 && at[k + 1] <= arm_end; };
  std::vector<Vec3> positions;
  std::vector<int> numbers(kLines * kLines, -1);
  const auto vertex = [&](std::size_t i, std::size_t j) {
    int& number = numbers[i * kLines + j];
    if (number < 0) {
      number = static_cast<int>(positions.size());
      positions.push_back({at[i], at[j], 0});
    }
    return number;
  };
  std::vector<std::vector<int>> faces;
  for (std::size_t i = 0; i + 1 < kLines; ++i) {
    for (std::size_t j = 0; j + 1 < kLines; ++j) {
      if (within(i) || within(j)) faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return flat_atlas(positions, faces);
}

/// With rows of faces `width` wide along its border.
Atlas bevelled_cross(double width) {
  const double w = width;
  return cross({0, w, 0.33, 0.66, 1, 1 + w, 1.33, 1.66, 2 - w, 2, 2.33, 2.66, 3 - w, 3}, 2);
}

/// With rows of faces `width` wide between all others, which meet in squares of that size.
Atlas cross_of_bevelled_tiles(double width) {
  const double w = width;
  return cross(
      {0, 0.33, 0.33 + w, 0.66, 0.66 + w, 1, 1 + w, 1.33, 1.33 + w, 1.66, 1.66 + w, 2, 2 + w, 2.33, 2.33 + w, 2.66, 2.66 + w, 3},
      2 + w);
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

TEST(Bevels, FacesManyTimesSmallerThanTheOthersKeepTheirShapesAsThoseDo) {
  for (const double width : {1e-3, 1e-4, 1e-5}) {
    const Atlas atlas = cross_of_bevelled_tiles(width);
    const RefineOptions options{.pe_bound = 0.8, .box_aspect = 1};
    const RefineResult result = refine(atlas, options);
    testing::expect_sound(atlas, result, options);
    EXPECT_TRUE(result.bound_met);
    EXPECT_LT(result.after.stretch_max, 2.4) << width;
    EXPECT_LT(result.after.distortion, 1.045);
  }
}

}  // namespace
}  // namespace atlas_refine
