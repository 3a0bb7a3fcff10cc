// The shapes of a chart's triangles: copies of a chart have the same ones, not their own.
#include "geometry/surface.h"

#include <gtest/gtest.h>

#include <optional>

#include "geometry/rest_triangle.h"

namespace atlas_refine {
namespace {

TEST(Surface, CopiesShareTheirShapesAndOutliveTheFirst) {
  std::optional<Surface> first(Surface({rest_from_plane({0, 0}, {1, 0}, {0, 1}, 1), rest_from_plane({0, 0}, {2, 0}, {0, 1}, 1)}));
  const Surface copy = *first;
  EXPECT_EQ(&copy[0], &(*first)[0]);
  const Surface moved = std::move(*first);
  EXPECT_EQ(first->size(), 0U);  // NOLINT(bugprone-use-after-move): that is what is asked
  first.reset();
  EXPECT_EQ(copy.size(), 2U);
  EXPECT_DOUBLE_EQ(copy.area(), 1.5);
  EXPECT_EQ(&moved[1], &copy[1]);
}

TEST(Surface, OneOfNothingIsEmpty) {
  const Surface none;
  EXPECT_EQ(none.size(), 0U);
  EXPECT_EQ(none.area(), 0);
  EXPECT_EQ(none.begin(), none.end());
}

}  // namespace
}  // namespace atlas_refine
