// Charts that no plane can hold: what opens them.
#include "cut/open_closed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <set>

#include "charts.h"
#include "closed_shapes.h"
#include "cut/cut_atlas.h"
#include "cut/scale_forecast.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

Chart only_chart(const Atlas& atlas) {
  const std::vector<Chart> charts = shapes::unparted(atlas);
  EXPECT_EQ(charts.size(), 1u);
  return charts.front();
}

CutAtlas opened(const Chart& chart) {
  std::vector<SurfacePath> paths;
  for (const auto& [from, to] : opening_edges(chart)) paths.push_back({0, {from, to}});
  return cut_along(whole_atlas({chart}), {chart}, paths);
}

TEST(OpenClosed, TellsWhatFitsThePlane) {
  EXPECT_TRUE(shape_of(only_chart(shapes::mesh(shapes::ring()))).fits_plane());
  EXPECT_EQ(shape_of(only_chart(shapes::cube_sphere(4))).loops, 0);
  EXPECT_EQ(shape_of(only_chart(shapes::cube_sphere(4))).handles, 0);
  EXPECT_EQ(shape_of(only_chart(shapes::torus(12, 8))).handles, 1);
  EXPECT_EQ(shape_of(only_chart(shapes::torus(12, 8, 1))).handles, 1);
  EXPECT_EQ(shape_of(only_chart(shapes::torus(12, 8, 1))).loops, 1);
}

TEST(OpenClosed, OpensSpheresAndToriToDisks) {
  for (const Atlas& atlas : {shapes::cube_sphere(1), shapes::cube_sphere(5), shapes::torus(16, 8), shapes::torus(4, 3)}) {
    const Chart chart = only_chart(atlas);
    const CutAtlas cut = opened(chart);
    ASSERT_EQ(cut.pieces.size(), 1u);
    const ChartShape shape = shape_of(cut.pieces[0].mesh);
    EXPECT_EQ(shape.loops, 1);
    EXPECT_EQ(shape.handles, 0);
    EXPECT_EQ(cut.pieces[0].mesh.triangles.size(), chart.triangles.size());
  }
}

TEST(OpenClosed, HolesStayWhereAHandleIsOpened) {
  for (const int holes : {1, 3}) {
    const CutAtlas cut = opened(only_chart(shapes::torus(16, 10, holes)));
    ASSERT_EQ(cut.pieces.size(), 1u);
    EXPECT_TRUE(shape_of(cut.pieces[0].mesh).fits_plane());
  }
}

/// A torus with a hole that runs nearly around its tube and has teeth on both sides.
Atlas torus_with_jagged_hole() {
  const int around = 4, tube = 12;
  const Atlas whole = shapes::torus(around, tube);
  Atlas out;
  out.positions = whole.positions;
  for (int f = 0; f < whole.face_count(); ++f) {
    const int i = f / tube, j = f % tube;
    const bool tooth = (i == 1 && j % 3 == 1) || (i == around - 1 && j % 3 == 2);
    if ((i == 0 || tooth) && j < tube - 1) continue;
    std::array<int, 4> corners{};
    std::copy_n(whole.corner_vertices.begin() + whole.face_offsets[f], 4, corners.begin());
    shapes::add_quad(out, corners);
  }
  return out;
}

// The shortest loop around the tube runs along the hole's border, from tooth to tooth.
TEST(OpenClosed, NothingIsPartedAlongAHole) {
  const Chart chart = only_chart(torus_with_jagged_hole());
  ASSERT_EQ(shape_of(chart).handles, 1);
  const CutAtlas cut = opened(chart);
  ASSERT_EQ(cut.pieces.size(), 1u);
  EXPECT_TRUE(shape_of(cut.pieces[0].mesh).fits_plane());
}

TEST(OpenClosed, RunsAlongEdgesOfFacesOnly) {
  const Atlas atlas = shapes::torus(16, 8);
  const Chart chart = only_chart(atlas);
  std::set<std::pair<int, int>> diagonals;
  for (std::size_t t = 0; t + 1 < chart.triangles.size(); ++t) {
    if (chart.triangle_faces[t] != chart.triangle_faces[t + 1]) continue;
    std::vector<int> shared;
    for (const int v : chart.triangles[t]) {
      for (const int w : chart.triangles[t + 1]) {
        if (v == w) shared.push_back(v);
      }
    }
    ASSERT_EQ(shared.size(), 2u);
    diagonals.insert(std::minmax(shared[0], shared[1]));
  }
  ASSERT_EQ(diagonals.size(), static_cast<std::size_t>(atlas.face_count()));
  for (const auto& [a, b] : opening_edges(chart)) EXPECT_FALSE(diagonals.contains(std::minmax(a, b)));
}

TEST(OpenClosed, ForecastOfACornerIsItsCurvature) {
  const Chart chart = only_chart(shapes::cube(1));
  ScaleForecast forecast(chart);
  std::vector<char> border(chart.vertex_count(), 1);
  border[3] = 0;
  // A right angle is missing around it; each of its three squares has cotangents that add up to 2, however it is divided.
  const std::vector<double> logarithms = forecast.logarithms(border);
  EXPECT_NEAR(logarithms[3], -0.5 * std::numbers::pi / 3, 1e-8);
  const double one_corner = forecast.energy(logarithms);
  EXPECT_GT(one_corner, 1.01);
  border[4] = 0;
  EXPECT_GT(forecast.energy(forecast.logarithms(border)), one_corner);
}

TEST(OpenClosed, LoopsOfATorusAreShort) {
  // Radii 3 and 1: the shortest cut to a disk is one loop round the tube and one through the hole, 2 pi (1 + 2). From there a
  // seam half round the tube saves more than its length is worth.
  const Chart chart = only_chart(shapes::torus(48, 16));
  const CutAtlas cut = opened(chart);
  EXPECT_LE(cut.seams.size(), 48u + 16u + 16u / 2);
}

}  // namespace
}  // namespace atlas_refine
