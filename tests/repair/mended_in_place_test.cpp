// A few flipped, zero-area or crushed faces are mended in place, and the others keep their shapes.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "atlas_refine/refine.h"
#include "charts.h"
#include "geometry/guards.h"
#include "geometry/rest_triangle.h"
#include "measure/bad_triangles.h"
#include "refine_checks.h"
#include "repair_checks.h"
#include "shapes.h"
#include "small_atlases.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

using What = ChartRepair::What;

TEST(MendedInPlace, OneFlippedTriangleInALargeChartKeepsItsShape) {
  const Atlas good = shapes::mesh(shapes::disk(0.5), 0.03);
  for (const double far : {0.045, 0.2}) {
    const Atlas atlas = testing::with_vertex_moved(good, {0.1, 0.05}, {far, 0});
    const std::vector<Chart> charts = testing::charts_of(atlas);
    const std::vector<char> bad = bad_triangles(charts[0]);
    ASSERT_GT(std::count(bad.begin(), bad.end(), 1), 0);
    const ChartRepair repair = testing::only_repair(atlas);
    EXPECT_EQ(repair.what, What::Untangled);
    EXPECT_FALSE(repair.faces.empty());
    EXPECT_LE(repair.distortion_to_input, 1.02);
  }
}

/// A sheet of triangles with the columns between two lines so narrow in the UVs.
Atlas with_narrow_columns(double narrow) {
  Atlas atlas = shapes::mesh(shapes::rectangle(1, 0.6), 0.06, 0);
  for (Vec2& uv : atlas.corner_uvs) uv.x() = uv.x() - (1 - narrow) * std::clamp(uv.x() - 0.4, 0.0, 0.15);
  return atlas;
}

TEST(MendedInPlace, TrianglesThatAreNextToFlatGetTheirShapeBack) {
  for (const double narrow : {1e-5, 1e-6, 3e-7}) {
    const Atlas atlas = with_narrow_columns(narrow);
    const ChartRepair repair = testing::only_repair(atlas);
    EXPECT_EQ(repair.what, What::Untangled);
    EXPECT_LE(repair.distortion_to_input, 1.02);
    const std::vector<Chart> charts = testing::charts_of(atlas);
    EXPECT_GT(dirichlet_sums(charts).best_energy(), 1000);
    EXPECT_LT(dirichlet_sums(meshes_of(testing::repaired(charts).atlas)).best_energy(), 2);
  }
}

TEST(MendedInPlace, ShapesThatTheWholeChartHasAreMeant) {
  EXPECT_TRUE(testing::repaired(testing::charts_of(with_narrow_columns(1e-2))).repairs.empty());
  // Squeezed as a whole, or less and less from one end to the other without being bent.
  Atlas squeezed = shapes::mesh(shapes::disk(0.5), 0.06), shrinking = squeezed;
  for (Vec2& uv : squeezed.corner_uvs) uv.y() *= 1e-5;
  for (Vec2& uv : shrinking.corner_uvs) uv = std::exp(-12 * (uv.x() + 0.5)) * Vec2(std::cos(3 * uv.y()), std::sin(3 * uv.y()));
  EXPECT_TRUE(testing::repaired(testing::charts_of(squeezed)).repairs.empty());
  EXPECT_TRUE(testing::repaired(testing::charts_of(shrinking)).repairs.empty());
}

TEST(MendedInPlace, OneFlippedTriangleInAChartThatIsAllButALineHasItEmbeddedAnew) {
  Atlas atlas = testing::with_vertex_moved(shapes::mesh(shapes::disk(0.5), 0.03), {0.1, 0.05}, {0, 0.045});
  for (Vec2& uv : atlas.corner_uvs) uv.y() *= 1e-3;
  EXPECT_EQ(testing::only_repair(atlas).what, What::Embedded);
}

TEST(MendedInPlace, FacesThatAVertexDrewOutHaveNoShapeToKeep) {
  const Atlas good = shapes::quad_grid(20, 20);
  for (const Vec2& at : {Vec2(0.65, 0.9), Vec2(0.5, 0.5), Vec2(0.9, 0.1)}) {
    const Chart before = testing::charts_of(good)[0];
    const Chart drawn = testing::charts_of(testing::with_vertex_moved(good, at, -at))[0];
    const Chart after = testing::repaired({drawn}).atlas.pieces[0].mesh;
    std::vector<Triangle> untouched;
    std::vector<RestTriangle> shapes_before;
    for (const Triangle& t : before.triangles) {
      if (std::any_of(t.begin(), t.end(), [&](int v) { return before.uvs[v] != drawn.uvs[v]; })) continue;
      untouched.push_back(t);
      shapes_before.push_back(rest_from_plane(before.uvs[t[0]], before.uvs[t[1]], before.uvs[t[2]], 1));
    }
    ASSERT_LT(untouched.size(), before.triangles.size());
    EXPECT_LE(dirichlet_sums(shapes_before, untouched, after.uvs).best_energy(), 1.02) << at.transpose();
  }
}

/// Faces whose polygons hold under every division.
std::set<int> convex_faces(Chart chart) {
  drop_broken_guards(chart);
  std::set<int> faces;
  for (const Guard& guard : chart.guards) faces.insert(guard.face);
  return faces;
}

/// Every vertex moved by itself, in the UV map and on the surface: many quads are nearly concave.
Atlas shaken(Atlas atlas, double amount, std::uint64_t seed) {
  Rng rng(seed, 0);
  std::map<std::pair<double, double>, Vec2> by;
  for (int c = 0; c < atlas.corner_count(); ++c) {
    Vec2& uv = atlas.corner_uvs[c];
    const auto [at, added] = by.emplace(std::pair(uv.x(), uv.y()), Vec2::Zero());
    if (added) at->second = amount * Vec2(rng.uniform(-1, 1), rng.uniform(-1, 1));
    uv += at->second;
    atlas.positions[atlas.corner_vertices[c]].head<2>() = uv;
  }
  return atlas;
}

TEST(MendedInPlace, QuadsThatWereConvexStaySo) {
  for (int k = 20; k < 30; ++k) {
    Rng rng(k, 1);
    const Vec2 at(rng.uniform(0.1, 0.9), rng.uniform(0.1, 0.9)), by(rng.uniform(-0.25, 0.25), rng.uniform(-0.25, 0.25));
    const Chart before = testing::charts_of(testing::with_vertex_moved(shaken(shapes::quad_grid(12, 12), 0.045, k), at, by))[0];
    const std::set<int> after = convex_faces(testing::repaired({before}).atlas.pieces[0].mesh);
    for (const int face : convex_faces(before)) EXPECT_TRUE(after.contains(face)) << "face " << face << ", seed " << k;
  }
}

TEST(MendedInPlace, FarFromTheBadTriangleNothingMoves) {
  const Atlas atlas = testing::with_vertex_moved(shapes::mesh(shapes::disk(0.5), 0.03), {0.3, 0}, {0.045, 0});
  const Chart before = testing::charts_of(atlas)[0];
  const Chart after = testing::repaired({before}).atlas.pieces[0].mesh;
  int still = 0;
  for (int v = 0; v < before.vertex_count(); ++v) still += before.uvs[v] == after.uvs[v];
  EXPECT_GT(still, 0.8 * before.vertex_count());
  EXPECT_LT(still, before.vertex_count());
}

TEST(MendedInPlace, AFlippedBoundaryTriangleIsTurnedBack) {
  const Atlas atlas = testing::with_vertex_moved(shapes::mesh(shapes::rectangle(1, 0.6), 0.08), {1, 0.3}, {-0.12, 0});
  const ChartRepair repair = testing::only_repair(atlas);
  EXPECT_EQ(repair.what, What::Untangled);
  EXPECT_LE(repair.distortion_to_input, 1.02);
}

TEST(MendedInPlace, AQuadWithTwoEqualUvCornersOpensALittle) {
  // The corners of one inner edge fall together in the UV map.
  Atlas atlas = shapes::quad_grid(8, 8);
  const Vec2 kept = atlas.corner_uvs[4 * 27 + 1], lost = atlas.corner_uvs[4 * 27 + 2];
  ASSERT_NE(kept, lost);
  std::replace(atlas.corner_uvs.begin(), atlas.corner_uvs.end(), lost, kept);
  const ChartRepair repair = testing::only_repair(atlas);
  EXPECT_EQ(repair.what, What::Untangled);
  EXPECT_LE(repair.distortion_to_input, 1.02);
}

TEST(MendedInPlace, AFaceWithoutAreaInSpaceAndUvsStaysBetweenItsNeighbours) {
  // Two strips that meet along a T: the filler triangle has its three corners on one line, in space too.
  const Atlas atlas = flat_atlas({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {1, 0, 0}, {0, -1, 0}, {2, -1, 0}, {1, -1, 0}},
                                 {{0, 1, 2, 3}, {0, 4, 1}, {5, 7, 4, 0}, {7, 6, 1, 4}});
  const ChartRepair repair = testing::only_repair(atlas);
  EXPECT_EQ(repair.what, What::Untangled);
  EXPECT_EQ(repair.faces, std::vector<int>{1});
  EXPECT_LE(repair.distortion_to_input, 1.02);
}

TEST(MendedInPlace, FlippedFacesDoNotRefuseAFile) {
  const Atlas atlas = testing::with_vertex_moved(shapes::mesh(shapes::disk(0.5), 0.06), {0, 0}, {0.2, 0.03});
  const RefineOptions options{.pe_bound = 0.7};
  const RefineResult result = testing::refine_soundly(atlas, options);
  EXPECT_EQ(result.repairs.size(), 1u);
}

TEST(MendedInPlace, WhereABadFaceHasNoRoomTheGoodOnesKeepTheirShapes) {
  // A square of four triangles, whose middle lies past the lower side in the UV map.
  for (const double past : {0.02, 0.1}) {
    Atlas atlas =
        flat_atlas({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    const ChartRepair repair = testing::only_repair(testing::with_vertex_moved(atlas, {0.5, 0.5}, {0, -0.5 - past}));
    EXPECT_EQ(repair.what, What::Untangled);
    EXPECT_EQ(repair.faces, std::vector<int>{0});
    EXPECT_LE(repair.distortion_to_input, 1.02) << past;
  }
}

}  // namespace
}  // namespace atlas_refine
