// Which road a search for needed seams ends on: bending alone, few cuts, a cut in each of many charts, or rectangles.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "output_checks.h"
#include "polygon_sheets.h"
#include "shapes.h"
#include "sheets.h"

namespace atlas_refine {
namespace {

RefineOptions needed() {
  RefineOptions options;
  options.seams = Seams::Needed;
  return options;
}

RefineResult refine_soundly(const Atlas& atlas, const RefineOptions& options) {
  RefineResult result = refine(atlas, options);
  testing::expect_sound_output(atlas, result, options);
  return result;
}

/// A strip whose quads are unlike in the UV map, which it fills.
Atlas uneven_strip() {
  Atlas atlas = sheet(8, 2);
  for (Vec2& uv : atlas.corner_uvs) uv.x() = uv.x() < 0.4 ? 0.25 * uv.x() : 0.1 + 1.5 * (uv.x() - 0.4);
  return atlas;
}

TEST(CutAsNeeded, WhatBendingAloneKeepsTakesNoSeam) {
  const Atlas atlas = uneven_strip();
  RefineOptions options = needed();
  options.max_distortion = 1.01;
  const RefineResult result = refine_soundly(atlas, options);
  EXPECT_GT(result.before.distortion, 1.2);
  EXPECT_LT(result.after.distortion, 1.01);
  EXPECT_EQ(result.boundary_growth, 0);
}

TEST(CutAsNeeded, WhereNoCutPaysAnAtlasThatHoldsTheBoundIsLeft) {
  const Atlas atlas = uneven_strip();
  RefineOptions options = needed();
  const RefineResult result = refine(atlas, options);
  EXPECT_EQ(result.intervention, Intervention::Unchanged);
  EXPECT_EQ(result.corner_uvs, atlas.corner_uvs);
  options.trade_off = true;
  const RefineResult listed = refine(atlas, options);
  ASSERT_TRUE(listed.cuts);
  ASSERT_FALSE(listed.cuts->trade_off.empty());
  EXPECT_LT(listed.cuts->trade_off.front().distortion, 1.01);  // bent, without a cut
  EXPECT_EQ(listed.cuts->trade_off.front().cuts, 0);
}

TEST(CutAsNeeded, AnAtlasThatHoldsTheBoundIsCutWhereThatPays) {
  // An arc that fills its box, squeezed by hand to a square: what it lacks is a seam.
  Atlas atlas = bent_into_arc(sheet(24, 3), 5);
  RefineOptions squeeze;
  squeeze.box_aspect = 1;
  atlas.corner_uvs = refine(atlas, squeeze).corner_uvs;
  RefineOptions options = needed();
  options.box_aspect = 1;
  const RefineResult result = refine_soundly(atlas, options);
  EXPECT_EQ(result.intervention, Intervention::Cut);
  EXPECT_LT(result.after.distortion + options.seam_cost * result.boundary_growth, result.before.distortion);
}

/// The letter H, of cells.
Atlas letter_h() {
  return testing::quads(testing::cells_where(6, [](int x, int y) { return x < 2 || x >= 4 || (y >= 2 && y < 4); }));
}

TEST(CutAsNeeded, SmallAtlasesTakeNoMoreThanTheirRectangles) {
  for (const Atlas& atlas : {letter_h(), shapes::mesh(shapes::s_shape(), 0.1, 0), shapes::mesh(shapes::comb(4), 0.1, 0)}) {
    RefineOptions all;
    all.seams = Seams::Rectangles;
    const RefineResult rectangles = refine(atlas, all);
    RefineOptions options = needed();
    options.max_distortion = rectangles.after.distortion + 1e-6;
    EXPECT_LE(refine_soundly(atlas, options).boundary_growth, 1.02 * rectangles.boundary_growth);
    options.max_distortion.reset();
    const RefineResult paid = refine_soundly(atlas, options);
    EXPECT_LT(paid.after.distortion + options.seam_cost * paid.boundary_growth,
              rectangles.after.distortion + options.seam_cost * rectangles.boundary_growth + 1e-3);
  }
}

TEST(CutAsNeeded, WhereRectanglesTakeFewerSeamsTheyAreTheResult) {
  RefineOptions options = needed();
  options.max_distortion = 1.00001;
  const RefineResult result = refine_soundly(letter_h(), options);
  EXPECT_LE(result.after.distortion, 1.00001);
  ASSERT_TRUE(result.rectangles.has_value());
  EXPECT_EQ(result.cuts->cuts, result.rectangles->trails);
  ASSERT_EQ(result.fallbacks.size(), 1U);
  EXPECT_NE(result.fallbacks[0].find("cut into rectangles"), std::string::npos);
}

/// Bowls of so many sides and rings around a pole, their UVs seen from above.
Atlas bowls(int count, int sides = 6, int rings = 3) {
  std::vector<Atlas> parts;
  for (int n = 0; n < count; ++n) {
    std::vector<Vec3> positions = {{0, 0, 0}};
    std::vector<std::vector<int>> faces;
    for (int r = 1; r <= rings; ++r) {
      const double tilt = 0.5 * std::numbers::pi * r / rings;
      for (int k = 0; k < sides; ++k) {
        const double angle = 2 * std::numbers::pi * k / sides;
        positions.emplace_back(std::sin(tilt) * std::cos(angle), std::sin(tilt) * std::sin(angle), 1 - std::cos(tilt));
      }
    }
    const auto at = [sides](int r, int k) { return r == 0 ? 0 : 1 + (r - 1) * sides + k % sides; };
    for (int k = 0; k < sides; ++k) {
      faces.push_back({at(0, 0), at(1, k), at(1, k + 1)});
      for (int r = 1; r < rings; ++r) faces.push_back({at(r, k), at(r + 1, k), at(r + 1, k + 1), at(r, k + 1)});
    }
    parts.push_back(flat_atlas(positions, faces));
    for (int c = 0; c < parts.back().corner_count(); ++c) {
      const Vec3& p = positions[parts.back().corner_vertices[c]];
      const double away = std::hypot(p.x(), p.y()), tilt = std::acos(1 - p.z());
      parts.back().corner_uvs[c] = (away > 0 ? tilt / away : 1) * p.head<2>() + Vec2(4 * n, 0);
    }
  }
  return shapes::combine(parts);
}

TEST(CutAsNeeded, ABowlIsSlitAsFarAsTheBudgetAllows) {
  const Atlas atlas = bowls(1, 16, 6);
  RefineOptions options = needed();
  options.seam_cost = 0;
  double before = refine(atlas, {.relax = true}).after.distortion, way = 0;
  for (const double budget : {0.4, 0.8, 1.2}) {
    options.max_boundary_growth = budget;
    const RefineResult result = refine_soundly(atlas, options);
    EXPECT_GT(result.boundary_growth, way) << budget;
    EXPECT_LT(result.after.distortion - 1, 0.75 * (before - 1)) << budget;
    before = result.after.distortion;
    way = result.boundary_growth;
  }
}

TEST(CutAsNeeded, ManyEqualChartsAreCutTogether) {
  RefineOptions one = needed();
  one.max_distortion = 1.08;
  const RefineResult single = refine_soundly(bowls(1), one);
  ASSERT_GT(single.boundary_growth, 0);
  for (const int count : {20, 40}) {
    const RefineResult result = refine_soundly(bowls(count), one);
    EXPECT_LE(result.after.distortion, 1.08);
    EXPECT_LT(result.boundary_growth, 1.1 * single.boundary_growth) << count;
    EXPECT_LT(result.cuts->tried, 96) << count;
    RefineOptions two = one;
    two.threads = 2;
    EXPECT_EQ(refine(bowls(count), two).corner_uvs, result.corner_uvs);
  }
}

}  // namespace
}  // namespace atlas_refine
