// Guards: their part in the sums, what keeps them, what drops them.
#include "geometry/guards.h"

#include "charts.h"
#include "geometry/split_mesh.h"
#include "shapes.h"
#include "small_atlases.h"
#include "solve/objective.h"

namespace atlas_refine {
namespace {

using testing::charts_of;

TEST(Guards, AQuadCountsByBothDiagonalsHalfEach) {
  const Chart chart = charts_of(shapes::quad_grid(3, 2)).front();
  ASSERT_EQ(chart.guards.size(), 12u);
  EXPECT_EQ(triangle_shares(chart), std::vector<double>(12, 0.5));
  double own = 0, guards = 0;
  for (const RestTriangle& rest : chart.surface) own += rest.area;
  for (const Guard& guard : chart.guards) {
    EXPECT_EQ(guard.share, 0.5);
    guards += guard.shape.area;
  }
  EXPECT_NEAR(dirichlet_sums(chart).area, 0.5 * (own + guards), 1e-14);
  EXPECT_EQ(make_objective({chart}).weight.size(), 24u);
}

TEST(Guards, DistortionDoesNotDependOnTheFirstCorner) {
  Atlas atlas = shapes::quad_grid(5, 4);
  for (Vec2& uv : atlas.corner_uvs) uv = {uv.x() + 0.3 * uv.y() * uv.y(), uv.y() - 0.2 * uv.x() * uv.x()};
  const double before = dirichlet_sums(charts_of(atlas)).best_energy();
  for (int turn = 0; turn < 3; ++turn) {
    for (int f = 0; f < atlas.face_count(); ++f) {
      const int begin = atlas.face_offsets[f];
      std::rotate(atlas.corner_vertices.begin() + begin, atlas.corner_vertices.begin() + begin + 1,
                  atlas.corner_vertices.begin() + begin + 4);
      std::rotate(atlas.corner_uvs.begin() + begin, atlas.corner_uvs.begin() + begin + 1, atlas.corner_uvs.begin() + begin + 4);
    }
    EXPECT_NEAR(dirichlet_sums(charts_of(atlas)).best_energy(), before, 1e-12);
  }
}

TEST(Guards, TrianglesHaveNone) {
  const Chart chart = charts_of(shapes::mesh(shapes::c_shape())).front();
  EXPECT_TRUE(chart.guards.empty());
  EXPECT_EQ(triangle_shares(chart), std::vector<double>(chart.triangles.size(), 1));
}

TEST(Guards, AFaceThatIsBentLosesItsGuardsAndCountsAsItIsDivided) {
  Chart chart = charts_of(strip(3)).front();
  ASSERT_EQ(chart.guards.size(), 6u);
  // A corner of the last quad is pushed over the diagonal that is not the chart's own.
  const int bent = chart.guards.back().triangle[1];
  const Vec2 middle = 0.5 * (chart.uvs[chart.guards.back().triangle[0]] + chart.uvs[chart.guards.back().triangle[2]]);
  chart.uvs[bent] += 1.2 * (middle - chart.uvs[bent]);
  drop_broken_guards(chart);
  ASSERT_EQ(chart.guards.size(), 4u);
  EXPECT_EQ(triangle_shares(chart), (std::vector<double>{0.5, 0.5, 0.5, 0.5, 1, 1}));
}

TEST(Guards, SurviveOnFacesThatAreWhole) {
  const Chart chart = charts_of(strip(3)).front();
  SplitMesh mesh(chart);
  EXPECT_EQ(mesh.to_chart(chart).guards.size(), 6u);
  mesh.split({0, 0}, 0.5, 0.5 * (mesh.uvs[mesh.from({0, 0})] + mesh.uvs[mesh.to({0, 0})]));
  const Chart divided = mesh.to_chart(chart);
  ASSERT_EQ(divided.guards.size(), 4u);
  for (const Guard& guard : divided.guards) EXPECT_NE(guard.face, 0);
}

TEST(Guards, ACutAlongAQuadsDiagonalTakesItsGuardsAway) {
  const Chart chart = charts_of(strip(3)).front();
  SplitMesh mesh(chart);
  for (int k = 0; k < 3; ++k) {
    const Side side{2, k};
    if (mesh.is_boundary(side) || chart.triangle_faces[mesh.neighbours[2][k]] != 1) continue;
    mesh.cut({side});
    break;
  }
  ASSERT_GT(mesh.vertex_count(), chart.vertex_count());
  const Chart cut = mesh.to_chart(chart);
  ASSERT_EQ(cut.guards.size(), 4u);
  for (const Guard& guard : cut.guards) EXPECT_NE(guard.face, 1);
}

}  // namespace
}  // namespace atlas_refine
