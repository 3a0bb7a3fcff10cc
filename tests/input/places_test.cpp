// Vertices at one point share a number, others do not.
#include "input/places.h"

#include <gtest/gtest.h>

namespace atlas_refine {
namespace {

TEST(Places, AreTheSmallestVertexThere) {
  const std::vector<Vec3> positions{{1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 0, 1e-300}, {-0.0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(places(positions), (std::vector<int>{0, 1, 0, 3, 1, 0}));
  EXPECT_TRUE(places({}).empty());
}

}  // namespace
}  // namespace atlas_refine
