// Sides of a slit drawn apart.
#include "repair/part_touching.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "charts.h"
#include "cut/cut_atlas.h"
#include "geometry/predicates.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

/// A chart with a slit from the border, whose middle is a nearly straight corner of the quad on its left: vertices 0, 1, 2.
Chart slit() {
  const Atlas atlas = flat_atlas({{0, 0, 0}, {0.01, 1, 0}, {0, 2, 0}, {0, 3, 0}, {-1, 1, 0}, {1, 1, 0}},
                                 {{0, 1, 2, 4}, {2, 3, 4}, {0, 5, 1}, {1, 5, 2}, {2, 5, 3}});
  const std::vector<Chart> charts = testing::charts_of(atlas);
  std::vector<int> path;
  for (const Vec2& at : {Vec2(0, 0), Vec2(0.01, 1), Vec2(0, 2)}) {
    const std::vector<Vec2>& uvs = charts[0].uvs;
    path.push_back(static_cast<int>(std::find(uvs.begin(), uvs.end(), at) - uvs.begin()));
  }
  const std::vector<SurfacePath> paths = {{0, path}};
  return cut_along(whole_atlas(charts), charts, paths).pieces[0].mesh;
}

TEST(PartTouching, ItsSidesAreApart) {
  const Chart chart = slit();
  EXPECT_TRUE(touches_itself(chart));
  const auto parted = part_touching(chart);
  ASSERT_TRUE(parted.has_value());
  EXPECT_FALSE(touches_itself(*parted));
  testing::expect_certified({*parted});
}

// With one that is not positive no squeeze can start.
TEST(PartTouching, NoGuardIsLeftBroken) {
  const Chart chart = slit();
  ASSERT_FALSE(chart.guards.empty());
  const auto parted = part_touching(chart);
  ASSERT_TRUE(parted.has_value());
  for (const Guard& guard : parted->guards) {
    const auto [a, b, c] = guard.triangle;
    EXPECT_GT(orientation(parted->uvs[a], parted->uvs[b], parted->uvs[c]), 0);
  }
}

}  // namespace
}  // namespace atlas_refine
