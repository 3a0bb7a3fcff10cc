// Bottom-left places against trying every cell.
#include "pack/occupancy.h"

#include <gtest/gtest.h>

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

TEST(Occupancy, FindsTheLowestThenLeftmostPlace) {
  constexpr int kWidth = 150;
  Occupancy strip(kWidth);
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

TEST(Occupancy, TooWideHasNoPlace) {
  Occupancy strip(20);
  Cell place;
  EXPECT_FALSE(strip.find_lowest(rasterise(testing::outline_of(shapes::rectangle(2, 1)), {}, 0, 0.05), 100, place));
}

}  // namespace
}  // namespace atlas_refine
