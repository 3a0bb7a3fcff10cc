// Coarse charts, their objective, and the way back.
#include "coarsen/coarse_atlas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "charts.h"
#include "coarsen/prolong.h"
#include "geometry/boundary.h"
#include "shapes.h"
#include "solve/newton.h"

namespace atlas_refine {
namespace {

using testing::charts_of;

constexpr double kFine = 0.012;

shapes::Polygon with_hole() {
  shapes::Polygon polygon = shapes::rectangle(1, 0.7);
  polygon.holes = {{{0.4, 0.3}, {0.4, 0.45}, {0.6, 0.45}, {0.6, 0.3}}};
  return polygon;
}

CoarseAtlas coarse_of(const std::vector<Chart>& charts, const Freedoms& freedom = {}) {
  auto coarse = coarsen(charts, make_objective(charts), freedom);
  EXPECT_TRUE(coarse);
  return std::move(*coarse);
}

double energy(const Chart& chart, const Objective& objective) {
  std::vector<Vec2> x = chart.uvs;
  for (Vec2& p : x) p /= objective.unit;
  std::vector<Triangle> elements = chart.triangles;
  for (const Guard& guard : chart.guards) elements.push_back(guard.triangle);
  return dirichlet_energy(objective, elements, x);
}

TEST(CoarseAtlas, KeepsBoundariesWithHolesAsTheyAre) {
  const std::vector<Chart> charts = charts_of(shapes::mesh(with_hole(), kFine));
  const CoarseAtlas coarse = coarse_of(charts);
  const Chart& mesh = coarse.charts[0]->mesh;
  EXPECT_LT(mesh.vertex_count(), charts[0].vertex_count() / 2);
  ASSERT_EQ(mesh.boundary_loops.size(), charts[0].boundary_loops.size());
  for (std::size_t l = 0; l < mesh.boundary_loops.size(); ++l) {
    ASSERT_EQ(mesh.boundary_loops[l].size(), charts[0].boundary_loops[l].size());
    for (std::size_t k = 0; k < mesh.boundary_loops[l].size(); ++k)
      EXPECT_EQ(coarse.charts[0]->kept[mesh.boundary_loops[l][k]], charts[0].boundary_loops[l][k]);
  }
  EXPECT_NEAR(uv_area({mesh}), uv_area(charts), 1e-12);
  testing::expect_certified({mesh});
}

TEST(CoarseAtlas, EveryVertexLiesWhereItsPlaceIs) {
  const std::vector<Chart> charts = charts_of(shapes::mesh(with_hole(), kFine));
  const CoarseChart coarse = *coarse_of(charts).charts[0];
  for (int v = 0; v < charts[0].vertex_count(); ++v) {
    const Place& place = coarse.places[v];
    Vec2 at = Vec2::Zero();
    for (int k = 0; k < 3; ++k) {
      EXPECT_GT(place.weights[k], -1e-8);
      at += place.weights[k] * coarse.mesh.uvs[coarse.mesh.triangles[place.triangle][k]];
    }
    EXPECT_LT((at - charts[0].uvs[v]).norm(), 1e-12);
  }
}

TEST(CoarseAtlas, HasTheEnergyOfTheFineOneWhereItIsStretchedAsAWhole) {
  for (const Atlas& atlas : {shapes::mesh(shapes::c_shape(), kFine, 0.3), shapes::quad_grid(60, 60)}) {
    std::vector<Chart> charts = charts_of(atlas);
    const Objective objective = make_objective(charts);
    const CoarseAtlas coarse = coarse_of(charts);
    for (const double stretch : {0.8, 1.0, 1.25}) {
      PlacedCharts placed{charts};
      for (Vec2& uv : placed.charts[0].uvs) uv.x() *= stretch;
      const double fine = energy(placed.charts[0], objective);
      const double rough = energy(restricted(coarse, placed).charts[0], coarse.objective);
      EXPECT_NEAR(rough - 1, fine - 1, 0.05 * (fine - 1) + 1e-4);
    }
  }
}

TEST(CoarseAtlas, BoundaryEdgesKeepTheirLengthsOnTheSurface) {
  const std::vector<Chart> charts = charts_of(shapes::mesh(shapes::s_shape(), kFine));
  const std::vector<Chart> coarse = {coarse_of(charts).charts[0]->mesh};
  const std::vector<double> fine_loops = make_boundary(charts, {0}).loop_length;
  const std::vector<double> coarse_loops = make_boundary(coarse, {0}).loop_length;
  EXPECT_NEAR(coarse_loops[0], fine_loops[0], 1e-3 * fine_loops[0]);
}

TEST(CoarseAtlas, ComesBackWhereItWasNotMoved) {
  const std::vector<Chart> charts = charts_of(shapes::mesh(shapes::disk(0.5), kFine));
  const Objective objective = make_objective(charts);
  const CoarseAtlas coarse = coarse_of(charts);
  const auto uvs = prolonged(coarse, charts, objective, {coarse.charts[0]->mesh.uvs});
  ASSERT_TRUE(uvs);
  for (int v = 0; v < charts[0].vertex_count(); ++v) EXPECT_LT(((*uvs)[0][v] - charts[0].uvs[v]).norm(), 1e-12);
}

TEST(CoarseAtlas, TrianglesThatTurnOverOnTheWayBackAreMended) {
  const std::vector<Chart> charts = charts_of(shapes::mesh(shapes::disk(0.5), kFine));
  const Objective objective = make_objective(charts);
  const CoarseAtlas coarse = coarse_of(charts);
  const CoarseChart& own = *coarse.charts[0];
  // One inner vertex goes most of the way to the far side of one of its triangles.
  std::vector<Vec2> bent = own.mesh.uvs;
  const int inner = own.mesh.vertex_count() - 1;
  const auto of_inner = std::find_if(own.mesh.triangles.begin(), own.mesh.triangles.end(),
                                     [&](const Triangle& t) { return std::find(t.begin(), t.end(), inner) != t.end(); });
  Vec2 middle = Vec2::Zero();
  for (const int v : *of_inner) middle += 0.5 * (v == inner ? Vec2(Vec2::Zero()) : bent[v]);
  bent[inner] += 0.95 * (middle - bent[inner]);
  std::vector<Chart> interpolated = charts;
  for (int v = 0; v < charts[0].vertex_count(); ++v) {
    interpolated[0].uvs[v] = Vec2::Zero();
    for (int k = 0; k < 3; ++k)
      interpolated[0].uvs[v] += own.places[v].weights[k] * bent[own.mesh.triangles[own.places[v].triangle][k]];
  }
  ASSERT_FALSE(certify_charts(interpolated).valid());
  const auto uvs = prolonged(coarse, charts, objective, {bent});
  ASSERT_TRUE(uvs);
  const std::vector<Chart> fine = testing::with_uvs(charts, *uvs);
  testing::expect_certified(fine);
  for (const int v : fine[0].boundary_loops[0]) EXPECT_LT((fine[0].uvs[v] - charts[0].uvs[v]).norm(), 1e-12);
}

TEST(CoarseAtlas, SmallAtlasesAndChartsThatDoNotBendStayAsTheyAre) {
  const std::vector<Chart> small = charts_of(shapes::mesh(shapes::disk(0.5), 0.05));
  EXPECT_FALSE(coarsen(small, make_objective(small), {}));
  const std::vector<Chart> charts =
      charts_of(shapes::combine({shapes::mesh(shapes::disk(0.5), kFine), shapes::mesh(shapes::u_shape(), kFine)}));
  const CoarseAtlas coarse = coarse_of(charts, {Freedom::Bends, Freedom::Moves});
  EXPECT_TRUE(coarse.charts[0]);
  EXPECT_FALSE(coarse.charts[1]);
  const PlacedCharts placed = restricted(coarse, {charts});
  EXPECT_TRUE(testing::same_bits(placed.charts[1].uvs, charts[1].uvs));
  EXPECT_NEAR(std::accumulate(coarse.objective.weight.begin(), coarse.objective.weight.end(), 0.0), 1, 0.05);
}

TEST(CoarseAtlas, ACrushedTriangleComesFreeWithoutTheOthers) {
  std::vector<Chart> charts = charts_of(shapes::mesh(shapes::rectangle(1, 0.7), kFine));
  const Objective objective = make_objective(charts);
  const std::vector<char> outside = boundary_flags(charts[0]);
  const Triangle crushed = *std::find_if(charts[0].triangles.begin(), charts[0].triangles.end(),
                                         [&](const Triangle& t) { return !outside[t[0]] && !outside[t[1]] && !outside[t[2]]; });
  const Vec2 across = 0.5 * (charts[0].uvs[crushed[1]] + charts[0].uvs[crushed[2]]);
  charts[0].uvs[crushed[0]] += (1 - 1e-5) * (across - charts[0].uvs[crushed[0]]);
  ASSERT_GT(energy(charts[0], objective), 1e4);
  charts[0].uvs = relax_crushed(charts[0], {objective.inverse_edges, objective.weight}, objective.unit);
  EXPECT_LT(energy(charts[0], objective), 1.01);
}

}  // namespace
}  // namespace atlas_refine
