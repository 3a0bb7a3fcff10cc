// Kept densities where charts are too stiff for the bound: none is blown up to hold it, and what can be had is told.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "refine_checks.h"
#include "report/journal.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

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

RefineOptions keep() { return {.pe_bound = 0.8, .box_aspect = 1, .gap = Gap{0.002}, .density = Density::Keep}; }

double growth(const RefineResult& result, int chart) {
  return result.charts[chart].density_after / result.charts[chart].density_before;
}

/// How much denser the caps are than the strip, against what they were.
double growth_of_caps(const RefineResult& result) { return std::max(growth(result, 1), growth(result, 2)) / growth(result, 0); }

TEST(Densities, CapsOfAStiffPipeAreNotBlownUpToHoldTheBound) {
  for (const double length : {10.0, 20.0, 40.0}) {
    const Atlas atlas = pipe(length);
    RefineOptions options = keep();
    const RefineError error = testing::refusal(atlas, options);
    EXPECT_EQ(error.code(), ErrorCode::BoundNotReached);
    options.best_effort = true;
    const RefineResult best = refine(atlas, options);
    testing::expect_sound(atlas, best, options);
    EXPECT_FALSE(best.bound_met);
    EXPECT_LT(growth_of_caps(best), 2) << length;
    EXPECT_LT(best.after.stretch_max, 2);
    EXPECT_GT(best.after.pe_fixed_aspect, 1.3 * best.before.pe_fixed_aspect);
    const std::string said = error.what();
    EXPECT_NE(said.find(number_text("%.4f", best.after.pe_fixed_aspect)), std::string::npos) << said;
    EXPECT_NE(said.find("would grow to over 1.5 times the texel density of the others"), std::string::npos) << said;
    ASSERT_EQ(best.warnings.size(), 2U);
    EXPECT_NE(best.warnings.front().find("would grow"), std::string::npos) << best.warnings.front();
    const double times = std::max(growth(best, 1), growth(best, 2));
    EXPECT_NE(best.warnings.back().find("up to " + number_text("%.2f", times) + " times what it was"), std::string::npos)
        << best.warnings.back();
    // What it names can be had.
    EXPECT_TRUE(refine(atlas, {.pe_bound = std::floor(100 * best.after.pe_fixed_aspect) / 100,
                               .box_aspect = 1,
                               .gap = options.gap,
                               .density = Density::Keep})
                    .bound_met);
  }
}

TEST(Densities, APipeThatBendsHoldsTheBound) {
  const Atlas atlas = pipe(20, 40);
  const RefineResult result = testing::refine_soundly(atlas, keep());
  EXPECT_TRUE(result.bound_met);
  EXPECT_LT(growth_of_caps(result), 1.3);
}

TEST(Densities, ASmallerGapIsNotTriedForThem) {
  RefineOptions options = keep();
  options.gap.reset();
  options.best_effort = true;
  const RefineResult result = refine(pipe(20), options);
  EXPECT_FALSE(result.bound_met);
  EXPECT_LT(growth_of_caps(result), 2);
  EXPECT_EQ(result.gap.value, Gap{}.value);
  EXPECT_NE(result.warnings.front().find("would grow"), std::string::npos) << result.warnings.front();
}

TEST(Densities, NeededSeamsHoldTheBoundWhereChartsAreTooStiff) {
  RefineOptions options = keep();
  options.seams = Seams::Needed;
  const RefineResult result = refine(pipe(20), options);
  EXPECT_TRUE(result.bound_met);
  EXPECT_EQ(result.intervention, Intervention::Cut);
  EXPECT_LT(growth_of_caps(result), 1.5);
}

TEST(Densities, EqualOnesHoldTheBoundAtAnyPrice) {
  RefineOptions options = keep();
  options.density = Density::Equal;
  EXPECT_TRUE(testing::refine_soundly(pipe(20), options).bound_met);
}

}  // namespace
}  // namespace atlas_refine
