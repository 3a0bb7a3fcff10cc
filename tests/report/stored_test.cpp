// Slits as narrow as rounding close where they are stored, and such charts are told.
#include "report/stored.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "atlas_refine/refine.h"
#include "charts.h"
#include "shapes.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

/// A square with a slit from the right side to the middle, of this width.
Atlas slit_atlas(double width) {
  const double low = 0.5 - width / 2, high = 0.5 + width / 2;
  return flat_atlas({{0, 0, 0}, {1, 0, 0}, {1, low, 0}, {0.5, 0.5, 0}, {1, high, 0}, {1, 1, 0}, {0, 1, 0}},
                    {{0, 1, 3}, {1, 2, 3}, {3, 4, 5}, {3, 5, 6}, {0, 3, 6}});
}

Chart slit_square(double width) { return testing::charts_of(slit_atlas(width)).at(0); }

/// No two vertices are one point in space.
std::vector<int> own_points(const Chart& chart) {
  std::vector<int> out(chart.vertex_count());
  std::iota(out.begin(), out.end(), 0);
  return out;
}

std::vector<Vec2> one_further(const Chart& chart) {
  std::vector<Vec2> out;
  for (const Vec2& uv : chart.uvs) out.emplace_back(uv + Vec2(1, 1));
  return out;
}

TEST(Stored, ASlitThatRoundingClosesIsTold) {
  const Chart narrow = slit_square(1.2e-16);
  ASSERT_TRUE(certify_charts({narrow}).valid());
  const std::vector<int> points = own_points(narrow);
  EXPECT_FALSE(broken_as_stored(narrow, points, narrow.uvs, 0));
  const auto broken = broken_as_stored(narrow, points, one_further(narrow), 0);
  ASSERT_TRUE(broken);
  EXPECT_FALSE(certify_charts({*broken}).valid());
  EXPECT_NEAR(uv_area(*broken), uv_area(narrow), 1e-12);
}

TEST(Stored, AWideSlitStaysAndAtHalfTheWidthOfTheTextureTheChartIsStretchedBack) {
  const Chart wide = slit_square(1e-3);
  const std::vector<int> points = own_points(wide);
  EXPECT_FALSE(broken_as_stored(wide, points, one_further(wide), 0));
  const Chart narrow = slit_square(1.2e-16);
  std::vector<Vec2> halved = one_further(narrow);
  for (Vec2& uv : halved) uv.x() *= 0.5;
  const auto broken = broken_as_stored(narrow, points, halved, 2);
  ASSERT_TRUE(broken);
  EXPECT_NEAR(uv_box({*broken}).size().x(), 1, 1e-12);
  EXPECT_NEAR(uv_box({*broken}).size().y(), 1, 1e-12);
}

TEST(Stored, SlitsThatSinglePrecisionWouldCloseAreDrawnApart) {
  int parted = 0;
  for (const double width : {1.2e-7, 2e-7, 3e-7}) {
    std::vector<Atlas> squares = {slit_atlas(width)};
    for (const double side : {1.9, 1.8, 1.7, 1.6}) {
      squares.push_back(slit_atlas(0.5));
      for (Vec2& uv : squares.back().corner_uvs) uv *= side;
      for (Vec3& position : squares.back().positions) position *= side;
    }
    const RefineOptions options{.pe_bound = 0.5, .stored = Stored::Float32};
    const RefineResult result = refine(shapes::combine(squares), options);
    EXPECT_EQ(result.intervention, Intervention::Moved);
    parted += static_cast<int>(result.repairs.size());
  }
  EXPECT_GT(parted, 0);
}

}  // namespace
}  // namespace atlas_refine
