// A polygon that has become concave is mended, and only around it.
#include "repair/convex_again.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "charts.h"
#include "geometry/guards.h"
#include "geometry/rest_triangle.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

/// Cells of six corners, one corner of an inner cell pulled in so far that the cell is concave, yet its triangles stay positive.
Chart with_dent() {
  Chart chart = testing::charts_of(shapes::honeycomb(8, 8)).at(0);
  const Vec2 middle = chart.uvs[chart.guards[chart.guards.size() / 2].triangle[0]];
  const int v = chart.guards[chart.guards.size() / 2].triangle[1];
  for (double part = 0.1; part < 1 && all_guards_hold(chart); part += 0.1) {
    Chart dented = chart;
    dented.uvs[v] += part * (middle - dented.uvs[v]);
    if (!certify_charts({dented}).valid()) break;
    chart = dented;
  }
  return chart;
}

TEST(ConvexAgain, ADentIsTakenOutAndNothingFarMoves) {
  const Chart dented = with_dent();
  ASSERT_FALSE(all_guards_hold(dented));
  Monitor monitor;
  const Chart mended = convex_again(dented, false, 1, monitor);
  EXPECT_TRUE(all_guards_hold(mended));
  testing::expect_certified({mended});
  int moved = 0;
  for (int v = 0; v < dented.vertex_count(); ++v) moved += mended.uvs[v] != dented.uvs[v];
  EXPECT_GT(moved, 0);
  EXPECT_LT(moved, dented.vertex_count() / 2);
  EXPECT_TRUE(testing::same_bits(mended.uvs, convex_again(dented, false, 2, monitor).uvs));
}

/// E_2 over the triangles of polygons that were convex before.
double distortion_of_convex(const Chart& before, const Chart& after) {
  Chart held = before;
  drop_broken_guards(held);
  std::vector<Triangle> triangles;
  std::vector<RestTriangle> shapes;
  for (std::size_t t = 0; t < before.triangles.size(); ++t) {
    const Triangle& v = before.triangles[t];
    const auto of_face = [&](const Guard& guard) { return guard.face == before.triangle_faces[t]; };
    if (std::none_of(held.guards.begin(), held.guards.end(), of_face)) continue;
    triangles.push_back(v);
    shapes.push_back(rest_from_plane(before.uvs[v[0]], before.uvs[v[1]], before.uvs[v[2]], 1));
  }
  EXPECT_LT(triangles.size(), before.triangles.size());
  return dirichlet_sums(shapes, triangles, after.uvs).best_energy();
}

TEST(ConvexAgain, APolygonThatNothingMendsDoesNotKeepOthersFromIt) {
  Chart dented = with_dent();
  const auto& [a, b, c] = dented.triangles.front();
  const int face = dented.triangle_faces.front();
  const auto of_face = [&](const Guard& guard) { return guard.face == face; };
  std::find_if(dented.guards.begin(), dented.guards.end(), of_face)->triangle = {b, a, c};  // positive under no UVs
  Monitor monitor;
  Chart mended = convex_again(dented, false, 1, monitor);
  EXPECT_FALSE(all_guards_hold(mended));
  std::erase_if(mended.guards, of_face);
  EXPECT_TRUE(all_guards_hold(mended));
  testing::expect_certified({mended});
}

/// The chart with one more sheet of the same shape on itself, as a chart that runs around more than once has.
Chart doubled(const Chart& chart) {
  Chart out = chart;
  const int vertices = chart.vertex_count();
  std::vector<RestTriangle> surface(chart.surface.begin(), chart.surface.end());
  surface.insert(surface.end(), chart.surface.begin(), chart.surface.end());
  out.surface = Surface(std::move(surface));
  out.uvs.insert(out.uvs.end(), chart.uvs.begin(), chart.uvs.end());
  const int faces = chart.triangle_faces.back() + 1;
  for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
    const auto& [a, b, c] = chart.triangles[t];
    out.triangles.push_back({a + vertices, b + vertices, c + vertices});
    out.triangle_faces.push_back(chart.triangle_faces[t] + faces);
  }
  for (Guard guard : chart.guards) {
    for (int& v : guard.triangle) v += vertices;
    guard.face += faces;
    out.guards.push_back(guard);
  }
  for (std::vector<int> loop : chart.boundary_loops) {
    for (int& v : loop) v += vertices;
    out.boundary_loops.push_back(loop);
  }
  return out;
}

TEST(ConvexAgain, ChartsThatMayOverlapAreMendedToo) {
  const Chart dented = doubled(with_dent());
  Monitor monitor;
  EXPECT_FALSE(all_guards_hold(convex_again(dented, false, 1, monitor)));
  EXPECT_TRUE(all_guards_hold(convex_again(dented, true, 1, monitor)));
}

TEST(ConvexAgain, FacesThatHoldKeepTheShapesOfTheirUvs) {
  // Three times as wide as the surface: the artist's will.
  Chart dented = with_dent();
  for (Vec2& uv : dented.uvs) uv.x() *= 3;
  ASSERT_FALSE(all_guards_hold(dented));
  Monitor monitor;
  const Chart mended = convex_again(dented, false, 1, monitor);
  EXPECT_TRUE(all_guards_hold(mended));
  EXPECT_LT(distortion_of_convex(dented, mended), 1.01);
}

TEST(ConvexAgain, WhatIsConvexStaysBitForBit) {
  const Chart chart = testing::charts_of(shapes::honeycomb(4, 4)).at(0);
  Monitor monitor;
  EXPECT_TRUE(testing::same_bits(convex_again(chart, false, 1, monitor).uvs, chart.uvs));
}

}  // namespace
}  // namespace atlas_refine
