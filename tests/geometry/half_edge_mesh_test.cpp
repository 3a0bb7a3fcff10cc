// Boundary loops and Euler characteristic, on manifold and on broken meshes.
#include "geometry/half_edge_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace atlas_refine {
namespace {

std::vector<int> from_smallest(std::vector<int> loop) {
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  return loop;
}

TEST(HalfEdgeMesh, TwoTrianglesHaveOneLoopWithTheChartOnTheLeft) {
  const MeshTopology topology = mesh_topology(4, {{0, 1, 2}, {0, 2, 3}});
  ASSERT_EQ(topology.boundary_loops.size(), 1u);
  EXPECT_EQ(from_smallest(topology.boundary_loops[0]), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(topology.euler_characteristic, 1);
}

TEST(HalfEdgeMesh, AnAnnulusHasTwoLoops) {
  std::vector<Triangle> triangles;  // inner ring 0..3, outer ring 4..7
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    triangles.push_back({i, 4 + i, 4 + j});
    triangles.push_back({i, 4 + j, j});
  }
  const MeshTopology topology = mesh_topology(8, triangles);
  ASSERT_EQ(topology.boundary_loops.size(), 2u);
  EXPECT_EQ(topology.euler_characteristic, 0);
  std::vector<std::vector<int>> loops;
  for (const auto& loop : topology.boundary_loops) loops.push_back(from_smallest(loop));
  std::sort(loops.begin(), loops.end());
  EXPECT_EQ(loops[0], (std::vector<int>{0, 3, 2, 1}));  // a hole runs clockwise
  EXPECT_EQ(loops[1], (std::vector<int>{4, 5, 6, 7}));
}

TEST(HalfEdgeMesh, AClosedMeshHasNoLoop) {
  const MeshTopology topology = mesh_topology(4, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}});
  EXPECT_TRUE(topology.boundary_loops.empty());
  EXPECT_EQ(topology.euler_characteristic, 2);
}

TEST(HalfEdgeMesh, NonManifoldFacesBecomePiecesOfTheirOwn) {
  // Three triangles at the edge 0-1, and one that repeats a vertex.
  const MeshTopology topology = mesh_topology(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {2, 2, 3}});
  EXPECT_EQ(topology.boundary_loops.size(), 2u);
  EXPECT_EQ(topology.euler_characteristic, 2);  // two disks
}

TEST(HalfEdgeMesh, FansThatMeetInOneVertexKeepTheirLoops) {
  const MeshTopology topology = mesh_topology(5, {{0, 1, 2}, {0, 3, 4}});
  std::size_t corners = 0;
  for (const auto& loop : topology.boundary_loops) corners += loop.size();
  EXPECT_EQ(corners, 6u);
}

}  // namespace
}  // namespace atlas_refine
