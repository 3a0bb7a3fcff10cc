// 200 random polygons: star-shaped ones and any simple ones, alone and several together, reach the bound.
#include <gtest/gtest.h>

#include "refine_checks.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

constexpr int kPerBatch = 20;

class RandomPolygons : public ::testing::TestWithParam<int> {};

TEST_P(RandomPolygons, ReachTheBound) {
  for (int k = 0; k < kPerBatch; ++k) {
    const int seed = GetParam() * kPerBatch + k;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const shapes::Polygon polygon = seed % 2 == 0 ? shapes::random_polygon(seed) : shapes::random_star_polygon(seed);
    const double bound = seed % 10 < 7 ? 0.8 : 0.9;
    const double aspect = seed % 10 == 5 ? 1 : 0;
    testing::refine_soundly(shapes::mesh(polygon, 0.09), {.pe_bound = bound, .box_aspect = aspect});
  }
}

INSTANTIATE_TEST_SUITE_P(TwoHundred, RandomPolygons, ::testing::Range(0, 10));

TEST(RandomAtlases, ReachTheBound) {
  for (int seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::vector<Atlas> charts;
    for (int k = 0; k < 3; ++k) {
      const shapes::Polygon polygon =
          k % 2 == 0 ? shapes::random_polygon(100 * seed + k) : shapes::random_star_polygon(100 * seed + k);
      charts.push_back(shapes::mesh(shapes::transformed(polygon, 0.5 + 0.2 * k, k, {3.0 * k, 0}), 0.15));
    }
    testing::refine_soundly(shapes::combine(charts),
                            {.pe_bound = 0.85, .density = seed % 2 == 0 ? Density::Equal : Density::Keep});
  }
}

}  // namespace
}  // namespace atlas_refine
