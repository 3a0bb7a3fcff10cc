// Embeddings of charts whose UVs are of no use: long ones, tall ones, and ones with holes.
#include "repair/embed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "charts.h"
#include "coarsen/coarse_atlas.h"
#include "geometry/tutte.h"
#include "measure/certificate.h"
#include "shapes.h"
#include "support/profile.h"

namespace atlas_refine {
namespace {

/// Columns x rows quads whose positions are `point(i, j)`; all UVs at one place but for what keeps the chart whole.
template <class Point>
Chart sheet(int columns, int rows, bool closed, const Point& point) {
  Atlas atlas;
  const int across = closed ? columns : columns + 1;
  for (int k = 0; k < across * (rows + 1); ++k) atlas.positions.push_back(point(k % across, k / across));
  atlas.face_offsets = {0};
  for (int f = 0; f < columns * rows; ++f) {
    const int i = f % columns, j = f / columns, next = (i + 1) % across;
    for (const int v : {j * across + i, j * across + next, (j + 1) * across + next, (j + 1) * across + i}) {
      atlas.corner_vertices.push_back(v);
      atlas.corner_uvs.emplace_back(v % 7, v % 5);
    }
    atlas.face_offsets.push_back(atlas.corner_count());
  }
  return testing::charts_of(atlas).at(0);
}

std::optional<Chart> embed(const Chart& chart, Shapes shapes, int threads) {
  Monitor monitor;
  const auto start = spread_out(chart, threads, monitor);
  if (!start) return std::nullopt;
  return embed(chart, *start, shapes, threads, monitor);
}

double embedded_energy(const Chart& chart) {
  const auto embedded = embed(chart, Shapes::OfSurface, 2);
  if (!embedded) return std::numeric_limits<double>::infinity();
  testing::expect_certified({*embedded});
  EXPECT_EQ(embedded->triangles, chart.triangles);
  const auto again = embed(chart, Shapes::OfSurface, 1);
  EXPECT_TRUE(testing::same_bits(embedded->uvs, again->uvs));
  return dirichlet_sums(*embedded).best_energy();
}

Vec3 on_tube(int i, int j, int around, double radius) {
  const double angle_rad = 2 * std::numbers::pi * i / around;
  return {radius * std::cos(angle_rad), radius * std::sin(angle_rad), static_cast<double>(j)};
}

TEST(Embed, ALongRibbonBecomesStraight) {
  const Chart ribbon = sheet(400, 3, false, [](int i, int j) { return Vec3(i, j, 0.3 * std::sin(0.2 * i)); });
  EXPECT_LT(embedded_energy(ribbon), 1.001);
}

TEST(Embed, ATallTubeCutOpenBecomesFlat) {
  const Chart tube = sheet(24, 300, false, [](int i, int j) { return on_tube(i, j, 24, 3.8 + 1e-3 * i); });
  EXPECT_LT(embedded_energy(tube), 1.001);
}

TEST(Embed, AFlapFarIntoAHoleIsNotDrawnIntoAPoint) {
  constexpr double kLength = 150;
  shapes::Polygon sheet = shapes::rectangle(kLength + 50, 120);
  // The border of the hole runs around the flap, which is 2 wide.
  const std::vector<Vec2> hole = {{20, 45}, {24 + kLength, 45}, {24 + kLength, 55}, {20, 55},
                                  {20, 51}, {20 + kLength, 51}, {20 + kLength, 49}, {20, 49}};
  sheet.holes.emplace_back(hole.rbegin(), hole.rend());
  const Chart chart = testing::charts_of(shapes::mesh(sheet, 1)).front();
  Chart disk = chart;
  disk.uvs = tutte_disk(chart, fill_by_fans(chart, longest_loop(chart)));
  EXPECT_FALSE(certify_charts({disk}).valid());
  EXPECT_LT(embedded_energy(chart), 1.001);
}

TEST(Embed, ATallTubeWithoutASeamBecomesARing) {
  // Fifty times as tall as its radius: Tutte's disk shrinks the far end to 1e-20.
  const Chart tube = sheet(16, 130, true, [](int i, int j) { return on_tube(i, j, 16, 2.6); });
  EXPECT_LT(embedded_energy(tube), 30);
}

TEST(Embed, BlobsOnNarrowNecksKeepTheirSizes) {
  const Chart blobs = sheet(20, 120, false, [](int i, int j) -> Vec3 {
    return on_tube(i, 0, 25, 0.15 + 3 * std::abs(std::sin(0.13 * j))) + Vec3(0, 0, 0.5 * j);
  });
  EXPECT_LT(embedded_energy(blobs), 1.1);
}

/// Columns x rows quads whose positions are `point(i, j)`, each vertex at UVs of its own.
template <class Point>
Chart grid(int columns, int rows, const Point& point) {
  Atlas atlas;
  atlas.face_offsets = {0};
  const int across = columns + 1;
  for (int v = 0; v < across * (rows + 1); ++v) atlas.positions.push_back(point(v % across, v / across));
  for (int f = 0; f < columns * rows; ++f) {
    const int v = f / columns * across + f % columns;
    for (const int corner : {v, v + 1, v + across + 1, v + across}) {
      atlas.corner_vertices.push_back(corner);
      atlas.corner_uvs.emplace_back(corner % across, corner / across);
    }
    atlas.face_offsets.push_back(atlas.corner_count());
  }
  return testing::charts_of(atlas).at(0);
}

TEST(Embed, ManyTrianglesGoDownOnCoarseOnes) {
  const Chart waves = grid(45, 45, [](int i, int j) { return Vec3(i, j, 2 * std::sin(0.1 * i)); });
  const PhaseScope scope(Phase::Other);
  take_account();
  EXPECT_LT(embedded_energy(waves), 1.001);
  EXPECT_GT(take_account().seconds[static_cast<int>(Phase::Coarsen)], 0);
}

TEST(Embed, OfManyTrianglesAllPartsHaveTheirSizesFromTheStart) {
  // Tutte's disk shrinks both ends of such a tube.
  const Chart tube = grid(30, 260, [](int i, int j) { return on_tube(i, j, 30, 4.8 + 1e-3 * i); });
  Monitor monitor;
  const auto start = spread_out(tube, 2, monitor);
  ASSERT_TRUE(start);
  testing::expect_certified({start->chart});
  EXPECT_LT(dirichlet_sums(start->chart).best_energy(), 1.01);
  ASSERT_TRUE(start->sample);
  EXPECT_EQ(start->sample->vertices, sample_of_coarse(start->chart, spacing_inside(tube.surface.area())).vertices);
}

TEST(Embed, ManyHolesStayOpen) {
  shapes::Polygon plate = shapes::rectangle(1, 1);
  for (int k = 0; k < 16; ++k) {
    const Vec2 at(0.15 + 0.23 * (k % 4), 0.15 + 0.23 * (k / 4));
    plate.holes.push_back({at, at + Vec2(0, 0.14), at + Vec2(0.02, 0.14), at + Vec2(0.02, 0)});
  }
  EXPECT_LT(embedded_energy(testing::charts_of(shapes::mesh(plate, 0.05, 0)).at(0)), 1.01);
}

TEST(Embed, ACombIsNotCrushed) {
  EXPECT_LT(embedded_energy(testing::charts_of(shapes::mesh(shapes::comb(12), 0.03, 0)).at(0)), 1.02);
}

/// A dome of quads, seen from above in the UV map: all of them are convex there.
Chart dome() {
  constexpr int n = 24;
  Atlas atlas = shapes::quad_grid(n, n);
  for (Vec3& p : atlas.positions) {
    const double x = p.x() - 0.5, y = p.y() - 0.5;
    p.z() = 1.2 * std::exp(-12 * (x * x + y * y)) + 0.1 * std::sin(23 * x + 11 * y);
  }
  return testing::charts_of(atlas).at(0);
}

TEST(Embed, QuadsThatWereConvexStayConvex) {
  const Chart chart = dome();
  ASSERT_GT(chart.guards.size(), 0u);
  const auto embedded = embed(chart, Shapes::OfSurface, 2);
  ASSERT_TRUE(embedded);
  testing::expect_certified({*embedded});
  EXPECT_EQ(embedded->guards.size(), chart.guards.size());
}

TEST(Embed, FromValidUvsTheirShapesComeBack) {
  const Chart chart = dome();
  const auto embedded = embed(chart, Shapes::OfUvs, 2);
  ASSERT_TRUE(embedded);
  EXPECT_LT(dirichlet_sums_between({chart}, {*embedded}).best_energy(), 1.0001);
}

}  // namespace
}  // namespace atlas_refine
