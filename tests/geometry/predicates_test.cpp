// Exact predicates where rounding would decide otherwise.
#include "geometry/predicates.h"

#include <gtest/gtest.h>

#include <cmath>

namespace atlas_refine {
namespace {

TEST(Predicates, OrientationSigns) {
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {0, 1}), 1);
  EXPECT_EQ(orientation({0, 0}, {0, 1}, {1, 0}), -1);
  EXPECT_EQ(orientation({0, 0}, {1, 1}, {3, 3}), 0);
}

TEST(Predicates, OrientationIsExactNextToALine) {
  // The point is one unit in the last place off the diagonal; the rounded determinant is zero there.
  const Vec2 a(12, 12), b(24, 24);
  const double x = 0.5;
  const double above = std::nextafter(x, 1), below = std::nextafter(x, 0);
  EXPECT_EQ(orientation(a, b, {x, x}), 0);
  EXPECT_EQ(orientation(a, b, {x, above}), 1);
  EXPECT_EQ(orientation(a, b, {x, below}), -1);
}

TEST(Predicates, OrientationOfTinyTriangles) {
  EXPECT_EQ(orientation({0, 0}, {1e-170, 0}, {0, 1e-170}), 1);  // the area underflows
  EXPECT_EQ(orientation({0, 0}, {0, 1e-170}, {1e-170, 0}), -1);
}

TEST(Predicates, SegmentsThatCrossOrTouch) {
  EXPECT_TRUE(segments_touch({0, 0}, {2, 2}, {0, 2}, {2, 0}));
  EXPECT_TRUE(segments_touch({0, 0}, {2, 0}, {1, 0}, {1, 5}));  // end on the inside
  EXPECT_TRUE(segments_touch({0, 0}, {1, 0}, {1, 0}, {2, 3}));  // common end
  EXPECT_TRUE(segments_touch({0, 0}, {2, 0}, {1, 0}, {3, 0}));  // collinear overlap
  EXPECT_TRUE(segments_touch({0, 0}, {4, 4}, {1, 1}, {1, 1}));  // a point on the segment
  EXPECT_TRUE(segments_touch({1, 1}, {1, 1}, {1, 1}, {1, 1}));
}

TEST(Predicates, SegmentsApart) {
  EXPECT_FALSE(segments_touch({0, 0}, {2, 0}, {0, 1}, {2, 1}));
  EXPECT_FALSE(segments_touch({0, 0}, {1, 0}, {2, 0}, {3, 0}));                     // collinear
  EXPECT_FALSE(segments_touch({0, 0}, {1, 1}, {1, 0}, {0.75, 0.5}));                // boxes overlap
  EXPECT_FALSE(segments_touch({0, 0}, {4, 4}, {1, std::nextafter(1, 2)}, {1, 3}));  // by one unit in the last place
  EXPECT_FALSE(segments_touch({0, 0}, {4, 4}, {1, 2}, {1, 2}));
}

}  // namespace
}  // namespace atlas_refine
