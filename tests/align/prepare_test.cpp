// Preparation: disks without ears, bridging edges or very long boundary edges.
#include "align/prepare.h"

#include "cut_checks.h"
#include "geometry/half_edge_mesh.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

void expect_prepared(const Chart& chart) {
  const PreparedChart prepared = prepare_chart(chart);
  const SplitMesh& mesh = prepared.mesh;
  ASSERT_TRUE(prepared.opening.is_disk);
  EXPECT_EQ(prepared.opening.holes_cut, static_cast<int>(chart.boundary_loops.size()) - 1);
  testing::expect_conforming(mesh);
  testing::expect_positive(mesh.uvs, mesh.triangles);
  EXPECT_EQ(mesh_topology(mesh.vertex_count(), mesh.triangles).euler_characteristic, 1);
  EXPECT_NEAR(testing::rest_area(mesh.to_chart(chart)), testing::rest_area(chart), 1e-12);
  for (int v = 0; v < mesh.vertex_count(); ++v)
    EXPECT_LT((testing::supported(chart.uvs, mesh.supports[v]) - mesh.uvs[v]).norm(), 1e-12);
  const auto loops = mesh.boundary_loops();
  ASSERT_EQ(loops.size(), 1u);
  double perimeter = 0, longest = 0;
  for (const Side& s : loops[0]) {
    const double length = (mesh.uvs[mesh.to(s)] - mesh.uvs[mesh.from(s)]).norm();
    perimeter += length;
    longest = std::max(longest, length);
  }
  EXPECT_LE(longest, 0.08 * perimeter);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    int outer = 0;
    for (int k = 0; k < 3; ++k) {
      const Side s{t, k};
      outer += mesh.is_boundary(s);
      EXPECT_FALSE(!mesh.is_boundary(s) && mesh.on_boundary(mesh.from(s)) && mesh.on_boundary(mesh.to(s))) << "a bridge";
    }
    EXPECT_LT(outer, 2) << "an ear";
  }
}

TEST(Prepare, EveryShapeBecomesADiskWithoutEarsAndBridges) {
  for (const shapes::Named& shape : testing::many_polygons()) {
    SCOPED_TRACE(shape.name);
    expect_prepared(testing::chart_of(shape.polygon, 0.15));
  }
  expect_prepared(testing::charts_of(shapes::self_overlapping()).front());
}

TEST(Prepare, ChartsOfVeryFewTriangles) {
  expect_prepared(testing::charts_of(unit_square()).front());
  expect_prepared(testing::charts_of(strip(6)).front());
  expect_prepared(testing::charts_of(flat_atlas({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})).front());
}

// Trails across fans of slivers would run askew on the surface.
TEST(Prepare, LongFacesAreDividedInsideToo) {
  for (const double length : {20.0, 200.0}) {
    const Chart chart = testing::charts_of(plank(length)).front();
    expect_prepared(chart);
    const SplitMesh mesh = prepare_chart(chart).mesh;
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      for (int k = 0; k < 3; ++k)
        EXPECT_LE((mesh.uvs[mesh.to({t, k})] - mesh.uvs[mesh.from({t, k})]).norm(), 0.08 * 2 * (length + 1));
    }
  }
}

TEST(Prepare, SeveralHolesAreAllCut) {
  shapes::Polygon polygon = shapes::rectangle(1, 1);
  for (const Vec2& centre : {Vec2(0.25, 0.25), Vec2(0.7, 0.3), Vec2(0.5, 0.75)}) {
    std::vector<Vec2> hole;
    for (const Vec2& p : shapes::disk(0.1, 12).outer) hole.push_back(p + centre);
    std::reverse(hole.begin(), hole.end());
    polygon.holes.push_back(hole);
  }
  const Chart chart = testing::chart_of(polygon);
  ASSERT_EQ(chart.boundary_loops.size(), 4u);
  expect_prepared(chart);
}

}  // namespace
}  // namespace atlas_refine
