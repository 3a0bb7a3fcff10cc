// Packings of rectangles: apart by the padding, inside the box, annealing never worse.
#include "layout/pack_rectangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace atlas_refine {
namespace {

constexpr double kRounding = 1e-9;

std::vector<Vec2> random_sizes(int count, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Vec2> sizes;
  for (int k = 0; k < count; ++k) sizes.push_back({rng.uniform(0.05, 1), rng.uniform(0.05, 1)});
  return sizes;
}

Vec2 placed_size(const Vec2& size, bool turned) { return turned ? Vec2(size.y(), size.x()) : size; }

void expect_good(const std::vector<Vec2>& sizes, const RectanglePacking& packing, double padding, double aspect) {
  ASSERT_EQ(packing.positions.size(), sizes.size());
  ASSERT_EQ(packing.turned.size(), sizes.size());
  if (aspect > 0) {
    EXPECT_NEAR(packing.box.x() / packing.box.y(), aspect, 1e-9 * aspect);
  }
  for (std::size_t a = 0; a < sizes.size(); ++a) {
    const Vec2 low = packing.positions[a], high = low + placed_size(sizes[a], packing.turned[a]);
    EXPECT_GE(low.minCoeff(), -kRounding);
    EXPECT_LE((high - packing.box).maxCoeff(), kRounding);
    for (std::size_t b = a + 1; b < sizes.size(); ++b) {
      const Vec2 other = packing.positions[b], end = other + placed_size(sizes[b], packing.turned[b]);
      const double apart = std::max((other - high).maxCoeff(), (low - end).maxCoeff());
      ASSERT_GE(apart, padding - kRounding) << a << " and " << b;
    }
  }
}

TEST(PackRectangles, RandomOnesAreApartAndInside) {
  for (const int count : {1, 2, 3, 7, 20, 80}) {
    for (const double aspect : {0.0, 1.0, 0.4, 3.0}) {
      for (const double padding : {0.0, 0.02}) {
        SCOPED_TRACE(testing::Message() << count << " rectangles, aspect " << aspect << ", padding " << padding);
        const std::vector<Vec2> sizes = random_sizes(count, count);
        const RectanglePacking packing = pack_rectangles(sizes, padding, aspect);
        expect_good(sizes, packing, padding, aspect);
        Rng rng(7);
        const RectanglePacking annealed = anneal_packing(sizes, padding, aspect, packing, count > 20 ? 200 : 2000, rng);
        expect_good(sizes, annealed, padding, aspect);
        EXPECT_LE(annealed.box.prod(), packing.box.prod());
      }
    }
  }
}

TEST(PackRectangles, OneFillsItsBox) {
  const RectanglePacking packing = pack_rectangles({{3, 2}}, 0.5, 0);
  EXPECT_NEAR(packing.box.prod(), 6, 1e-12);
  EXPECT_NEAR(pack_rectangles({{3, 2}}, 0.5, 1).box.prod(), 9, 1e-12);
}

TEST(PackRectangles, EqualSquaresTile) {
  const RectanglePacking packing = pack_rectangles(std::vector<Vec2>(16, {1, 1}), 0, 1);
  EXPECT_NEAR(packing.box.prod(), 16, 1e-9);
}

TEST(PackRectangles, ManyPackDensely) {
  for (int seed = 0; seed < 5; ++seed) {
    const std::vector<Vec2> sizes = random_sizes(60, seed);
    double area = 0;
    for (const Vec2& s : sizes) area += s.prod();
    EXPECT_GT(area / pack_rectangles(sizes, 0, 0).box.prod(), 0.85);
  }
}

TEST(PackRectangles, NeedlesAndLargeOnes) {
  std::vector<Vec2> sizes = {{5, 5}};
  for (int k = 0; k < 12; ++k) sizes.push_back({0.01, 4.0 + 0.1 * k});
  expect_good(sizes, pack_rectangles(sizes, 0.01, 0), 0.01, 0);
  expect_good(sizes, pack_rectangles(sizes, 0.01, 1), 0.01, 1);
}

TEST(AnnealPacking, MendsABadStart) {
  // Nine squares in a row, in a square box.
  const std::vector<Vec2> sizes(9, {1, 1});
  RectanglePacking row{{}, std::vector<char>(9, 0), {9, 9}};
  for (int k = 0; k < 9; ++k) row.positions.push_back({static_cast<double>(k), 0});
  Rng rng(1);
  const RectanglePacking annealed = anneal_packing(sizes, 0, 1, row, 20000, rng);
  expect_good(sizes, annealed, 0, 1);
  EXPECT_LE(annealed.box.prod(), 16 + 1e-9);
}

TEST(AnnealPacking, SameSeedSameBits) {
  const std::vector<Vec2> sizes = random_sizes(15, 4);
  const RectanglePacking start = pack_rectangles(sizes, 0.01, 0);
  Rng one(9), two(9);
  const RectanglePacking a = anneal_packing(sizes, 0.01, 0, start, 3000, one);
  const RectanglePacking b = anneal_packing(sizes, 0.01, 0, start, 3000, two);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.turned, b.turned);
}

}  // namespace
}  // namespace atlas_refine
