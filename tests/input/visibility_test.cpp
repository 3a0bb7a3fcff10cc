// What is seen of a surface from around it.
#include "input/visibility.h"

#include <gtest/gtest.h>

#include "closed_shapes.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

constexpr int kCells = 12;

/// A unit square that looks up and a lid over its half x < 0.5, which looks up too; `mesh_of_lid`: 0, or a mesh of its own.
Atlas square_with_lid(int mesh_of_lid) {
  std::vector<Vec3> positions;
  std::vector<std::vector<int>> faces;
  for (int i = 0; i <= kCells; ++i) {
    for (int j = 0; j <= kCells; ++j) positions.emplace_back(i / double{kCells}, j / double{kCells}, 0);
  }
  const auto at = [](int i, int j) { return i * (kCells + 1) + j; };
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  }
  const int lid = static_cast<int>(positions.size());
  for (const Vec2& p : {Vec2(-0.2, -0.2), Vec2(0.5, -0.2), Vec2(0.5, 1.2), Vec2(-0.2, 1.2)})
    positions.emplace_back(p.x(), p.y(), 0.15);
  faces.push_back({lid, lid + 1, lid + 2, lid + 3});
  Atlas atlas = flat_atlas(positions, faces);
  atlas.vertex_meshes.assign(lid, 0);
  atlas.vertex_meshes.resize(positions.size(), mesh_of_lid);
  return atlas;
}

int vertex(int i, int j) { return i * (kCells + 1) + j; }

TEST(Visibility, ALidHidesWhatLiesUnderIt) {
  const Atlas atlas = square_with_lid(0);
  const std::vector<double> seen = visibility(atlas, 1);
  EXPECT_LT(seen[vertex(1, kCells / 2)], 0.1);
  EXPECT_GT(seen[vertex(kCells, kCells / 2)], 0.9);
  EXPECT_LT(seen[vertex(1, kCells / 2)], seen[vertex(kCells / 2, kCells / 2)]);
  EXPECT_LT(seen[vertex(kCells / 2, kCells / 2)], seen[vertex(kCells, kCells / 2)]);
  EXPECT_EQ(seen.back(), 1);
}

TEST(Visibility, MeshesAreSeenEachByItself) {
  for (const double seen : visibility(square_with_lid(1), 1)) EXPECT_EQ(seen, 1);
}

TEST(Visibility, NothingHidesAConvexBody) {
  for (const double seen : visibility(shapes::cube_sphere(10), 1)) EXPECT_EQ(seen, 1);
}

TEST(Visibility, SameBitsOnAllThreads) { EXPECT_EQ(visibility(square_with_lid(0), 1), visibility(square_with_lid(0), 3)); }

TEST(Visibility, FacesWithoutSizeAndVerticesWithoutFacesAreSeen) {
  const Atlas atlas = flat_atlas({{1, 1, 0}, {1, 1, 0}, {1, 1, 0}, {5, 5, 5}}, {{0, 1, 2}});
  EXPECT_EQ(visibility(atlas, 1), std::vector<double>(4, 1));
}

}  // namespace
}  // namespace atlas_refine
