// Every chart comes out valid, changed as little as will do.
#include "repair/repair_charts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "atlas_refine/refine.h"
#include "charts.h"
#include "refine_checks.h"
#include "repair_checks.h"
#include "shapes.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

using What = ChartRepair::What;

TEST(RepairCharts, ValidChartsStayBitForBit) {
  const std::vector<Chart> charts = testing::charts_of(shapes::squares(5));
  const RepairedCharts out = testing::repaired(charts);
  EXPECT_TRUE(out.repairs.empty());
  for (std::size_t c = 0; c < charts.size(); ++c) EXPECT_TRUE(testing::same_bits(charts[c].uvs, out.atlas.pieces[c].mesh.uvs));
}

TEST(RepairCharts, AChartMostlyAtOnePointGetsAreas) {
  Atlas atlas = shapes::quad_grid(6, 6);
  for (std::size_t c = 0; c < atlas.corner_uvs.size(); ++c) {
    if (atlas.corner_uvs[c].x() > 0.2) atlas.corner_uvs[c] = {0.2, 0.5};
  }
  const std::vector<Chart> charts = testing::charts_of(atlas);
  ASSERT_EQ(charts.size(), 1u);
  const RepairedCharts out = testing::repaired(charts);
  ASSERT_TRUE(out.unmended.empty());
  testing::expect_certified(meshes_of(out.atlas));
  EXPECT_LT(dirichlet_sums(out.atlas.pieces[0].mesh).best_energy(), 1.5);
}

TEST(RepairCharts, AStripThatOverlapsItselfIsUnwound) {
  const std::vector<Chart> charts = testing::charts_of(shapes::self_overlapping());
  ASSERT_FALSE(certify_charts(charts).valid());
  const RepairedCharts out = testing::repaired(charts);
  ASSERT_EQ(out.repairs.size(), 1u);
  EXPECT_EQ(out.repairs[0].what, What::DrawnApart);
  EXPECT_LT(out.repairs[0].distortion_to_input, 1.08);
  const Chart& embedded = out.atlas.pieces[0].mesh;
  testing::expect_certified({embedded});
  EXPECT_EQ(embedded.triangles, charts[0].triangles);
  // The strip lies as a spiral now: a little bent, not crushed.
  EXPECT_LT(dirichlet_sums(embedded).best_energy(), 1.08);
  EXPECT_NEAR(dirichlet_sums(embedded).best_scale(), 1, 0.02);
  const double far_arc = kFarArc * testing::box_sides({embedded}).norm();
  EXPECT_GT(gap_within_charts({embedded}, far_arc, 1)[0], 0.5 * 0.0025 * testing::box_sides({embedded}).norm());
}

/// Columns x rows quads of a straight strip in space, laid in the UV map as `uv(i, j)` says.
template <class Uv>
Atlas strip_laid(int columns, int rows, const Uv& uv) {
  std::vector<Vec3> positions;
  std::vector<std::vector<int>> faces;
  for (int k = 0; k < (columns + 1) * (rows + 1); ++k) positions.emplace_back(k % (columns + 1), k / (columns + 1), 0);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i;
      faces.push_back({a, a + 1, a + columns + 2, a + columns + 1});
    }
  }
  Atlas atlas = flat_atlas(positions, faces);
  for (Vec2& corner : atlas.corner_uvs) corner = uv(corner.x(), corner.y());
  return atlas;
}

TEST(RepairCharts, EndsThatOverlapAreDrawnApartAndTheRestKeepsItsShape) {
  // A ring a little more than once around: bent by the artist, as the strip in space is straight.
  const Atlas atlas = strip_laid(60, 4, [](double i, double j) {
    const double angle_rad = 2.06 * std::numbers::pi * i / 60;
    return Vec2((10 - j) * std::cos(angle_rad), (10 - j) * std::sin(angle_rad));
  });
  const Chart before = testing::charts_of(atlas).at(0);
  const ChartRepair repair = testing::only_repair(atlas);
  EXPECT_EQ(repair.what, What::DrawnApart);
  EXPECT_LT(repair.distortion_to_input, 1.005);
  const Chart after = testing::repaired({before}).atlas.pieces[0].mesh;
  EXPECT_LT(dirichlet_sums(after).best_energy(), dirichlet_sums(before).best_energy() + 1e-3);
  EXPECT_EQ(after.guards.size(), before.guards.size());
}

TEST(RepairCharts, OverlappingUvsThatAreNoShapeToKeepAreEmbeddedAnew) {
  const Atlas atlas = strip_laid(60, 4, [](double i, double j) {
    const double angle_rad = 2.5 * std::numbers::pi * i / 60;
    return Vec2((10 - 2.4 * j) * std::cos(angle_rad), 0.2 * (10 - 2.4 * j) * std::sin(angle_rad));
  });
  const ChartRepair repair = testing::only_repair(atlas);
  EXPECT_EQ(repair.what, What::Embedded);
  EXPECT_LT(dirichlet_sums(testing::repaired(testing::charts_of(atlas)).atlas.pieces[0].mesh).best_energy(), 1.001);
}

TEST(RepairCharts, WhereChartsMayOverlapOnlyFlipsAreMended) {
  const std::vector<Chart> charts = testing::charts_of(shapes::self_overlapping());
  EXPECT_TRUE(testing::repaired(charts, {.may_overlap = true}).repairs.empty());
  const ChartRepair repair =
      testing::repaired(testing::charts_of(shapes::with_flipped_face(shapes::self_overlapping())), {.may_overlap = true})
          .repairs.at(0);
  EXPECT_EQ(repair.what, What::Untangled);
  EXPECT_LE(repair.distortion_to_input, 1.02);
}

TEST(RepairCharts, BordersWithinRoundingOfEachOtherAreParted) {
  // A square with a slit that is 1e-15 wide.
  const double half = 5e-16;
  const Atlas atlas =
      flat_atlas({{0, 0, 0}, {1, 0, 0}, {1, 0.5 - half, 0}, {0.5, 0.5, 0}, {1, 0.5 + half, 0}, {1, 1, 0}, {0, 1, 0}},
                 {{0, 1, 3}, {1, 2, 3}, {3, 4, 5}, {3, 5, 6}, {0, 3, 6}});
  const std::vector<Chart> charts = testing::charts_of(atlas);
  ASSERT_TRUE(certify_charts(charts).valid());
  const ChartRepair repair = testing::only_repair(atlas);
  EXPECT_EQ(repair.what, What::Parted);
  EXPECT_LE(repair.distortion_to_input, 1.02);
}

/// A U of quads on a wavy surface, half of its inner rows' edges with a needle of this height on them.
Atlas with_needles(double height) {
  constexpr int n = 18;
  std::vector<Vec3> positions;
  std::vector<std::vector<int>> faces;
  for (int k = 0; k < (n + 1) * (n + 1); ++k) {
    const int x = k % (n + 1), y = k / (n + 1);
    positions.emplace_back(x, y, 0.6 * std::sin(0.7 * x) * std::cos(0.5 * y));
  }
  const auto inside = [&](int i, int j) { return i < n / 3 || i >= 2 * n / 3 || j < n / 3; };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      if (!inside(i, j)) continue;
      const int a = j * (n + 1) + i, b = a + 1, d = a + n + 1, c = d + 1;
      if (j == 0 || !inside(i, j - 1) || (i + j) % 2 == 1) {
        faces.insert(faces.end(), {{a, b, c}, {a, c, d}});
        continue;
      }
      const int m = static_cast<int>(positions.size());
      positions.push_back(0.5 * (positions[a] + positions[b]) + Vec3(0, height, 0));
      faces.insert(faces.end(), {{a, b, m}, {a, m, d}, {m, b, c}, {m, c, d}});
    }
  }
  Atlas atlas = flat_atlas(positions, faces);
  for (Vec2& uv : atlas.corner_uvs) uv = {uv.x() / n + 0.02 * std::sin(0.3 * uv.y()), 0.9 * uv.y() / n};
  return atlas;
}

TEST(RepairCharts, NeedlesOfAnyHeightLeaveTheResultAlone) {
  const RefineOptions options{.pe_bound = 0.9};
  const double without = testing::refine_soundly(with_needles(0.2), options).after.distortion;
  for (const double height : {1e-3, 1e-5, 1e-6, 1e-7, 1e-8, 1e-12, 0.0}) {
    const RefineResult result = testing::refine_soundly(with_needles(height), options);
    EXPECT_NEAR(result.after.distortion - 1, without - 1, 0.1 * (without - 1)) << height;
    EXPECT_LT(result.iterations, 200) << height;
  }
}

}  // namespace
}  // namespace atlas_refine
