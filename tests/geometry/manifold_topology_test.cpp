// Topology without a mesh: what OpenMesh says, and nothing where it would have to decide.
#include "geometry/manifold_topology.h"

#include <gtest/gtest.h>

#include "cut_checks.h"

namespace atlas_refine {
namespace {

/// A triangle that repeats a vertex, which is left out, makes it OpenMesh's.
MeshTopology by_open_mesh(const Chart& chart) {
  std::vector<Triangle> triangles = chart.triangles;
  triangles.push_back({0, 0, 1});
  return mesh_topology(chart.vertex_count(), triangles);
}

TEST(ManifoldTopology, SaysOfChartsWhatOpenMeshDoes) {
  for (const shapes::Named& shape : testing::many_polygons()) {
    SCOPED_TRACE(shape.name);
    const Chart chart = testing::chart_of(shape.polygon, 0.15);
    const auto topology = manifold_topology(chart.vertex_count(), chart.triangles);
    ASSERT_TRUE(topology);
    const MeshTopology expected = by_open_mesh(chart);
    EXPECT_EQ(topology->boundary_loops, expected.boundary_loops);
    EXPECT_EQ(topology->euler_characteristic, expected.euler_characteristic);
  }
}

TEST(ManifoldTopology, AVertexWithoutATriangleDoesNotCount) {
  const auto topology = manifold_topology(6, {{1, 2, 3}, {1, 3, 4}});
  ASSERT_TRUE(topology);
  EXPECT_EQ(topology->euler_characteristic, 1);
}

TEST(ManifoldTopology, SaysNothingOfWhatIsNoManifold) {
  const std::vector<std::vector<Triangle>> meshes = {
      {{0, 1, 2}, {2, 2, 3}},                        // a repeated vertex
      {{0, 1, 2}, {0, 1, 3}},                        // oriented apart
      {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}},             // three triangles at one edge
      {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 0, 5}},  // four
      {{0, 1, 2}, {0, 3, 4}},                        // fans that meet in one vertex
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 4, 5}},  // one of them closed
  };
  for (const std::vector<Triangle>& triangles : meshes) EXPECT_FALSE(manifold_topology(6, triangles));
}

}  // namespace
}  // namespace atlas_refine
