// Vertices at one point share a number, others do not.
#include "input/places.h"

#include <gtest/gtest.h>

namespace atlas_refine {
namespace {

TEST(Places, AreTheSmallestVertexThere) {
  Atlas atlas;
  EXPECT_TRUE(places(atlas).empty());
  atlas.positions = {{1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 0, 1e-300}, {-0.0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(places(atlas), (std::vector<int>{0, 1, 0, 3, 1, 0}));
  atlas.vertex_meshes = {0, 0, 1, 0, 0, 1};
  EXPECT_EQ(places(atlas), (std::vector<int>{0, 1, 2, 3, 1, 2})) << "each mesh has points of its own";
}

}  // namespace
}  // namespace atlas_refine
