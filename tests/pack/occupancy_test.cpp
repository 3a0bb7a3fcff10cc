// Bottom-left places against trying every cell.
#include "pack/occupancy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "outlines.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

struct Placed {
  Raster raster;
  Cell place;
};

bool is_free(const std::vector<Placed>& all, const Raster& raster, const Cell& place) {
  for (const Placed& other : all) {
    if (shared_cells(raster, place, other.raster, other.place) > 0) return false;
  }
  return true;
}

/// With and without the index of free squares.
class OccupancyOf : public ::testing::TestWithParam<bool> {};

TEST_P(OccupancyOf, FindsTheLowestThenLeftmostPlace) {
  constexpr int kWidth = 150;
  Occupancy strip(kWidth, GetParam());
  std::vector<Placed> all;
  for (int k = 0; k < 40; ++k) {
    Rng rng(4, k);
    const auto polygon = k % 3 == 0 ? shapes::ring() : shapes::random_polygon(k + 1);
    const Raster raster = rasterise(
        testing::outline_of(shapes::transformed(polygon, rng.uniform(0.2, 1), rng.uniform(0, 6), {0, 0})), {}, 0, 0.013);
    Cell found, expected;
    ASSERT_TRUE(strip.find_lowest(raster, 100000, found));
    for (bool done = false; !done; ++expected.y) {
      for (expected.x = 0; expected.x + raster.width <= kWidth && !done; ++expected.x) done = is_free(all, raster, expected);
      if (done) break;
    }
    --expected.x;
    EXPECT_EQ(found.x, expected.x);
    EXPECT_EQ(found.y, expected.y);
    EXPECT_EQ(strip.find_lowest(raster, found.y - 1, expected), false);
    Cell above;
    ASSERT_TRUE(strip.find_lowest(raster, 100000, above, found.y + 1));
    EXPECT_GT(above.y, found.y);
    EXPECT_TRUE(is_free(all, raster, above));
    strip.add(raster, found);
    all.push_back({raster, found});
  }
}

INSTANTIATE_TEST_SUITE_P(FewAndMany, OccupancyOf, ::testing::Bool());

TEST(Occupancy, TheIndexOfFreeSquaresChangesNoPlace) {
  constexpr int kWidth = 70 * 64 + 5;  // marks of full words take two words
  Occupancy one(kWidth), other(kWidth, true);
  for (int k = 0; k < 400; ++k) {
    Rng rng(6, k);
    const double size = 0.2 + 3 * std::exp(-0.01 * k);
    const auto polygon = k % 5 == 0 ? shapes::ring() : shapes::rectangle(rng.uniform(0.1, 3), 0.4);
    const Raster raster =
        rasterise(testing::outline_of(shapes::transformed(polygon, size, rng.uniform(0, 6), {0, 0})), {}, 0, 0.01);
    Cell expected, found;
    ASSERT_TRUE(one.find_lowest(raster, 100000, expected));
    ASSERT_TRUE(other.find_lowest(raster, 100000, found));
    ASSERT_EQ(found, expected);
    one.add(raster, found);
    other.add(raster, found);
  }
}

TEST(Occupancy, TooWideHasNoPlace) {
  Occupancy strip(20);
  Cell place;
  EXPECT_FALSE(strip.find_lowest(rasterise(testing::outline_of(shapes::rectangle(2, 1)), {}, 0, 0.05), 100, place));
}

}  // namespace
}  // namespace atlas_refine
