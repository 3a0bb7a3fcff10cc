// Best rotations against a fine scan over all angles.
#include "pack/turns.h"

#include <gtest/gtest.h>

#include <numbers>

#include "outlines.h"

namespace atlas_refine {
namespace {

double cost(const std::vector<Vec2>& hull, double angle_rad, double aspect) {
  const Vec2 size = turned_box(hull, {std::cos(angle_rad), std::sin(angle_rad)}).size();
  return aspect > 0 ? std::max(size.x(), aspect * size.y()) : size.x() * size.y();
}

TEST(Turns, HullHoldsEveryPoint) {
  for (int seed = 1; seed <= 20; ++seed) {
    const auto outline = testing::outline_of(shapes::random_polygon(seed));
    const auto hull = convex_hull(outline);
    for (std::size_t k = 0; k < hull.size(); ++k) {
      for (const Vec2& p : outline.loops[0]) EXPECT_GE(orientation(hull[k], hull[(k + 1) % hull.size()], p), 0);
    }
  }
}

TEST(Turns, NoAngleOfAFineScanIsBetter) {
  for (int seed = 1; seed <= 20; ++seed) {
    const auto hull = convex_hull(testing::outline_of(shapes::random_polygon(seed)));
    for (const double aspect : {0.0, 1.0, 1.7, 0.4}) {
      const Turn turn = best_turn(hull, aspect);
      const double best = cost(hull, std::atan2(turn.sine, turn.cosine), aspect);
      for (int k = 0; k < 2000; ++k) EXPECT_GE(cost(hull, k * std::numbers::pi / 2000, aspect), best * (1 - 1e-12));
    }
  }
}

TEST(Turns, SmallBoxesComeInOrder) {
  const auto hull = convex_hull(testing::outline_of(shapes::random_polygon(3)));
  double last = 0;
  for (const Turn& turn : small_box_turns(hull, 10)) {
    const double area = turned_box(hull, turn).area();
    EXPECT_GE(area, last);
    last = area;
  }
  EXPECT_GT(last, 0);
}

TEST(Turns, OnlyAFewLongOutlinesLieAslant) {
  const auto turns = [](int count, double length, double width, double aspect, double area) {
    const std::vector<Outline> outlines(count, testing::outline_of(shapes::rectangle(length, width)));
    return turns_aslant(outlines, aspect, area).back();
  };
  EXPECT_TRUE(turns(1, 2, 0.2, 0, 1).empty());
  EXPECT_TRUE(turns(1, 2, 0.2, 1, 4.1).empty());
  EXPECT_TRUE(turns(1, 2, 1.9, 1, 1).empty());
  EXPECT_TRUE(turns(4, 2, 0.2, 1, 1).empty());
  ASSERT_EQ(turns(3, 2, 0.2, 1, 1).size(), 2u);
  const auto hull = convex_hull(testing::outline_of(shapes::rectangle(2, 0.2)));
  for (const Turn& turn : turns(1, 2, 0.2, 1, 1)) EXPECT_NEAR(turned_box(hull, turn).size().maxCoeff(), 2.2 / std::sqrt(2), 1e-9);
}

TEST(Turns, DegenerateOutlinesHaveATurn) {
  for (const Outline& outline : {Outline{{{{1, 1}, {1, 1}, {1, 1}}}}, Outline{{{{0, 0}, {1, 1}, {2, 2}}}}}) {
    const auto hull = convex_hull(outline);
    EXPECT_FALSE(small_box_turns(hull, 3).empty());
    EXPECT_NEAR(turned_box(hull, best_turn(hull, 0)).area(), 0, 1e-12);
  }
}

}  // namespace
}  // namespace atlas_refine
