// Fewer triangles on the surface, and the vertices that were removed back in the plane.
#include "coarsen/decimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "charts.h"
#include "geometry/boundary.h"
#include "measure/distortion.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

constexpr double kFine = 0.012, kSpacing = 0.1;

Chart plate(double lift) {
  shapes::Polygon polygon = shapes::rectangle(1, 0.7);
  polygon.holes = {{{0.4, 0.3}, {0.4, 0.45}, {0.6, 0.45}, {0.6, 0.3}}};
  return testing::charts_of(shapes::mesh(polygon, kFine, lift)).at(0);
}

Sample sample_of(const Chart& chart) { return sample_vertices(chart, boundary_flags(chart), kSpacing); }

Decimation decimated(const Chart& chart) {
  auto out = decimate(chart, sample_of(chart));
  EXPECT_TRUE(out);
  return std::move(*out);
}

/// The chart's UVs at the vertices that were kept.
std::vector<Vec2> uvs_of_kept(const Chart& chart, const Decimation& decimation) {
  std::vector<Vec2> out;
  for (const int v : decimation.kept) out.push_back(chart.uvs[v]);
  return out;
}

Chart put_back_into(Chart chart, const Decimation& decimation, const std::vector<Vec2>& uvs) {
  auto all = put_back(decimation, uvs, 1);
  EXPECT_TRUE(all);
  chart.uvs = std::move(*all);
  return chart;
}

TEST(Decimate, KeepsTheBoundaryTheHolesAndTheArea) {
  const Chart chart = plate(0);
  const Decimation decimation = decimated(chart);
  EXPECT_LT(decimation.mesh.vertex_count(), chart.vertex_count() / 3);
  EXPECT_EQ(decimation.kept.size() + decimation.removals.size(), chart.uvs.size());
  ASSERT_EQ(decimation.mesh.boundary_loops.size(), 2u);
  for (std::size_t l = 0; l < 2; ++l) {
    std::vector<int> loop = decimation.mesh.boundary_loops[l];
    for (int& v : loop) v = decimation.kept[v];
    EXPECT_EQ(loop, chart.boundary_loops[l]);
  }
  EXPECT_NEAR(decimation.mesh.surface.area(), chart.surface.area(), 1e-6 * chart.surface.area());
  Chart coarse = decimation.mesh;
  coarse.uvs = uvs_of_kept(chart, decimation);
  testing::expect_certified({coarse});
}

TEST(Decimate, AFlatChartComesBackAsItWas) {
  const Chart chart = plate(0);
  const Decimation decimation = decimated(chart);
  const Chart back = put_back_into(chart, decimation, uvs_of_kept(chart, decimation));
  testing::expect_certified({back});
  for (int v = 0; v < chart.vertex_count(); ++v) EXPECT_LT((back.uvs[v] - chart.uvs[v]).norm(), 1e-5 * kFine);
}

TEST(Decimate, ACurvedChartComesBackLittleDistorted) {
  const Chart chart = plate(0.3);
  const Decimation decimation = decimated(chart);
  const Chart back = put_back_into(chart, decimation, uvs_of_kept(chart, decimation));
  testing::expect_certified({back});
  EXPECT_LT(dirichlet_sums(back).best_energy(), 1.05 * dirichlet_sums(chart).best_energy());
}

TEST(Decimate, ComesBackTheSameOnAnyNumberOfThreads) {
  const Chart chart = plate(0.3);
  const Decimation decimation = decimated(chart);
  const std::vector<Vec2> uvs = uvs_of_kept(chart, decimation);
  EXPECT_EQ(put_back(decimation, uvs, 1), put_back(decimation, uvs, 4));
}

TEST(Decimate, WhereverTheCoarseTrianglesArePositiveAllAre) {
  const Chart chart = plate(0.3);
  const Decimation decimation = decimated(chart);
  std::vector<Vec2> crushed = uvs_of_kept(chart, decimation);
  for (Vec2& uv : crushed) uv = {uv.x() + 20 * uv.y(), 1e-3 * uv.y()};
  Chart coarse = decimation.mesh;
  coarse.uvs = crushed;
  testing::expect_certified({coarse});
  testing::expect_certified({put_back_into(chart, decimation, crushed)});
}

TEST(Decimate, NothingWhereAllVerticesAreNearTheBoundary) {
  const Chart strip = testing::charts_of(shapes::mesh(shapes::rectangle(1, 0.03), 0.01, 0)).at(0);
  EXPECT_FALSE(decimate(strip, sample_of(strip)));
}

}  // namespace
}  // namespace atlas_refine
