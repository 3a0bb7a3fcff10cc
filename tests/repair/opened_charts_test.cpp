// Charts without a boundary, or with a handle, are opened where that is allowed; else they are left and named.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "atlas_refine/refine.h"
#include "charts.h"
#include "closed_shapes.h"
#include "geometry/rest_triangle.h"
#include "measure/bad_triangles.h"
#include "measure/distortion.h"
#include "refine_checks.h"
#include "repair_checks.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

using What = ChartRepair::What;

TEST(OpenedCharts, AHandleIsLeftAndNamedWithoutPermission) {
  const RepairedCharts out = testing::repaired(shapes::unparted(shapes::torus(12, 8, 1)));
  EXPECT_TRUE(out.repairs.empty());
  ASSERT_EQ(out.unmended.size(), 1u);
  EXPECT_NE(out.unmended[0].reason.find("has a handle"), std::string::npos);
  EXPECT_NE(out.unmended[0].reason.find("--open-closed"), std::string::npos);
}

TEST(OpenedCharts, ClosedChartsAreOpenedWherePermitted) {
  for (const auto& [atlas, most] : {std::pair(shapes::cube_sphere(6), 1.6), std::pair(shapes::torus(24, 12), 1.6),
                                    std::pair(shapes::torus(24, 12, 1), 1.6)}) {
    const std::vector<Chart> charts = shapes::unparted(atlas);
    const RepairedCharts out = testing::repaired(charts, {.open_closed = true});
    ASSERT_EQ(out.repairs.size(), 1u);
    EXPECT_EQ(out.repairs[0].what, What::Opened);
    EXPECT_FALSE(out.atlas.seams.empty());
    ASSERT_EQ(out.atlas.pieces.size(), 1u);
    testing::expect_certified(meshes_of(out.atlas));
    EXPECT_LT(dirichlet_sums(out.atlas.pieces[0].mesh).best_energy(), most);
  }
}

TEST(OpenedCharts, WhatTheyWereBeforeIsTakenTriangleByTriangleForTheyHaveMoreVerticesNow) {
  Chart before = shapes::unparted(shapes::torus(24, 12)).front();
  before.guards.clear();  // with them both divisions of a quad count
  const RepairedCharts out = testing::repaired({before}, {.open_closed = true});
  ASSERT_EQ(out.repairs.size(), 1u);
  const Chart& after = out.atlas.pieces[0].mesh;
  ASSERT_GT(after.vertex_count(), before.vertex_count());
  const std::vector<char> misshapen = misshapen_triangles(before);
  std::vector<RestTriangle> shapes;
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < misshapen.size(); ++t) {
    if (misshapen[t]) continue;
    const Triangle& v = before.triangles[t];
    shapes.push_back(rest_from_plane(before.uvs[v[0]], before.uvs[v[1]], before.uvs[v[2]], 1));
    triangles.push_back(after.triangles[t]);
  }
  EXPECT_NEAR(out.repairs[0].distortion_to_input, dirichlet_sums(shapes, triangles, after.uvs).best_energy(), 1e-9);
}

TEST(OpenedCharts, ACubeBecomesACrossOrAnotherNet) {
  const RepairedCharts out = testing::repaired(shapes::unparted(shapes::cube(1)), {.open_closed = true});
  ASSERT_TRUE(out.unmended.empty());
  EXPECT_EQ(out.atlas.seams.size(), 7u);
  EXPECT_LT(dirichlet_sums(out.atlas.pieces[0].mesh).best_energy(), 1.0005);
}

TEST(OpenedCharts, ACubeOfManyFacesIsOpenedAlongItsSharpEdges) {
  Atlas atlas = shapes::cube(4);
  for (Vec2& uv : atlas.corner_uvs) uv = {0.5, 0.5};
  const RefineResult result = refine(atlas, {.pe_bound = 0.4, .open_closed = true, .collapsed = Collapsed::Embed});
  EXPECT_EQ(result.new_seams.size(), 7u * 4);
  EXPECT_LT(result.after.distortion, 1.01);
}

/// Wrapped around, but not by a whole tile: nobody can tell that from a closed chart.
Atlas closed_torus() {
  Atlas atlas = shapes::wrapped(shapes::torus(24, 12));
  for (Vec2& uv : atlas.corner_uvs) uv *= 0.45;
  return atlas;
}

using VertexPairs = std::vector<std::array<int, 2>>;

/// Edges of torus(24, 12) around the tube at column i, and once around the torus at row j.
VertexPairs loops_of_torus(int i, int j) {
  VertexPairs out;
  for (int k = 0; k < 12; ++k) out.push_back({i * 12 + k, i * 12 + (k + 1) % 12});
  for (int k = 0; k < 24; ++k) out.push_back({k * 12 + j, (k + 1) % 24 * 12 + j});
  return out;
}

std::set<std::pair<int, int>> as_set(const VertexPairs& pairs) {
  std::set<std::pair<int, int>> out;
  for (const auto& [a, b] : pairs) out.insert(std::minmax(a, b));
  return out;
}

TEST(OpenedCharts, OpeningsKeepOffEdgesThatMustStayWhole) {
  RefineOptions options{.pe_bound = 0.6, .open_closed = true};
  const RefineResult free = refine(closed_torus(), options);
  options.no_seam = free.new_seams;
  const RefineResult other = refine(closed_torus(), options);
  ASSERT_FALSE(other.new_seams.empty());
  const auto forbidden = as_set(options.no_seam);
  for (const auto& [a, b] : other.new_seams) EXPECT_FALSE(forbidden.contains(std::minmax(a, b)));
}

TEST(OpenedCharts, OpeningsFollowPreferredEdges) {
  const VertexPairs loops = loops_of_torus(7, 4);
  const RefineResult result = refine(closed_torus(), {.pe_bound = 0.6, .open_closed = true, .prefer_seam = loops});
  const auto seams = as_set(result.new_seams);
  for (const auto& pair : loops) EXPECT_TRUE(seams.contains(std::minmax(pair[0], pair[1])));
}

TEST(OpenedCharts, WhereNoEdgeMayOpenTheChartIsLeftAndTold) {
  const Atlas atlas = closed_torus();
  RefineOptions options{.pe_bound = 0.6, .open_closed = true};
  for (int i = 0; i < 24; ++i) {
    for (const auto& pair : loops_of_torus(i, i % 12)) options.no_seam.push_back(pair);
  }
  const RefineError refused = testing::refusal(atlas, options);
  EXPECT_NE(std::string(refused.what()).find("--no-seam"), std::string::npos) << refused.what();
}

TEST(OpenedCharts, ARefinedTorusHasRealSeams) {
  const Atlas atlas = closed_torus();
  const RefineResult result = refine(atlas, {.pe_bound = 0.6, .open_closed = true});
  EXPECT_FALSE(result.cut);
  EXPECT_FALSE(result.new_seams.empty());
  EXPECT_EQ(result.added_seams, static_cast<int>(result.new_seams.size()));
  EXPECT_GE(result.after.pe, 0.6);
  const RefineError refused = testing::refusal(atlas);
  EXPECT_NE(std::string(refused.what()).find("has no boundary"), std::string::npos) << refused.what();
}

TEST(OpenedCharts, AClosedChartIsLeftAndTheOthersRefined) {
  const Atlas torus = closed_torus();
  const Atlas atlas = shapes::combine({torus, shapes::mesh(shapes::star(), 0.1)});
  const RefineResult result = refine(atlas, {.pe_bound = 0.7});
  EXPECT_TRUE(result.bound_met);
  EXPECT_EQ(result.charts[0].fate, Fate::Left);
  EXPECT_NE(result.charts[0].reason.find("--open-closed"), std::string::npos);
  for (int c = 0; c < torus.corner_count(); ++c) EXPECT_EQ(result.corner_uvs[c], atlas.corner_uvs[c]);
}

TEST(OpenedCharts, OpenedChartsAreCutIntoRectangles) {
  for (const Atlas& atlas : {closed_torus()}) {
    const RefineOptions options{
        .pe_bound = 0.7, .seams = Seams::Rectangles, .rectangles = {.candidates = 50}, .open_closed = true};
    const RefineResult result = refine(atlas, options);
    EXPECT_TRUE(result.fallbacks.empty()) << result.fallbacks.front();
    EXPECT_EQ(result.intervention, Intervention::Cut);
    ASSERT_TRUE(result.cut);
    EXPECT_FALSE(result.cut->new_seams.empty());
    EXPECT_LT(result.after.distortion, 1.3);
  }
}

TEST(OpenedCharts, ADoubledTriangleIsOpenedAlongTwoSides) {
  Chart pillow{.uvs = {{0, 0}, {1, 0}, {0.3, 0.8}},
               .triangles = {{0, 1, 2}, {2, 1, 0}},
               .surface = {},
               .triangle_faces = {0, 1},
               .boundary_loops = {}};
  const Vec3 p(0, 0, 0), q(1, 0, 0), r(0.3, 0.8, 0);
  pillow.surface = Surface({rest_from_space(p, q, r), rest_from_space(r, q, p)});
  const RepairedCharts out = testing::repaired({pillow}, {.open_closed = true});
  ASSERT_TRUE(out.unmended.empty()) << out.unmended[0].reason;
  EXPECT_EQ(out.atlas.seams.size(), 2u);
  testing::expect_certified(meshes_of(out.atlas));
}

TEST(OpenedCharts, AWrappedTubeEndsFlat) {
  // A tube whose last column runs back over the whole width, as unwrapping without a seam makes it.
  Atlas atlas = shapes::torus(24, 12, 1);
  for (int f = 0; f < atlas.face_count(); ++f) {
    const int i = (f + 1) / 12, j = (f + 1) % 12;
    for (int k = 0; k < 4; ++k)
      atlas.corner_uvs[4 * f + k] = {((k == 1 || k == 2 ? i + 1 : i) % 24) / 24.0, ((k >= 2 ? j + 1 : j) % 12) / 12.0};
  }
  const RepairedCharts out = testing::repaired(testing::charts_of(atlas), {.open_closed = true});
  ASSERT_TRUE(out.unmended.empty());
  testing::expect_certified(meshes_of(out.atlas));
}

}  // namespace
}  // namespace atlas_refine
