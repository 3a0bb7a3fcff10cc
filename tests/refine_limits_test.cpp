// What the options promise: limits on the surface, texel density, importance, relaxing, textures that are not square.
#include <algorithm>
#include <cmath>

#include "charts.h"
#include "refine_checks.h"
#include "report/journal.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

using testing::refine_soundly;
using testing::with_corner_uvs;

Atlas at_scale(Atlas atlas, double scale, const Vec2& shift = Vec2::Zero()) {
  for (Vec2& uv : atlas.corner_uvs) uv = scale * uv + shift;
  return atlas;
}

/// A cap of the unit sphere, seen from above: no flattening gets below E_d 1.001.
Atlas dome() {
  Atlas atlas = shapes::mesh(shapes::disk(0.8), 0.12, 0);
  for (Vec3& p : atlas.positions) p.z() = std::sqrt(1 - p.x() * p.x() - p.y() * p.y());
  return atlas;
}

double area_ratio(const Atlas& atlas, const RefineResult& result) {
  const auto charts = testing::charts_of(with_corner_uvs(atlas, result.corner_uvs));
  return uv_area(charts[1]) / uv_area(charts[0]);
}

// ---- the largest distortion ----

TEST(Limits, TheLargestDistortionCountsOnTheSurfaceWhateverTheDensity) {
  for (const Density density : {Density::Equal, Density::Keep}) {
    RefineOptions options{.pe_bound = 0.5, .max_distortion = 1.001, .density = density};
    const RefineError error = testing::refusal(dome(), options);
    EXPECT_EQ(error.code(), ErrorCode::BoundNotReached);
    EXPECT_NE(std::string(error.what()).find("no atlas within a distortion of 1.001"), std::string::npos) << error.what();
    options.best_effort = true;  // takes a missed bound, not a missed limit
    EXPECT_EQ(testing::refusal(dome(), options).code(), ErrorCode::BoundNotReached);
  }
}

TEST(Limits, TheLargestStretchIsThatOfNinetyNinePerCentOfTheSurface) {
  const Atlas atlas = shapes::mesh(shapes::comb(), 0.08);
  const double free = refine(atlas, {}).after.stretch_99;
  const RefineResult within = refine_soundly(atlas, {.max_stretch = free + 0.01});
  EXPECT_GT(within.after.stretch_max, free + 0.01);  // the worst triangle does not count
  RefineOptions options{.max_stretch = 1 + 0.5 * (free - 1)};
  const RefineError error = testing::refusal(atlas, options);
  EXPECT_EQ(error.code(), ErrorCode::BoundNotReached);
  options.best_effort = true;
  const RefineResult best = refine(atlas, options);
  EXPECT_FALSE(best.bound_met);
  EXPECT_LE(best.after.stretch_99, *options.max_stretch * (1 + 1e-5));
  EXPECT_GT(best.after.pe, best.before.pe);
  for (const std::string& named : {number_text("%.4f", best.after.pe), number_text("%.4f", best.after.stretch_99)})
    EXPECT_NE(std::string(error.what()).find(named), std::string::npos) << error.what() << " does not name " << named;
}

TEST(Limits, AStretchThatIsKeptAnywayChangesNothing) {
  const std::vector<Atlas> atlases = {shapes::mesh(shapes::comb(), 0.08), shapes::mesh(shapes::star(), 0.05, 0.5), dome(),
                                      shapes::mesh(shapes::random_polygon(3), 0.1)};
  for (const Seams seams : {Seams::None, Seams::Rectangles}) {
    for (std::size_t k = 0; k < atlases.size(); ++k) {
      SCOPED_TRACE("atlas " + std::to_string(k));
      RefineOptions options{.seams = seams};
      const RefineResult free = refine(atlases[k], options);
      options.max_stretch = 1.0005 * free.after.stretch_99;
      const RefineResult limited = refine(atlases[k], options);
      EXPECT_TRUE(testing::same_bits(free.corner_uvs, limited.corner_uvs));
      EXPECT_EQ(free.gap.value, limited.gap.value);
    }
  }
}

TEST(Limits, AnAtlasAtTheBoundIsNotLeftWithMoreStretchThanIsAllowed) {
  EXPECT_EQ(refine(dome(), {.pe_bound = 0.3}).intervention, Intervention::Unchanged);
  EXPECT_EQ(testing::refusal(dome(), {.pe_bound = 0.3, .max_stretch = 1.001}).code(), ErrorCode::BoundNotReached);
}

TEST(Limits, ChartsThatJamAreNotCrushedForTheBestPe) {
  RefineOptions options{.pe_bound = 0.96, .gap = Gap{0.02}};
  const Atlas atlas = shapes::squares(9);
  const std::string message = testing::refusal(atlas, options).what();
  options.best_effort = true;
  const RefineResult best = refine(atlas, options);
  EXPECT_FALSE(best.bound_met);
  EXPECT_LE(best.after.distortion, 1.5);
  EXPECT_NE(message.find(number_text("%.4f", best.after.pe) + " at E_d " + number_text("%.4f", best.after.distortion)),
            std::string::npos)
      << message;
}

TEST(Limits, TheBestPeIsNamedWithinTheLimit) {
  const Atlas atlas = shapes::mesh(shapes::comb(), 0.08);
  RefineOptions options{.pe_bound = 0.97, .max_distortion = 1.02};
  const std::string message = testing::refusal(atlas, options).what();
  options.best_effort = true;
  const RefineResult best = refine(atlas, options);
  EXPECT_FALSE(best.bound_met);
  EXPECT_LE(best.after.distortion, 1.02);
  EXPECT_EQ(best.ended, Ended::DistortionLimit);
  char pe[32];
  std::snprintf(pe, sizeof pe, "%.4f", best.after.pe);
  EXPECT_NE(message.find(pe), std::string::npos) << message << " does not name " << pe;
  // That much is really to be had.
  refine_soundly(atlas, {.pe_bound = best.after.pe - 0.005, .max_distortion = 1.02});
}

/// A fallback that holds this text.
bool fell_back(const RefineResult& result, const std::string& text) {
  return std::any_of(result.fallbacks.begin(), result.fallbacks.end(),
                     [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

TEST(Limits, TheRoadThatCutsSaysThatItMissedTheLimit) {
  RefineOptions options{.pe_bound = 0.97, .seams = Seams::Rectangles, .max_distortion = 1.002, .best_effort = true};
  const RefineResult result = refine(shapes::mesh(shapes::c_shape(), 0.1), options);
  EXPECT_FALSE(result.bound_met);
  EXPECT_LE(result.after.distortion, 1.002);
  EXPECT_TRUE(fell_back(result, "stay above the largest") || fell_back(result, "do not reach the bound"));
}

TEST(Limits, ChartsThatAreBoxedAndOverlapThemselvesAreEmbeddedFirst) {
  // Twelve triangles of 150 degrees round one vertex, five turns that lie on each other: no way of aligning them is worth it.
  Atlas fan;
  fan.positions = {{0, 0, 0}};
  fan.face_offsets = {0};
  for (int k = 0; k <= 12; ++k) {
    const double uv = 150 * k * std::acos(-1.0) / 180;
    fan.positions.emplace_back(std::cos(0.1 * uv), std::sin(0.1 * uv), 0.1 * k);
  }
  const auto uv_of = [](int v) -> Vec2 {
    const double angle = 150 * (v - 1) * std::acos(-1.0) / 180;
    return v == 0 ? Vec2(0, 0) : Vec2(std::cos(angle), std::sin(angle));
  };
  for (int k = 1; k <= 12; ++k) {
    for (const int v : {0, k, k + 1}) {
      fan.corner_vertices.push_back(v);
      fan.corner_uvs.push_back(uv_of(v));
    }
    fan.face_offsets.push_back(fan.corner_count());
  }
  const Atlas atlas = shapes::combine({fan, at_scale(shapes::mesh(shapes::u_shape(), 0.1), 1, {5, 0})});
  const RefineResult result = refine(atlas, {.pe_bound = 0.5, .seams = Seams::Rectangles});
  EXPECT_TRUE(result.charts[0].re_embedded);
  EXPECT_EQ(std::count_if(result.repairs.begin(), result.repairs.end(),
                          [](const Repair& repair) { return repair.what.find("embedded anew") != std::string::npos; }),
            1);
}

TEST(Limits, FacesWoundBothWaysAreNotMirrored) {
  for (const int reversed : {10, 50, 90}) {
    Atlas atlas = shapes::quad_grid(10, 10);
    for (Vec2& uv : atlas.corner_uvs) uv = {uv.x() * (1 + 0.4 * uv.y()), uv.y()};
    for (int f = 0; f < reversed; ++f) {
      const int begin = atlas.face_offsets[f], end = atlas.face_offsets[f + 1];
      std::reverse(atlas.corner_vertices.begin() + begin, atlas.corner_vertices.begin() + end);
      std::reverse(atlas.corner_uvs.begin() + begin, atlas.corner_uvs.begin() + end);
    }
    for (const Seams seams : {Seams::None, Seams::Rectangles}) {
      const RefineResult result = refine(atlas, {.pe_bound = 0.97, .seams = seams});
      EXPECT_TRUE(result.bound_met);
      EXPECT_FALSE(result.charts[0].mirrored);
    }
  }
}

// ---- importance, reference, density ----

TEST(Limits, UniformImportanceChangesNothing) {
  const Atlas atlas = shapes::mesh(shapes::s_shape(), 0.08);
  const RefineResult plain = refine_soundly(atlas, {});
  for (const double weight : {1e-4, 1e6}) {
    RefineOptions options;
    options.importance.assign(atlas.face_count(), weight);
    const RefineResult result = refine_soundly(atlas, options);
    EXPECT_NEAR(result.iterations, plain.iterations, 2);
    EXPECT_NEAR(result.after.distortion, plain.after.distortion, 1e-6);
    EXPECT_EQ(result.gap.value, plain.gap.value);
  }
}

TEST(Limits, TheInputAsReferenceDoesNotDecideTheDensity) {
  const Atlas atlas =
      shapes::combine({shapes::mesh(shapes::star(), 0.1, 0), at_scale(shapes::mesh(shapes::c_shape(), 0.1, 0), 3, {2, 0})});
  const auto ratio = [&](Reference reference, Density density) {
    return area_ratio(atlas, refine_soundly(atlas, {.density = density, .reference = reference}));
  };
  EXPECT_NEAR(ratio(Reference::Input, Density::Equal), ratio(Reference::Surface, Density::Equal), 0.1);
  EXPECT_NEAR(ratio(Reference::Input, Density::Keep), ratio(Reference::Surface, Density::Keep), 0.6);
  EXPECT_LT(refine_soundly(atlas, {.reference = Reference::Input}).after.distortion, 1.05);
}

TEST(Limits, KeptDensityOutlivesANewEmbedding) {
  for (const double model_scale : {1.0, 100.0}) {
    Atlas atlas = shapes::combine({shapes::mesh(shapes::star(), 0.1), at_scale(shapes::self_overlapping(), 0.2, {3, 0})});
    for (Vec3& p : atlas.positions) p *= model_scale;
    const RefineResult result = refine_soundly(atlas, {.pe_bound = 0.7, .density = Density::Keep});
    ASSERT_TRUE(result.charts[1].re_embedded);
    for (const ChartReport& chart : result.charts) EXPECT_NEAR(chart.density_after / chart.density_before, 1, 0.08);
  }
}

TEST(Limits, KeptDensityHoldsOnTheRoadThatCuts) {
  const Atlas atlas =
      shapes::combine({shapes::mesh(shapes::star(), 0.1), at_scale(shapes::mesh(shapes::u_shape(), 0.1), 3, {9, 0})});
  for (const bool until_input : {false, true}) {
    RefineOptions options{.seams = Seams::Rectangles, .density = Density::Keep};
    options.rectangles.until_input = until_input;
    const RefineResult result = refine(atlas, options);
    for (const ChartReport& chart : result.charts) EXPECT_NEAR(chart.density_after / chart.density_before, 1, 0.1);
  }
}

TEST(Limits, WhereBendingChangesAKeptDensityAWarningSaysSo) {
  // A lone triangle weighs next to nothing beside a C of four times its density: it is blown up to fill a void.
  const Atlas triangle = at_scale(shapes::mesh(shapes::Polygon{{{0, 0}, {0.4, 0}, {0, 0.4}}, {}}, 1, 0), 0.25, {3, 3});
  const RefineResult result = refine_soundly(shapes::combine({triangle, shapes::mesh(shapes::c_shape(), 0.1)}),
                                             {.pe_bound = 0.9, .density = Density::Keep});
  double most = 0;
  for (const ChartReport& chart : result.charts) most = std::max(most, std::abs(chart.density_after / chart.density_before - 1));
  const bool says = std::any_of(result.warnings.begin(), result.warnings.end(),
                                [](const std::string& line) { return line.find("texel density") != std::string::npos; });
  EXPECT_EQ(says, most > 0.1);
}

TEST(Limits, AChartOfHighDensityGrowsNoMoreThanOthers) {
  // It weighs what it takes of the texture, not the twenty-fifth of that which it has on the surface.
  const Atlas dense = at_scale(shapes::mesh(shapes::rectangle(0.06, 0.06), 0.015), 5, {3, 0});
  const RefineResult result = refine_soundly(shapes::combine({dense, shapes::mesh(shapes::c_shape(), 0.1)}),
                                             {.pe_bound = 0.85, .box_aspect = 1, .density = Density::Keep});
  EXPECT_LT(result.charts[0].density_after / result.charts[0].density_before, 1.3);
}

TEST(Limits, DensitiesAreReported) {
  const Atlas atlas =
      shapes::combine({shapes::mesh(shapes::star(), 0.1), at_scale(shapes::mesh(shapes::star(), 0.1), 2, {2, 0})});
  const RefineResult equal = refine_soundly(atlas, {});
  EXPECT_NEAR(equal.charts[1].density_before / equal.charts[0].density_before, 2, 1e-9);
  EXPECT_NEAR(equal.charts[1].density_after / equal.charts[0].density_after, 1, 0.05);
}

TEST(Limits, DensitiesOfTheInputDoNotSpoilTheRoadThatCuts) {
  const auto both = [](double scale) {
    return shapes::combine({shapes::mesh(shapes::star(), 0.1), at_scale(shapes::mesh(shapes::u_shape(), 0.1), scale, {9, 0})});
  };
  RefineOptions options{.seams = Seams::Rectangles};
  for (const bool until_input : {false, true}) {
    options.rectangles.until_input = until_input;
    const RefineResult one = refine(both(1), options), two = refine(both(5), options);
    EXPECT_LE(two.after.distortion, one.after.distortion + 2e-3);
    EXPECT_EQ(two.ended, until_input ? Ended::Enough : Ended::AtOptimum);
  }
}

// ---- relaxing ----

TEST(Limits, RelaxGoesOnToTheOptimumUnderTheBound) {
  Atlas atlas = shapes::mesh(shapes::rectangle(1, 1), 0.1, 0);
  for (Vec2& uv : atlas.corner_uvs) uv = {uv.x() * (0.7 + 0.3 * uv.x()), uv.y()};
  const RefineResult kept = refine_soundly(atlas, {.pe_bound = 0.9});
  EXPECT_EQ(kept.intervention, Intervention::Unchanged);
  const RefineResult relaxed = refine_soundly(atlas, {.pe_bound = 0.9, .relax = true});
  EXPECT_EQ(relaxed.intervention, Intervention::Squeezed);
  EXPECT_LT(relaxed.after.distortion, 1 + 0.1 * (kept.after.distortion - 1));
  // What is at its optimum already stays as it is.
  const Atlas square = shapes::mesh(shapes::rectangle(1, 1), 0.1, 0);
  EXPECT_EQ(refine_soundly(square, {.pe_bound = 0.9, .relax = true}).intervention, Intervention::Unchanged);
}

TEST(Limits, RelaxedALooserBoundIsNeverDearer) {
  const Atlas atlas = shapes::mesh(shapes::star(), 0.06, 1.2);
  double last = 2;
  for (const double bound : {0.85, 0.75, 0.65, 0.55}) {
    const RefineResult result = refine_soundly(atlas, {.pe_bound = bound, .relax = true});
    EXPECT_LE(result.after.distortion, last + 1e-4) << bound;
    last = result.after.distortion;
  }
}

// ---- the automatic gap ----

TEST(Limits, AHopelessStartDoesNotShrinkTheGap) {
  Atlas atlas = shapes::combine(
      {shapes::mesh(shapes::star(), 0.1), shapes::mesh(shapes::transformed(shapes::c_shape(), 1, 0, {2, 0}), 0.1)});
  for (Vec2& uv : atlas.corner_uvs) uv.x() *= 40;
  const RefineResult result = refine_soundly(atlas, {});
  EXPECT_EQ(result.gap.value, Gap{}.value);
}

TEST(Limits, TheAutomaticGapIsNearTheLargestThatCostsLittle) {
  const Atlas atlas = shapes::squares(144, 0.3);
  const RefineResult result = refine_soundly(atlas, {.pe_bound = 0.96});
  EXPECT_LE(result.after.distortion, 1.05);
  // Twice the gap is not to be had, or costs distortion.
  try {
    const RefineResult twice = refine(atlas, {.pe_bound = 0.96, .gap = Gap{2 * result.gap.value}});
    EXPECT_GT(twice.after.distortion, result.after.distortion + 0.005);
  } catch (const RefineError& error) {
    EXPECT_EQ(error.code(), ErrorCode::BoundNotReached);
  }
}

// ---- textures that are not square ----

TEST(Limits, UvsFillTheTextureOfAnyAspect) {
  const Atlas atlas = shapes::combine(
      {shapes::mesh(shapes::star(), 0.1), shapes::mesh(shapes::transformed(shapes::u_shape(), 1, 0, {2, 0}), 0.1)});
  for (const double aspect : {2.0, 0.25}) {
    const Gap gap{4.0 / 1024, Gap::Unit::LongSide};
    const RefineResult result = refine_soundly(atlas, {.pe_bound = 0.8, .box_aspect = aspect, .gap = gap});
    Vec2 high = Vec2::Zero();
    for (const Vec2& uv : result.corner_uvs) high = high.cwiseMax(uv);
    EXPECT_GT(high.minCoeff(), 0.98);  // both sides
    EXPECT_GE(result.after.unit_square_share, 0.8);
    EXPECT_LT(result.after.distortion, 1.1);  // on the texture
    auto stretched = testing::charts_of(with_corner_uvs(atlas, result.corner_uvs));
    for (Chart& chart : stretched) {
      for (Vec2& uv : chart.uvs) uv.x() *= aspect;
    }
    EXPECT_GE(gap_between_charts(stretched), 0.99 * gap.value * std::max(aspect, 1.0));
    EXPECT_LT(dirichlet_sums(stretched).best_energy(), 1.1);
  }
}

}  // namespace
}  // namespace atlas_refine
