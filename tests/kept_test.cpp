// Charts kept as the artist wants: only moved, or locked in their place; and how what is moved may be turned.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "charts.h"
#include "geometry/freedom.h"
#include "output_atlas.h"
#include "refine_checks.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

/// Five charts in the unit square, curved: a panel, a star, a C, a disk, an S.
Atlas five_charts() {
  const auto at = [](const shapes::Polygon& polygon, double scale, double turn_rad, const Vec2& offset) {
    return shapes::mesh(shapes::transformed(polygon, scale, turn_rad, offset), 0.04);
  };
  return shapes::combine({at(shapes::rectangle(1, 0.6), 0.35, 0.2, {0.2, 0.05}), at(shapes::star(), 0.3, 0, {0.7, 0.2}),
                          at(shapes::c_shape(), 0.4, 0, {0.1, 0.5}), at(shapes::disk(0.5), 0.3, 0, {0.7, 0.5}),
                          at(shapes::s_shape(), 0.3, 0, {0.6, 0.68})});
}

std::vector<int> chart_of_faces(const Atlas& atlas) {
  std::vector<int> out(atlas.face_count());
  const std::vector<Chart> charts = testing::charts_of(atlas);
  for (std::size_t c = 0; c < charts.size(); ++c) {
    for (int face : charts[c].triangle_faces) out[face] = static_cast<int>(c);
  }
  return out;
}

/// One flag on one face of each of the charts.
std::vector<char> flag(const Atlas& atlas, std::vector<int> charts) {
  const std::vector<int> chart_of = chart_of_faces(atlas);
  std::vector<char> flags(atlas.face_count(), 0);
  for (int face = atlas.face_count(); face-- > 0;) {
    const auto found = std::find(charts.begin(), charts.end(), chart_of[face]);
    if (found == charts.end()) continue;
    flags[face] = 1;
    charts.erase(found);
  }
  return flags;
}

/// UVs of one chart before and after, where u is stretched by the aspect.
struct Pair {
  std::vector<Vec2> before, after;
};
Pair uvs_of_chart(const Atlas& atlas, const RefineResult& result, int chart, double aspect = 1) {
  const std::vector<int> chart_of = chart_of_faces(atlas);
  Pair out;
  for (int f = 0; f < atlas.face_count(); ++f) {
    if (chart_of[f] != chart) continue;
    for (int c = atlas.face_offsets[f]; c < atlas.face_offsets[f + 1]; ++c) {
      out.before.push_back(atlas.corner_uvs[c].cwiseProduct(Vec2(aspect, 1)));
      out.after.push_back(result.corner_uvs[c].cwiseProduct(Vec2(aspect, 1)));
    }
  }
  return out;
}

struct Fit {
  double error;  ///< largest distance to the best similar image / size
  double turn_rad;
  double scale;
};
Fit procrustes(const Pair& pair) {
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();
  for (std::size_t k = 0; k < pair.before.size(); ++k) from += pair.before[k], to += pair.after[k];
  from /= static_cast<double>(pair.before.size());
  to /= static_cast<double>(pair.before.size());
  double cosine = 0, sine = 0, square = 0, size = 0, error = 0;
  for (std::size_t k = 0; k < pair.before.size(); ++k) {
    const Vec2 p = pair.before[k] - from, q = pair.after[k] - to;
    cosine += p.dot(q);
    sine += p.x() * q.y() - p.y() * q.x();
    square += p.squaredNorm();
    size = std::max(size, q.norm());
  }
  cosine /= square;
  sine /= square;
  for (std::size_t k = 0; k < pair.before.size(); ++k) {
    const Vec2 p = pair.before[k] - from;
    error = std::max(error, (pair.after[k] - to - Vec2(cosine * p.x() - sine * p.y(), sine * p.x() + cosine * p.y())).norm());
  }
  return {error / size, std::atan2(sine, cosine), std::hypot(cosine, sine)};
}

/// Distance from the nearest quarter turn.
double off_quarter(double turn_rad) { return std::abs(std::remainder(turn_rad, 0.5 * std::numbers::pi)); }

/// The locked charts are as they were, all else is valid around them and keeps the gap; PE is that of the texture.
void expect_locked(const Atlas& atlas, const RefineResult& result, const RefineOptions& options) {
  const double aspect = options.box_aspect > 0 ? options.box_aspect : 1;
  const std::vector<int> chart_of = chart_of_faces(atlas);
  std::vector<Chart> charts = charts_as_placed(split_charts(testing::with_corner_uvs(atlas, result.corner_uvs)));
  const Freedoms freedom = freedom_of(charts, {}, options.locked);
  double share = 0;
  for (Chart& chart : charts) share += area_within(chart, {{0, 0}, {1, 1}});
  EXPECT_NEAR(share, result.after.pe_fixed_aspect, 1e-12);
  EXPECT_GE(share, options.pe_bound);
  for (int f = 0; f < atlas.face_count(); ++f) {
    for (int c = atlas.face_offsets[f]; c < atlas.face_offsets[f + 1]; ++c) {
      if (is_fixed(freedom, chart_of[f])) {
        EXPECT_EQ(result.corner_uvs[c], atlas.corner_uvs[c]);
      } else {
        EXPECT_GE(result.corner_uvs[c].minCoeff(), 0);
        EXPECT_LE(result.corner_uvs[c].maxCoeff(), 1);
      }
    }
  }
  const Validity validity = certify_charts(charts, {}, freedom);
  EXPECT_TRUE(validity.valid()) << validity.problem;
  for (Chart& chart : charts) {
    for (Vec2& uv : chart.uvs) uv.x() *= aspect;
  }
  EXPECT_GE(gap_between_charts(charts, freedom), result.gap.length({aspect, 1}));
}

TEST(KeptShape, ChartsAreOnlyMovedToRounding) {
  const Atlas atlas = five_charts();
  for (const double aspect : {0.0, 1.0, 2.0}) {
    const RefineOptions options{.pe_bound = 0.85, .box_aspect = aspect, .keep_shape = flag(atlas, {0, 3})};
    const RefineResult result = testing::refine_soundly(atlas, options);
    EXPECT_EQ(result.intervention, Intervention::Squeezed);
    const double u_per_v = aspect > 0 ? aspect : 1;
    for (const int chart : {0, 3}) {
      // Where the box is not the texture's, the input's unit square is.
      EXPECT_LT(procrustes(uvs_of_chart(atlas, result, chart, u_per_v)).error, 1e-12) << chart;
    }
    EXPECT_GT(procrustes(uvs_of_chart(atlas, result, 2, u_per_v)).error, 1e-4);
  }
}

TEST(KeptShape, SinglePrecisionIsItsOnlyRounding) {
  const Atlas atlas = five_charts();
  const RefineResult result =
      testing::refine_soundly(atlas, {.pe_bound = 0.85, .stored = Stored::Float32, .keep_shape = flag(atlas, {0, 3})});
  for (const int chart : {0, 3}) EXPECT_LT(procrustes(uvs_of_chart(atlas, result, chart)).error, 1e-6);
}

TEST(KeptShape, GetsTheDensityThatIsAskedFor) {
  Atlas atlas = five_charts();
  const std::vector<int> chart_of = chart_of_faces(atlas);
  for (int f = 0; f < atlas.face_count(); ++f) {
    for (int c = atlas.face_offsets[f]; c < atlas.face_offsets[f + 1] && chart_of[f] == 0; ++c) atlas.corner_uvs[c] *= 2;
  }
  const auto density_of = [&](Density density) {
    const RefineResult result =
        testing::refine_soundly(atlas, {.pe_bound = 0.5, .density = density, .keep_shape = flag(atlas, {0, 1, 2, 3, 4})});
    return result.charts[0].density_after / result.charts[3].density_after;
  };
  EXPECT_NEAR(density_of(Density::Equal), 1, 0.02);
  EXPECT_GT(density_of(Density::Keep), 1.8);
}

TEST(KeptShape, OfAllChartsIsPurePacking) {
  const Atlas atlas = five_charts();
  RefineOptions options{.pe_bound = 0.6, .keep_shape = flag(atlas, {0, 1, 2, 3, 4})};
  const RefineResult result = testing::refine_soundly(atlas, options);
  EXPECT_EQ(result.intervention, Intervention::Moved);
  for (int c = 0; c < 5; ++c) EXPECT_LT(procrustes(uvs_of_chart(atlas, result, c)).error, 1e-12);
  options.pe_bound = 0.8;
  const RefineError error = testing::refusal(atlas, options);
  EXPECT_EQ(error.code(), ErrorCode::BoundNotReached);
  EXPECT_NE(std::string(error.what()).find("all charts are kept in their shapes"), std::string::npos) << error.what();
}

TEST(KeptShape, ChartsThatJamAtTheVeryGapKeepIt) {
  for (const std::uint64_t seed : {1, 5}) {
    const Atlas atlas = shapes::scraps_and_blobs(10, seed);
    for (const Stored stored : {Stored::Double, Stored::Float32}) {
      for (const Rotate rotate : {Rotate::Any, Rotate::QuarterTurns}) {
        const RefineOptions options{.pe_bound = 0.95,
                                    .best_effort = true,
                                    .stored = stored,
                                    .rotate = rotate,
                                    .keep_shape = std::vector<char>(atlas.face_count(), 1)};
        SCOPED_TRACE(seed);
        try {
          testing::expect_sound(atlas, refine(atlas, options), options);
        } catch (const RefineError& error) {
          ADD_FAILURE() << error.what();
        }
      }
    }
  }
}

TEST(KeptShape, OfAChartThatOverlapsItselfLeavesItByName) {
  const Atlas atlas = shapes::combine({five_charts(), shapes::self_overlapping()});
  const RefineResult result = refine(atlas, {.pe_bound = 0.7, .keep_shape = flag(atlas, {5})});
  EXPECT_EQ(result.charts[5].fate, Fate::Left);
  EXPECT_NE(result.charts[5].reason.find("is to keep its shape"), std::string::npos) << result.charts[5].reason;
  const Atlas alone = shapes::self_overlapping();
  const RefineError error = testing::refusal(alone, {.pe_bound = 0.7, .keep_shape = flag(alone, {0})});
  EXPECT_EQ(error.code(), ErrorCode::BadInput);
  EXPECT_EQ(error.chart(), 0);
}

TEST(KeptShape, IsNotCutIntoRectangles) {
  const Atlas atlas = five_charts();
  const RefineResult result = refine(
      atlas, {.pe_bound = 0.7, .seams = Seams::Rectangles, .rectangles = {.candidates = 40}, .keep_shape = flag(atlas, {0, 3})});
  ASSERT_EQ(result.intervention, Intervention::Cut);
  const std::vector<int> chart_of = chart_of_faces(atlas);
  for (const PieceReport& piece : result.pieces) {
    if (piece.chart == 0 || piece.chart == 3) {
      EXPECT_NEAR(piece.area, result.charts[piece.chart].area, 1e-9);
    }
  }
  for (const int chart : {0, 3}) {
    Pair pair;
    for (std::size_t f = 0; f + 1 < result.cut->face_offsets.size(); ++f) {
      if (chart_of[result.cut->face_sources[f]] != chart) continue;
      for (int c = result.cut->face_offsets[f]; c < result.cut->face_offsets[f + 1]; ++c) {
        Vec2 before = Vec2::Zero();
        for (int k = 0; k < 3; ++k)
          before += result.cut->corner_weights[c][k] * atlas.corner_uvs[result.cut->corner_sources[c][k]];
        pair.before.push_back(before);
        pair.after.push_back(result.corner_uvs[c]);
      }
    }
    EXPECT_LT(procrustes(pair).error, 1e-12) << chart;
  }
}

class Turning : public ::testing::TestWithParam<Rotate> {};

TEST_P(Turning, ChartsThatAreOnlyMovedTurnAsTheyMay) {
  const Atlas atlas = five_charts();
  for (const std::vector<int>& kept : {std::vector<int>{0, 1, 2, 3, 4}, {0, 1}}) {
    const RefineResult result =
        testing::refine_soundly(atlas, {.pe_bound = 0.5, .rotate = GetParam(), .keep_shape = flag(atlas, kept)});
    for (const int chart : kept) {
      const Fit fit = procrustes(uvs_of_chart(atlas, result, chart));
      EXPECT_LT(fit.error, 1e-12);
      EXPECT_LT(GetParam() == Rotate::None ? std::abs(fit.turn_rad) : off_quarter(fit.turn_rad), 1e-12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(QuartersAndNone, Turning, ::testing::Values(Rotate::QuarterTurns, Rotate::None));

TEST(AlignAxes, StraightBordersComeToLieOnAnAxis) {
  const Atlas atlas = five_charts();
  const std::vector<char> all = flag(atlas, {0, 1, 2, 3, 4});
  const RefineResult result = testing::refine_soundly(atlas, {.pe_bound = 0.6, .align_axes = true, .keep_shape = all});
  // The panel was turned by 0.2; C and S have straight borders that lay on axes.
  EXPECT_LT(off_quarter(procrustes(uvs_of_chart(atlas, result, 0)).turn_rad + 0.2), 1e-9);
  EXPECT_LT(off_quarter(procrustes(uvs_of_chart(atlas, result, 2)).turn_rad), 1e-9);
  const RefineError error = testing::refusal(atlas, {.rotate = Rotate::None, .align_axes = true});
  EXPECT_EQ(error.code(), ErrorCode::BadOption);
}

TEST(Locked, ChartsStayToTheBitAndOthersGoAroundThem) {
  const Atlas atlas = five_charts();
  for (const double aspect : {0.0, 1.0, 2.0, 0.5}) {
    for (const std::vector<int>& locked : {std::vector<int>{2}, {0, 4}}) {
      const RefineOptions options{
          .pe_bound = 0.8, .box_aspect = aspect, .keep_shape = flag(atlas, {1}), .locked = flag(atlas, locked)};
      const RefineResult result = refine(atlas, options);
      EXPECT_TRUE(result.bound_met);
      EXPECT_EQ(result.intervention, Intervention::Squeezed);
      expect_locked(atlas, result, options);
      EXPECT_LT(procrustes(uvs_of_chart(atlas, result, 1, aspect > 0 ? aspect : 1)).error, 1e-12);
    }
  }
}

TEST(Locked, AStatedGapIsKeptToLockedChartsToo) {
  const Atlas atlas = five_charts();
  const RefineOptions options{.pe_bound = 0.7, .gap = Gap{8.0 / 1024, Gap::Unit::LongSide}, .locked = flag(atlas, {2, 3})};
  const RefineResult result = refine(atlas, options);
  EXPECT_EQ(result.gap.value, 8.0 / 1024);
  expect_locked(atlas, result, options);
}

TEST(Locked, SinglePrecisionLeavesThemToTheBit) {
  const Atlas atlas = five_charts();
  const RefineOptions options{.pe_bound = 0.8, .stored = Stored::Float32, .locked = flag(atlas, {0, 4})};
  expect_locked(atlas, refine(atlas, options), options);
}

/// Locked charts that overlap each other, one half outside, one mirrored and one with a flipped face: the artist's affair.
TEST(Locked, ChartsMayBeAsTheArtistWants) {
  const Atlas one = shapes::mesh(shapes::transformed(shapes::rectangle(1, 0.6), 0.3, 0.1, {0.1, 0.1}), 0.04);
  const Atlas outside = shapes::mesh(shapes::transformed(shapes::disk(0.5), 0.4, 0, {1.0, 0.9}), 0.04);
  Atlas mirrored = shapes::mirrored(shapes::mesh(shapes::transformed(shapes::c_shape(), 0.3, 0, {0.2, 0.6}), 0.04));
  for (Vec2& uv : mirrored.corner_uvs) uv.x() += 1;
  Atlas flipped = shapes::with_flipped_face(one);
  for (Vec2& uv : flipped.corner_uvs) uv += Vec2(0.05, 0.02);
  const Atlas atlas = shapes::combine({one, outside, mirrored, flipped, five_charts()});
  std::vector<int> locked = {0, 1, 2, 3};
  const RefineOptions options{.pe_bound = 0.8, .locked = flag(atlas, locked)};
  const RefineResult result = refine(atlas, options);
  EXPECT_TRUE(result.bound_met);
  expect_locked(atlas, result, options);
}

TEST(Locked, AnAtlasThatHoldsTheBoundAroundThemIsLeftAsItIs) {
  const Atlas atlas = five_charts();
  const RefineOptions options{.pe_bound = 0.8, .locked = flag(atlas, {2})};
  const Atlas refined = testing::with_corner_uvs(atlas, refine(atlas, options).corner_uvs);
  const RefineResult again = refine(refined, options);
  EXPECT_EQ(again.intervention, Intervention::Unchanged);
  EXPECT_TRUE(testing::same_bits(again.corner_uvs, refined.corner_uvs));
  // Outside of the texture others do not belong, however well they are packed.
  Atlas shifted = refined;
  const std::vector<int> chart_of = chart_of_faces(atlas);
  for (int f = 0; f < atlas.face_count(); ++f) {
    for (int c = atlas.face_offsets[f]; c < atlas.face_offsets[f + 1] && chart_of[f] == 0; ++c) shifted.corner_uvs[c].x() += 1;
  }
  EXPECT_NE(refine(shifted, options).intervention, Intervention::Unchanged);
}

TEST(Locked, WhatCannotBeHadIsToldInWords) {
  const Atlas atlas = five_charts();
  const RefineError all = testing::refusal(atlas, {.pe_bound = 0.9, .locked = flag(atlas, {0, 1, 2, 3, 4})});
  EXPECT_EQ(all.code(), ErrorCode::BoundNotReached);
  EXPECT_NE(std::string(all.what()).find("all charts are locked"), std::string::npos) << all.what();
  const Atlas full = shapes::combine({shapes::mesh(shapes::rectangle(1, 1), 0.2), five_charts()});
  const RefineError none = testing::refusal(full, {.pe_bound = 0.9, .locked = flag(full, {0})});
  EXPECT_EQ(none.code(), ErrorCode::BoundNotReached);
  EXPECT_NE(std::string(none.what()).find("leave the others no room"), std::string::npos) << none.what();
}

TEST(Locked, AllChartsWithBestEffortAreLeftAsTheyAre) {
  const Atlas atlas = five_charts();
  const RefineResult result = refine(atlas, {.pe_bound = 0.9, .best_effort = true, .locked = flag(atlas, {0, 1, 2, 3, 4})});
  EXPECT_FALSE(result.bound_met);
  EXPECT_TRUE(testing::same_bits(result.corner_uvs, atlas.corner_uvs));
}

TEST(Locked, OthersAreCutAroundThem) {
  const Atlas atlas = five_charts();
  for (const Cut cut : {Cut::Split, Cut::Edges}) {
    const RefineOptions options{.pe_bound = 0.8, .seams = Seams::Rectangles, .cut = cut, .locked = flag(atlas, {2})};
    const RefineResult result = refine(atlas, options);
    EXPECT_EQ(result.intervention, Intervention::Cut);
    const Atlas out = testing::output(atlas, result);
    const Validity validity = validate(out);
    EXPECT_TRUE(validity.valid()) << validity.problem;
    EXPECT_GE(result.after.pe_fixed_aspect, 0.8);
    // The locked chart keeps every corner, bit for bit; nothing else leaves the texture.
    const std::vector<int> chart_of = chart_of_faces(atlas);
    std::vector<Vec2> kept;
    for (int f = 0; f < out.face_count(); ++f) {
      const int source = result.cut ? result.cut->face_sources[f] : f;
      for (int c = out.face_offsets[f]; c < out.face_offsets[f + 1]; ++c) {
        if (chart_of[source] == 2) {
          kept.push_back(out.corner_uvs[c]);
          continue;
        }
        EXPECT_GE(out.corner_uvs[c].minCoeff(), 0);
        EXPECT_LE(out.corner_uvs[c].maxCoeff(), 1);
      }
    }
    std::vector<Vec2> before;
    for (int f = 0; f < atlas.face_count(); ++f) {
      for (int c = atlas.face_offsets[f]; chart_of[f] == 2 && c < atlas.face_offsets[f + 1]; ++c)
        before.push_back(atlas.corner_uvs[c]);
    }
    EXPECT_TRUE(testing::same_bits(kept, before));
  }
}

TEST(Locked, TheBitsDoNotDependOnTheThreads) {
  const Atlas atlas = five_charts();
  RefineOptions options{.pe_bound = 0.8, .keep_shape = flag(atlas, {1}), .locked = flag(atlas, {2}), .threads = 1};
  const RefineResult one = refine(atlas, options);
  options.threads = 4;
  EXPECT_TRUE(testing::same_bits(one.corner_uvs, refine(atlas, options).corner_uvs));
}

TEST(Locked, ChartsOfATileStayInIt) {
  Atlas atlas = five_charts();
  for (Vec2& uv : atlas.corner_uvs) uv += Vec2(1, 2);
  const RefineResult result = refine(atlas, {.pe_bound = 0.8,
                                             .groups = std::vector<int>(atlas.face_count(), 0),
                                             .group_origins = {{1, 2}},
                                             .locked = flag(atlas, {2})});
  EXPECT_TRUE(result.bound_met);
  const std::vector<int> chart_of = chart_of_faces(atlas);
  std::vector<Chart> charts = testing::charts_of(testing::with_corner_uvs(atlas, result.corner_uvs));
  testing::expect_certified(charts);
  for (int f = 0; f < atlas.face_count(); ++f) {
    for (int c = atlas.face_offsets[f]; c < atlas.face_offsets[f + 1]; ++c) {
      if (chart_of[f] == 2) {
        EXPECT_EQ(result.corner_uvs[c], atlas.corner_uvs[c]);
      } else {
        EXPECT_GE((result.corner_uvs[c] - Vec2(1, 2)).minCoeff(), 0);
        EXPECT_LE((result.corner_uvs[c] - Vec2(1, 2)).maxCoeff(), 1);
      }
    }
  }
  double share = 0;
  for (const Chart& chart : charts) share += area_within(chart, {{1, 2}, {2, 3}});
  EXPECT_NEAR(share, result.after.pe_fixed_aspect, 1e-12);
}

/// A second chart at the place of the C, which goes with it.
Atlas with_stack() {
  const shapes::Polygon c = shapes::transformed(shapes::c_shape(), 0.4, 0, {0.1, 0.5});
  return shapes::combine({five_charts(), shapes::mesh(c, 0.04)});
}

TEST(Locked, ChartsOnEachOtherStayToTheBit) {
  const Atlas atlas = with_stack();
  for (const std::vector<int>& locked : {std::vector<int>{2}, {5}, {2, 5}}) {
    const RefineResult result = refine(atlas, {.pe_bound = 0.8, .locked = flag(atlas, locked)});
    EXPECT_TRUE(result.bound_met);
    for (const int chart : {2, 5}) {
      const Pair pair = uvs_of_chart(atlas, result, chart);
      EXPECT_TRUE(testing::same_bits(pair.before, pair.after)) << chart;
    }
  }
}

TEST(KeptShape, OfAChartOnAnotherKeepsBoth) {
  const Atlas atlas = with_stack();
  const RefineResult result = testing::refine_soundly(five_charts(), {.pe_bound = 0.85});
  EXPECT_GT(procrustes(uvs_of_chart(five_charts(), result, 2)).error, 1e-4);  // it bends where it may
  const RefineResult kept = refine(atlas, {.pe_bound = 0.85, .keep_shape = flag(atlas, {5})});
  EXPECT_TRUE(kept.bound_met);
  for (const int chart : {2, 5}) EXPECT_LT(procrustes(uvs_of_chart(atlas, kept, chart)).error, 1e-12) << chart;
}

TEST(Kept, FlagsThatDoNotFitTheFacesAreRefused) {
  const Atlas atlas = five_charts();
  EXPECT_EQ(testing::refusal(atlas, {.keep_shape = {1, 0}}).code(), ErrorCode::BadOption);
  EXPECT_EQ(testing::refusal(atlas, {.locked = {1}}).code(), ErrorCode::BadOption);
}

}  // namespace
}  // namespace atlas_refine
