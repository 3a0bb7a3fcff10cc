// Dividing and cutting: the surface keeps its area, neighbours fit, every vertex has one fan.
#include "geometry/split_mesh.h"

#include "cut_checks.h"
#include "small_atlases.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

using testing::chart_of;
using testing::expect_conforming;
using testing::rest_area;
using testing::supported;

Side random_side(const SplitMesh& mesh, Rng& rng) { return {rng.below(mesh.triangle_count()), rng.below(3)}; }

/// `count` edges divided at random places, the UVs where the supports say.
SplitMesh divided(const Chart& chart, int count, Rng& rng) {
  SplitMesh mesh(chart);
  for (int k = 0; k < count; ++k) {
    const Side side = random_side(mesh, rng);
    const double along = rng.uniform(0.2, 0.8);
    const Vec2 uv = (1 - along) * mesh.uvs[mesh.from(side)] + along * mesh.uvs[mesh.to(side)];
    mesh.split(side, along, uv);
  }
  return mesh;
}

TEST(SplitMesh, StartsAsTheChart) {
  for (const shapes::Named& shape : testing::many_polygons()) {
    SCOPED_TRACE(shape.name);
    const Chart chart = chart_of(shape.polygon);
    const SplitMesh mesh(chart);
    expect_conforming(mesh);
    EXPECT_EQ(mesh.triangles, chart.triangles);
    const Chart back = mesh.to_chart(chart);
    EXPECT_EQ(back.triangle_faces, chart.triangle_faces);
    EXPECT_EQ(back.boundary_loops.size(), chart.boundary_loops.size());
    for (std::size_t t = 0; t < chart.surface.size(); ++t) {
      EXPECT_NEAR(back.surface[t].area, chart.surface[t].area, 1e-14);
      EXPECT_LT((back.surface[t].inverse_edges - chart.surface[t].inverse_edges).norm(),
                1e-9 * chart.surface[t].inverse_edges.norm());
    }
  }
}

TEST(SplitMesh, SplitsKeepTheSurface) {
  Rng rng(1);
  for (const shapes::Named& shape : testing::many_polygons()) {
    SCOPED_TRACE(shape.name);
    const Chart chart = chart_of(shape.polygon, 0.12);
    const SplitMesh mesh = divided(chart, 150, rng);
    expect_conforming(mesh);
    EXPECT_EQ(mesh.vertex_count(), chart.vertex_count() + 150);
    const Chart parts = mesh.to_chart(chart);
    EXPECT_NEAR(rest_area(parts), rest_area(chart), 1e-12);
    for (const RestTriangle& rest : parts.surface) EXPECT_GT(rest.area, 0);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      EXPECT_LT((supported(chart.uvs, mesh.supports[v]) - mesh.uvs[v]).norm(), 1e-12);
      const auto& weights = mesh.supports[v].weights;
      EXPECT_NEAR(weights[0] + weights[1] + weights[2], 1, 1e-12);
    }
    // A part is bent as much as the triangle that it is part of.
    EXPECT_NEAR(dirichlet_sums({parts}).dirichlet, dirichlet_sums({chart}).dirichlet, 1e-9 * dirichlet_sums({chart}).dirichlet);
    EXPECT_NEAR(dirichlet_sums({parts}).inverse, dirichlet_sums({chart}).inverse, 1e-9 * dirichlet_sums({chart}).inverse);
    EXPECT_EQ(parts.boundary_loops.size(), chart.boundary_loops.size());
  }
}

TEST(SplitMesh, ANewVertexOfTheBoundaryLiesOnIt) {
  const Chart chart = testing::charts_of(unit_square()).front();
  SplitMesh mesh(chart);
  const Side outer = mesh.boundary_loops().front().front();
  const int a = mesh.from(outer), b = mesh.to(outer);
  const int middle = mesh.split(outer, 0.25, 0.75 * mesh.uvs[a] + 0.25 * mesh.uvs[b]);
  EXPECT_TRUE(mesh.on_boundary(middle));
  EXPECT_EQ(mesh.boundary_loops().front().size(), 5u);
  EXPECT_GE(mesh.find_side(a, middle).triangle, 0);
  EXPECT_GE(mesh.find_side(middle, b).triangle, 0);
  EXPECT_LT(mesh.find_side(a, b).triangle, 0);
  expect_conforming(mesh);
}

TEST(SplitMesh, CutsAtRandomLeaveOneFanPerVertex) {
  for (int seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    const Chart chart = chart_of(shapes::star(), 0.2);
    SplitMesh mesh = divided(chart, 20, rng);
    const int before = mesh.vertex_count();
    std::vector<Side> sides;
    for (int k = 0; k < 30; ++k) sides.push_back(random_side(mesh, rng));
    const std::vector<int> originals = mesh.cut(sides);
    expect_conforming(mesh);
    for (const Side& s : sides) EXPECT_TRUE(mesh.is_boundary(s));
    ASSERT_EQ(mesh.vertex_count(), before + static_cast<int>(originals.size()));
    for (std::size_t k = 0; k < originals.size(); ++k) EXPECT_EQ(mesh.uvs[before + k], mesh.uvs[originals[k]]);
    EXPECT_NEAR(rest_area(mesh.to_chart(chart)), rest_area(chart), 1e-12);
  }
}

TEST(SplitMesh, CuttingEveryEdgeLeavesSingleTriangles) {
  const Chart chart = chart_of(shapes::c_shape(), 0.2);
  SplitMesh mesh(chart);
  std::vector<Side> all;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) all.push_back({t, k});
  }
  mesh.cut(all);
  expect_conforming(mesh);
  EXPECT_EQ(mesh.vertex_count(), 3 * mesh.triangle_count());
  EXPECT_EQ(mesh.boundary_loops().size(), chart.triangles.size());
}

TEST(SplitMesh, TheLongestLoopComesFirst) {
  const Chart chart = chart_of(shapes::ring());
  const auto loops = SplitMesh(chart).vertex_loops();
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_NEAR(chart.uvs[loops[0][0]].norm(), 0.5, 1e-2);
  EXPECT_NEAR(chart.uvs[loops[1][0]].norm(), 0.25, 1e-2);
}

TEST(Support, BetweenIsTheMean) {
  const Support a{{3, 5, -1}, {0.25, 0.75, 0}}, b{{5, 8, -1}, {0.5, 0.5, 0}};
  const Support middle = between(a, b, 0.5);
  EXPECT_EQ(middle.vertices, (std::array<int, 3>{3, 5, 8}));
  EXPECT_DOUBLE_EQ(middle.weights[0], 0.125);
  EXPECT_DOUBLE_EQ(middle.weights[1], 0.625);
  EXPECT_DOUBLE_EQ(middle.weights[2], 0.25);
}

}  // namespace
}  // namespace atlas_refine
