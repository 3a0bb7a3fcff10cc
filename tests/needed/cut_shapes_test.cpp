// Parts of charts that overlapped themselves have the shapes back that these came with.
#include "needed/cut_shapes.h"

#include <gtest/gtest.h>

#include <numeric>

#include "charts.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "repair/repair_charts.h"
#include "seams/chart_cuts.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

/// A band wound over itself, and as it is mended.
struct Band {
  std::vector<Chart> charts = testing::charts_of(shapes::self_overlapping());
  CutAtlas mended;
  ShapesAsTheyCame shapes;

  Band() {
    Monitor monitor;
    mended = repair_charts(charts, {}, monitor).atlas;
    shapes = shapes_as_they_came(charts, mended, {0});
  }

  /// Along the shortest neck.
  CutAtlas halves() const {
    const SidePrices prices;
    ChartCuts cuts(mended.pieces[0], charts[0], prices, Cut::Split);
    const double area = uv_area(mended.pieces[0].mesh);
    EXPECT_TRUE(cuts.add(necks(cuts.border(), 0.4 * area, 1).at(0)));
    const std::vector<SurfacePath> paths = {{0, cuts.paths()[0]}};
    std::vector<int> points(charts[0].vertex_count());
    std::iota(points.begin(), points.end(), 0);
    return cut_along(divided_atlas({cuts.mesh()}, charts, {points}), charts, paths);
  }
};

TEST(ShapesAsTheyCame, MendingCostsWhatTheyTell) {
  const Band band;
  double lost = 0;
  for (const Loss& loss : band.shapes.bent[0]) lost += loss.amount;
  const double before = dirichlet_sums(band.charts).best_energy(), after = dirichlet_sums(meshes_of(band.mended)).best_energy();
  ASSERT_GT(after, before + 1e-4);
  EXPECT_NEAR(lost, after - before, 1e-9);
}

TEST(ShapesAsTheyCame, WhatCameAsALineHasNone) {
  const Band band;
  std::vector<Chart> lines = band.charts;
  for (Vec2& uv : lines[0].uvs) uv.y() *= 1e-9;
  const ShapesAsTheyCame shapes = shapes_as_they_came(lines, band.mended, {0});
  EXPECT_TRUE(shapes.uvs[0].empty());
  EXPECT_TRUE(shapes.bent[0].empty());
}

TEST(ShapesAsTheyCame, HalvesThatDoNotOverlapGetThemBack) {
  const Band band;
  ASSERT_FALSE(certify_charts(band.charts).valid());
  CutAtlas atlas = band.halves();
  ASSERT_EQ(atlas.pieces.size(), 2u);
  restore_shapes(band.shapes, atlas);
  for (const Piece& piece : atlas.pieces) {
    EXPECT_TRUE(certify_charts({piece.mesh}).valid());
    for (int v = 0; v < piece.mesh.vertex_count(); ++v)
      EXPECT_EQ(piece.mesh.uvs[v], value_at(piece.supports[v], band.charts[0].uvs));
  }
}

TEST(ShapesAsTheyCame, TheWholeStaysMended) {
  const Band band;
  CutAtlas atlas = band.mended;
  restore_shapes(band.shapes, atlas);
  EXPECT_EQ(atlas.pieces[0].mesh.uvs, band.mended.pieces[0].mesh.uvs);
}

}  // namespace
}  // namespace atlas_refine
