// A chart that overlaps itself becomes injective, near its own optimum; a handle is refused.
#include "repair/re_embed.h"

#include <gtest/gtest.h>

#include "atlas_refine/error.h"
#include "charts.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

TEST(ReEmbed, UnwindsAStripThatOverlapsItself) {
  const std::vector<Chart> charts = testing::charts_of(shapes::self_overlapping());
  ASSERT_EQ(charts.size(), 1u);
  ASSERT_FALSE(certify_charts(charts).valid());
  Monitor monitor;
  const Chart embedded = re_embed(charts[0], 0, 1, monitor);
  testing::expect_certified({embedded});
  EXPECT_EQ(embedded.triangles, charts[0].triangles);
  // The strip lies as a spiral now: a little bent, not crushed.
  EXPECT_LT(dirichlet_sums(embedded).best_energy(), 1.08);
  EXPECT_NEAR(dirichlet_sums(embedded).best_scale(), 1, 0.02);
  const double far_arc = kFarArc * testing::box_sides({embedded}).norm();
  EXPECT_GT(gap_within_charts({embedded}, far_arc, 1)[0], 0.5 * 0.0025 * testing::box_sides({embedded}).norm());
}

/// A torus of quads without one of them: one boundary loop and a handle.
Atlas punctured_torus(int n) {
  Atlas atlas;
  for (int i = 0; i < n * n; ++i) atlas.positions.emplace_back(i % n, i / n, 0.3 * ((i * 7) % 5));
  atlas.face_offsets = {0};
  for (int f = 1; f < n * n; ++f) {
    const int x = f % n, y = f / n, right = (x + 1) % n, up = (y + 1) % n;
    for (const int v : {y * n + x, y * n + right, up * n + right, up * n + x}) {
      atlas.corner_vertices.push_back(v);
      atlas.corner_uvs.push_back(atlas.positions[v].head<2>());
    }
    atlas.face_offsets.push_back(atlas.corner_count());
  }
  return atlas;
}

TEST(ReEmbed, RefusesAHandleAndNamesTheChart) {
  const std::vector<Chart> charts = split_charts(punctured_torus(5), Joining::Exact).charts;
  ASSERT_EQ(charts.size(), 1u);
  Monitor monitor;
  try {
    re_embed(charts[0], 3, 1, monitor);
    FAIL() << "must throw";
  } catch (const RefineError& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadInput);
    EXPECT_EQ(error.chart(), 3);
    EXPECT_NE(std::string(error.what()).find("handle"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace atlas_refine
