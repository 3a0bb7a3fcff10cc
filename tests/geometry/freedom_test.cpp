// Flags of faces to charts, and areas within a box.
#include "geometry/freedom.h"

#include <gtest/gtest.h>

#include "charts.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

std::vector<Chart> two_squares() { return testing::charts_of(shapes::two_squares(0.5)); }

TEST(Freedom, OneFlaggedFaceIsEnoughAndLockedWins) {
  const std::vector<Chart> charts = two_squares();
  int faces = 0;
  for (const Chart& chart : charts) faces += static_cast<int>(chart.triangles.size());
  std::vector<char> none(faces, 0), second = none, all(faces, 1);
  second[charts[1].triangle_faces.back()] = 1;
  EXPECT_TRUE(freedom_of(charts, {}, {}).empty());
  EXPECT_TRUE(freedom_of(charts, none, none).empty());
  EXPECT_EQ(freedom_of(charts, second, {}), (Freedoms{Freedom::Bends, Freedom::Moves}));
  EXPECT_EQ(freedom_of(charts, all, second), (Freedoms{Freedom::Moves, Freedom::Fixed}));
  EXPECT_TRUE(any_fixed(freedom_of(charts, all, second)));
  EXPECT_FALSE(all_fixed(freedom_of(charts, all, second)));
  EXPECT_TRUE(none_bends(freedom_of(charts, all, second)));
  EXPECT_FALSE(none_bends({}));
}

TEST(Freedom, AreaWithinABox) {
  const Chart chart = two_squares()[0];
  const Box own = uv_box({chart});
  const auto share = [&](const Vec2& from, const Vec2& to) {
    return area_within(chart, {own.min + from.cwiseProduct(own.size()), own.min + to.cwiseProduct(own.size())}) / own.area();
  };
  EXPECT_NEAR(share({-1, -1}, {2, 2}), 1, 1e-12);
  EXPECT_NEAR(share({0.25, -1}, {0.75, 0.3}), 0.15, 1e-12);
  EXPECT_NEAR(share({0, 0}, {1, 1}), 1, 1e-12);
  EXPECT_EQ(share({1.1, 0}, {2, 1}), 0);
}

}  // namespace
}  // namespace atlas_refine
