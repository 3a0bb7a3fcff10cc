// Kept densities where charts are too stiff for the bound: none is blown up to hold it, what is stiff stretches, and what can be
// had is told.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "refine_checks.h"
#include "report/journal.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

using testing::says;

/// A pipe of radius 0.5: a strip of `rings` quads along and eight around, and two caps of one face, all of one density.
Atlas pipe(double length, int rings = 1) {
  constexpr int kSides = 8;
  const double side = std::sin(std::numbers::pi / kSides);
  std::vector<Atlas> parts = {shapes::quad_grid(kSides, rings)};
  for (Vec2& uv : parts[0].corner_uvs) uv = {uv.x() * kSides * side, uv.y() * kSides / rings * length};
  for (std::size_t v = 0; v < parts[0].positions.size(); ++v) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(v % (kSides + 1)) / kSides;
    const double along = length * static_cast<double>(v / (kSides + 1)) / rings;
    parts[0].positions[v] = {0.5 * std::cos(angle), 0.5 * std::sin(angle), along};
  }
  Atlas cap;
  cap.face_offsets = {0, kSides};
  for (int k = 0; k < kSides; ++k) {
    const double angle = 2 * std::numbers::pi * k / kSides;
    cap.positions.emplace_back(0.5 * std::cos(angle), 0.5 * std::sin(angle), 0);
    cap.corner_vertices.push_back(k);
  }
  for (const double shift : {4.0, 6.0}) {
    parts.push_back(cap);
    for (const Vec3& p : cap.positions) parts.back().corner_uvs.emplace_back(p.x() + shift, p.y() + 0.5);
  }
  return shapes::combine(parts);
}

/// One for each face of such a pipe: its strip is to keep its shape.
std::vector<char> strip_only() { return {1, 1, 1, 1, 1, 1, 1, 1, 0, 0}; }

RefineOptions keep() { return {.pe_bound = 0.8, .box_aspect = 1, .gap = Gap{0.002}, .density = Density::Keep}; }

double growth(const RefineResult& result, int chart) {
  return result.charts[chart].density_after / result.charts[chart].density_before;
}

/// How much denser the caps are than the strip, against what they were.
double growth_of_caps(const RefineResult& result) { return std::max(growth(result, 1), growth(result, 2)) / growth(result, 0); }

TEST(Densities, CapsOfAStiffPipeAreNotBlownUpToHoldTheBound) {
  for (const double length : {10.0, 20.0, 40.0}) {
    const RefineResult result = testing::refine_soundly(pipe(length), keep());
    EXPECT_TRUE(result.bound_met);
    EXPECT_LT(growth_of_caps(result), 1.02) << length;
    EXPECT_LT(result.after.distortion, 0.15 * length);  // of a strip of that length and 3, which is stretched to a square
    EXPECT_TRUE(says(result.warnings, "2 charts kept their shapes")) << length;
  }
}

/// A quad of that size.
Atlas plank(double width, double height, const Vec2& corner) {
  Atlas out = shapes::quad_grid(1, 1);
  for (Vec3& p : out.positions) p = {width * p.x(), height * p.y(), 0};
  for (Vec2& uv : out.corner_uvs) uv = Vec2(width * uv.x(), height * uv.y()) + corner;
  return out;
}

TEST(Densities, ChartsThatGrowInPlaceOfOthersAreHeldAsWell) {
  std::vector<Atlas> parts = {plank(1, 16, {0, 0})};
  for (int k = 0; k < 12; ++k) parts.push_back(plank(0.5, 0.5, {2.0 + k, 0}));
  const Atlas atlas = shapes::combine(parts);
  const RefineResult result = testing::refine_soundly(atlas, keep());
  EXPECT_TRUE(result.bound_met);
  EXPECT_TRUE(says(result.warnings, "12 charts kept their shapes"));
  for (const int threads : {2, 8}) {
    RefineOptions options = keep();
    options.threads = threads;
    EXPECT_EQ(refine(atlas, options).corner_uvs, result.corner_uvs) << threads;
  }
}

/// What is told where the bound is refused, and the best that is written all the same.
struct Refused {
  std::string said;
  RefineResult best;
};

/// Checks that it is refused, naming the best, and that what it names can be had.
Refused refused(const Atlas& atlas, RefineOptions options) {
  const RefineError error = testing::refusal(atlas, options);
  EXPECT_EQ(error.code(), ErrorCode::BoundNotReached);
  options.best_effort = true;
  Refused out{error.what(), refine(atlas, options)};
  testing::expect_sound(atlas, out.best, options);
  EXPECT_FALSE(out.best.bound_met);
  EXPECT_NE(out.said.find(number_text("%.4f", out.best.after.pe_fixed_aspect)), std::string::npos) << out.said;
  options.best_effort = false;
  options.pe_bound = std::floor(100 * out.best.after.pe_fixed_aspect) / 100;
  EXPECT_TRUE(refine(atlas, options).bound_met);
  return out;
}

TEST(Densities, WithinALimitTheBestThatKeepsThemIsTold) {
  for (const double length : {10.0, 20.0}) {
    RefineOptions options = keep();
    options.max_distortion = 1.2;
    EXPECT_LT(growth_of_caps(refused(pipe(length), options).best), 1.02) << length;
  }
}

TEST(Densities, CapsAreNotBlownUpBesideAStripThatIsNotToStretch) {
  for (const double length : {10.0, 20.0, 40.0}) {
    RefineOptions options = keep();
    options.keep_shape = strip_only();
    const auto [said, best] = refused(pipe(length), options);
    EXPECT_LT(growth_of_caps(best), 2) << length;
    EXPECT_LT(best.after.stretch_max, 2);
    EXPECT_GT(best.after.pe_fixed_aspect, 1.1 * best.before.pe_fixed_aspect);
    EXPECT_NE(said.find("would grow to over 1.5 times the texel density of the others"), std::string::npos) << said;
    ASSERT_EQ(best.warnings.size(), 2U);
    EXPECT_NE(best.warnings.front().find("would grow"), std::string::npos) << best.warnings.front();
    const std::string times = number_text("%.2f", growth_of_caps(best));
    EXPECT_NE(best.warnings.back().find("up to " + times + " times what it was"), std::string::npos) << best.warnings.back();
  }
}

/// Nine sheets side by side, one vertex on the border of the first dragged away.
Atlas with_stray_vertex(const Vec2& to) {
  std::vector<Atlas> parts;
  for (int k = 0; k < 9; ++k) {
    parts.push_back(shapes::quad_grid(6, 6));
    for (Vec2& uv : parts.back().corner_uvs) uv += Vec2(1.2 * k, 0);
  }
  Atlas out = shapes::combine(parts);
  const Vec2 corner = out.corner_uvs.front();
  for (int c = 0; c < out.face_offsets[36]; ++c) {
    if (out.corner_uvs[c] == corner) out.corner_uvs[c] = to;
  }
  return out;
}

TEST(Densities, AStrayVertexTellsNothingOfItsChartsDensity) {
  for (const double far : {-3.0, -50.0, -1e5}) {
    const RefineResult result = testing::refine_soundly(with_stray_vertex({far, far}), keep());
    double least = 1e9, most = 0;
    for (const ChartReport& chart : result.charts) {
      least = std::min(least, chart.density_after);
      most = std::max(most, chart.density_after);
    }
    EXPECT_LT(most, 1.1 * least) << far;
    for (const std::string& warning : result.warnings) {
      if (warning.find("texel density") != std::string::npos) EXPECT_EQ(warning.find("chart 0"), 0U) << warning;
    }
  }
}

TEST(Densities, WhereEqualOnesCannotBeHadThatIsTold) {
  RefineOptions options = keep();
  options.density = Density::Equal;
  EXPECT_TRUE(says(testing::refine_soundly(pipe(20), options).warnings, "times that of the others"));
  EXPECT_FALSE(says(testing::refine_soundly(pipe(2), options).warnings, "times that of the others"));
}

TEST(Densities, ASmallerGapIsNotTriedForThem) {
  RefineOptions options = keep();
  options.gap.reset();
  options.best_effort = true;
  options.keep_shape = strip_only();
  const RefineResult result = refine(pipe(20), options);
  EXPECT_FALSE(result.bound_met);
  EXPECT_LT(growth_of_caps(result), 2);
  EXPECT_EQ(result.gap.value, Gap{}.value);
  EXPECT_NE(result.warnings.front().find("would grow"), std::string::npos) << result.warnings.front();
}

TEST(Densities, APipeThatBendsHoldsTheBound) {
  const Atlas atlas = pipe(20, 40);
  const RefineResult result = testing::refine_soundly(atlas, keep());
  EXPECT_TRUE(result.bound_met);
  EXPECT_LT(growth_of_caps(result), 1.3);
  EXPECT_FALSE(says(result.warnings, "kept their shapes"));
}

TEST(Densities, NeededSeamsHoldTheBoundWhereChartsAreTooStiff) {
  RefineOptions options = keep();
  options.seams = Seams::Needed;
  const RefineResult result = refine(pipe(20), options);
  EXPECT_TRUE(result.bound_met);
  EXPECT_EQ(result.intervention, Intervention::Cut);
  EXPECT_LT(growth_of_caps(result), 1.5);
}

/// The layout that it is stretched into is no place to go on from.
TEST(Densities, ACutAcrossAStiffPipeAmongOtherChartsIsFound) {
  std::vector<Atlas> parts = {pipe(12, 2)};
  for (int k = 0; k < 8; ++k) parts.push_back(plank(0.3, 0.3, {8.0 + k, 0}));
  RefineOptions options = keep();
  options.seams = Seams::Needed;
  const RefineResult result = refine(shapes::combine(parts), options);
  EXPECT_TRUE(result.bound_met);
  EXPECT_LT(result.after.distortion, 1.05);
  EXPECT_LT(result.boundary_growth, 0.2);
}

TEST(Densities, OfAStiffPipeTheTradeOffListsCutsAcross) {
  RefineOptions options = keep();
  options.seams = Seams::Needed;
  options.trade_off = true;
  const CutReport cuts = *refine(pipe(20), options).cuts;
  ASSERT_GE(cuts.trade_off.size(), 2U);
  EXPECT_GT(cuts.trade_off.front().distortion, 2);
  EXPECT_LT(cuts.trade_off.back().distortion, 1.2);
  options.point = static_cast<int>(cuts.trade_off.size()) - 1;
  EXPECT_EQ(refine(pipe(20), options).after.distortion, cuts.trade_off.back().distortion);
}

TEST(Densities, EqualOnesHoldTheBoundAtAnyPrice) {
  RefineOptions options = keep();
  options.density = Density::Equal;
  EXPECT_TRUE(testing::refine_soundly(pipe(20), options).bound_met);
}

}  // namespace
}  // namespace atlas_refine
