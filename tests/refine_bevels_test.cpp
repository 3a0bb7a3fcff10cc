// Charts along whose borders a narrow bevel runs: its faces neither give way to the pressure of contacts nor stop the steps.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "refine_checks.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

/// A cross of arms 1 wide and 3 long, of the faces between these lines both ways.
Atlas cross(const std::vector<double>& at, double arm_end) {
  const std::size_t lines = at.size();
  const auto within = [&](std::size_t k) { return at[k] >= 1 && at[k + 1] <= arm_end; };
  std::vector<Vec3> positions;
  std::vector<int> numbers(lines * lines, -1);
  const auto vertex = [&](std::size_t i, std::size_t j) {
    int& number = numbers[i * lines + j];
    if (number < 0) {
      number = static_cast<int>(positions.size());
      positions.push_back({at[i], at[j], 0});
    }
    return number;
  };
  std::vector<std::vector<int>> faces;
  for (std::size_t i = 0; i + 1 < lines; ++i) {
    for (std::size_t j = 0; j + 1 < lines; ++j) {
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

/// A sheet of faces 1 wide with `rows` rows of faces `width` wide between them, away from the origin.
Atlas sheet_of_round_edges(int tiles, int rows, double width, double origin) {
  std::vector<double> at;
  for (int k = 0; k < tiles * (rows + 1); ++k) at.push_back(origin + k / (rows + 1) + width * (k % (rows + 1)));
  return cross(at, INFINITY);
}

TEST(Bevels, FacesThatLoseTheirWidthInTheDigitsOfAFileGetItBack) {
  struct Case {
    int tiles, rows;
    double width, origin;
  };
  constexpr double kDigits = 1e-6;
  for (const Case& c : {Case{4, 4, 6e-7, 1}, Case{4, 3, 1e-7, 1 + 2.5e-7}, Case{3, 3, 1e-7, 1 + 2.5e-7}}) {
    Atlas atlas = sheet_of_round_edges(c.tiles, c.rows, c.width, c.origin);
    for (Vec2& uv : atlas.corner_uvs) uv = (uv / kDigits).array().round() * kDigits;
    const RefineResult result = refine(atlas, {.pe_bound = 0.9, .box_aspect = 1});
    EXPECT_TRUE(result.bound_met);
    EXPECT_LT(result.after.distortion, 1.001) << c.width;
  }
}

}  // namespace
}  // namespace atlas_refine
