// The measures on atlases whose figures are known, and what must not change them.
#include "atlas_refine/measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "atlas_refine/error.h"
#include "input/split_charts.h"
#include "measure/distortion.h"
#include "shapes.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

TEST(Measures, AFlatSquare) {
  const Measures m = measure(unit_square());
  EXPECT_DOUBLE_EQ(m.pe, 1);
  EXPECT_DOUBLE_EQ(m.box_width, 1);
  EXPECT_EQ(m.chart_count, 1);
  EXPECT_EQ(m.seam_edges, 0);
  EXPECT_EQ(m.boundary_length, 0);
  EXPECT_DOUBLE_EQ(m.smallest_chart, 1);
  EXPECT_EQ(m.small_charts, 0);
  EXPECT_NEAR(m.distortion, 1, 1e-12);
  EXPECT_NEAR(m.stretch_max, 1, 1e-12);
  EXPECT_EQ(m.distortion_to_input, 1);
  EXPECT_EQ(m.gap_between, std::numeric_limits<double>::infinity());
}

TEST(Measures, TheAspectLiesBetweenOneToAHundredAndAHundredToOne) {
  EXPECT_NEAR(measure(unit_square(), 100).pe_fixed_aspect, 1, 1e-12);  // it fills the texture, whatever its aspect
  EXPECT_NEAR(measure(unit_square(), 0.01).pe_fixed_aspect, 1, 1e-12);
  for (const double aspect : {-1.0, 0.0099, 101.0, HUGE_VAL, std::nan("")}) {
    try {
      measure(unit_square(), aspect);
      ADD_FAILURE() << aspect << " was taken";
    } catch (const RefineError& error) {
      EXPECT_EQ(error.code(), ErrorCode::BadOption) << error.what();
    }
  }
}

TEST(Measures, StretchAlongOneAxis) {
  Atlas atlas = unit_square();
  for (Vec2& uv : atlas.corner_uvs) uv.x() *= 4;
  const Measures m = measure(atlas);
  // Singular values 2 and 1/2 at the best scale: (4 + 1/4 + 1/4 + 4) / 4.
  EXPECT_NEAR(m.distortion, 2.125, 1e-12);
  EXPECT_NEAR(m.stretch_max, 2, 1e-12);
  EXPECT_NEAR(m.stretch_99, 2, 1e-12);
}

TEST(Measures, TheScaleIsTheOneThatMinimises) {
  const std::vector<Chart> charts = split_charts(shapes::mesh(shapes::s_shape(), 0.1, 0.8)).charts;
  const DirichletSums sums = dirichlet_sums(charts);
  const auto energy = [&](double t) { return (t * t * sums.dirichlet + sums.inverse / (t * t)) / (4 * sums.area); };
  EXPECT_NEAR(energy(sums.best_scale()), sums.best_energy(), 1e-12);
  EXPECT_LT(sums.best_energy(), energy(1.01 * sums.best_scale()));
  EXPECT_LT(sums.best_energy(), energy(0.99 * sums.best_scale()));
}

TEST(Measures, SeamsCountOnceWithoutNaturalBoundary) {
  Atlas atlas = strip(3);
  shift_face(atlas, 1, {0, 2});
  const Measures m = measure(atlas);
  EXPECT_EQ(m.seam_edges, 2);
  EXPECT_DOUBLE_EQ(m.boundary_length, 2 / std::sqrt(10.0));
  EXPECT_EQ(m.chart_count, 3);
  EXPECT_DOUBLE_EQ(m.pe, 3.0 / 9.0);
  EXPECT_NEAR(m.smallest_chart, 1.0 / 3, 1e-12);
  EXPECT_NEAR(m.gap_between, 1 / std::sqrt(18.0), 1e-12);
}

TEST(Measures, SmallCharts) {
  const Measures m =
      measure(shapes::combine({shapes::mesh(shapes::rectangle(1, 1), 0.1),
                               shapes::mesh(shapes::transformed(shapes::rectangle(0.1, 0.1), 1, 0, {2, 0}), 0.1)}));
  EXPECT_EQ(m.small_charts, 1);
  EXPECT_NEAR(m.smallest_chart, 0.01, 0.005);
}

TEST(Measures, AFixedAspect) {
  Atlas atlas = strip(4);  // 4 x 1
  EXPECT_DOUBLE_EQ(measure(atlas, 0).pe_fixed_aspect, 1);
  EXPECT_DOUBLE_EQ(measure(atlas, 1).pe_fixed_aspect, 0.25);
  // A texture of W:H is filled by [0, 1]^2; lengths are those on the texture.
  for (Vec2& uv : atlas.corner_uvs) uv.x() *= 0.25;
  const Measures filled = measure(atlas, 4);
  EXPECT_DOUBLE_EQ(filled.pe_fixed_aspect, 1);
  EXPECT_DOUBLE_EQ(filled.unit_square_share, 1);
  EXPECT_DOUBLE_EQ(filled.distortion, 1);
  EXPECT_DOUBLE_EQ(filled.box_width, 1);
  EXPECT_GT(measure(atlas, 1).distortion, 1.5);
  for (Vec2& uv : atlas.corner_uvs) uv.y() *= 0.5;  // as a program that fills half of a 2:1 texture's square
  EXPECT_DOUBLE_EQ(measure(atlas, 2).pe_fixed_aspect, 0.5);
  EXPECT_THROW(measure(atlas, -1), RefineError);
}

TEST(Measures, AQuarterTurnAndAScaleChangeNothing) {
  const Atlas atlas = shapes::squares(12);
  Atlas turned = atlas;
  for (Vec2& uv : turned.corner_uvs) uv = Vec2(-uv.y(), uv.x()) * 8;
  const Measures a = measure(atlas), b = measure(turned);
  EXPECT_NEAR(a.pe, b.pe, 1e-12);
  EXPECT_NEAR(a.distortion, b.distortion, 1e-12);
  EXPECT_NEAR(a.stretch_99, b.stretch_99, 1e-9);
  EXPECT_NEAR(a.gap_between, b.gap_between, 1e-12);
  EXPECT_EQ(a.boundary_length, b.boundary_length);
  EXPECT_EQ(a.chart_count, b.chart_count);
}

TEST(Measures, AMirrorChangesNothing) {
  const Atlas atlas = shapes::mesh(shapes::c_shape(), 0.1, 0.7);
  const Measures a = measure(atlas), b = measure(shapes::mirrored(atlas));
  EXPECT_NEAR(a.distortion, b.distortion, 1e-12);
  EXPECT_NEAR(a.stretch_max, b.stretch_max, 1e-9);
  EXPECT_NEAR(a.pe, b.pe, 1e-12);
}

TEST(Measures, BrokenAtlasesGiveNoNaN) {
  Atlas points = strip(3);
  for (Vec2& uv : points.corner_uvs) uv = {0.5, 0.5};
  Atlas line = strip(3);
  for (Vec2& uv : line.corner_uvs) uv.y() = 0;
  Atlas flat = strip(3);
  for (Vec3& p : flat.positions) p.setZero();
  Atlas one_empty_face = strip(3);
  for (int c = 0; c < 4; ++c) one_empty_face.corner_uvs[c] = {0, 0};
  for (const Atlas& atlas : {points, line, flat, one_empty_face}) {
    const Measures m = measure(atlas);
    for (double value : {m.pe, m.pe_fixed_aspect, m.boundary_length, m.smallest_chart, m.distortion, m.stretch_99, m.stretch_max,
                         m.gap_between, m.gap_within}) {
      EXPECT_FALSE(std::isnan(value));
    }
  }
  EXPECT_NEAR(measure(one_empty_face).distortion, 1, 1e-6);  // the others are isometric
}

TEST(Distortion, E2IsOneForAScaledCopyAndMoreForABentOne) {
  const std::vector<Chart> from = split_charts(shapes::mesh(shapes::u_shape(), 0.1)).charts;
  std::vector<Chart> to = from;
  for (Vec2& uv : to[0].uvs) uv = 3 * Vec2(-uv.y(), uv.x());
  EXPECT_NEAR(dirichlet_sums_between(from, to).best_energy(), 1, 1e-12);
  for (Vec2& uv : to[0].uvs) uv.x() += 0.2 * uv.y() * uv.y();
  EXPECT_GT(dirichlet_sums_between(from, to).best_energy(), 1.0001);
}

}  // namespace
}  // namespace atlas_refine
