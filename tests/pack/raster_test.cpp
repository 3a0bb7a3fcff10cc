// Bitmaps against brute force: no cell within the radius is missing, hardly any beyond it is set.
#include "pack/raster.h"

#include <gtest/gtest.h>

#include <numbers>

#include "outlines.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

bool is_set(const Raster& raster, int x, int y) { return raster.row(y)[x >> 6] >> (x & 63) & 1; }

double distance_to(const Outline& outline, const Vec2& p) {
  if (testing::contains(outline, p)) return 0;
  double nearest = INFINITY;
  testing::for_edges(outline, [&](const Vec2& a, const Vec2& b) { nearest = std::min(nearest, testing::distance(p, a, b)); });
  return nearest;
}

void check(const shapes::Polygon& polygon, double angle_rad, double radius, double cell) {
  const Outline outline = testing::outline_of(polygon);
  const Turn turn{std::cos(angle_rad), std::sin(angle_rad)};
  const Raster raster = rasterise(outline, turn, radius, cell);
  const Outline turned = testing::placed(outline, {turn.cosine, turn.sine, -raster.origin});
  int count = 0;
  for (int y = -2; y < raster.height + 2; ++y) {
    for (int x = -2; x < raster.width + 2; ++x) {
      const bool within = x >= 0 && y >= 0 && x < raster.width && y < raster.height;
      const bool set = within && is_set(raster, x, y);
      count += set;
      const double to_centre = distance_to(turned, Vec2(x + 0.5, y + 0.5) * cell);
      EXPECT_TRUE(set || to_centre >= radius + 0.49 * cell) << x << " " << y;
      EXPECT_FALSE(set && to_centre > radius + 0.7072 * cell) << x << " " << y;
    }
  }
  EXPECT_EQ(raster.cells, count);
  int in_runs = 0;
  for (const Run& run : raster.runs) in_runs += run.end - run.begin;
  EXPECT_EQ(in_runs, count);
}

TEST(Raster, CoversWhatIsWithinTheRadius) {
  for (const auto& shape : shapes::named_polygons()) {
    for (const double angle_rad : {0.0, 0.4}) {
      check(shape.polygon, angle_rad, 0.0, 0.03);
      check(shape.polygon, angle_rad, 0.02, 0.03);
      check(shape.polygon, angle_rad, 0.1, 0.03);
    }
  }
  for (int seed = 1; seed <= 5; ++seed) check(shapes::random_polygon(seed), seed, 0.03, 0.02);
}

TEST(Raster, SharedCellsAgainstCounting) {
  const Raster a = rasterise(testing::outline_of(shapes::star()), {}, 0, 0.007);
  const Raster b = rasterise(testing::outline_of(shapes::spiral()), {}, 0, 0.005);
  for (int k = 0; k < 200; ++k) {
    Rng rng(1, k);
    const Cell p{rng.below(300) - 150, rng.below(300) - 150}, q{rng.below(300) - 150, rng.below(300) - 150};
    int expected = 0;
    for (int y = 0; y < a.height; ++y) {
      for (int x = 0; x < a.width; ++x) {
        const int bx = x + p.x - q.x, by = y + p.y - q.y;
        expected += bx >= 0 && by >= 0 && bx < b.width && by < b.height && is_set(a, x, y) && is_set(b, bx, by);
      }
    }
    EXPECT_EQ(shared_cells(a, p, b, q), expected);
    EXPECT_EQ(shared_cells(b, q, a, p), expected);
  }
}

}  // namespace
}  // namespace atlas_refine
