// refine() as a whole on generated atlases: the bound, the least intervention, repairs, gaps, density, stored values.
#include "atlas_refine/refine.h"

#include <cmath>
#include <cstring>
#include <numeric>

#include "charts.h"
#include "geometry/plane.h"
#include "refine_checks.h"
#include "shapes.h"
#include "small_atlases.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

using testing::refine_soundly;
using testing::same_bits;
using testing::with_corner_uvs;

Atlas named_shape(std::size_t index) { return shapes::mesh(shapes::named_polygons()[index].polygon, 0.08); }

/// C, star, U and a disk, loosely laid out.
Atlas four_charts() {
  const auto at = [](const shapes::Polygon& p, double x, double y) {
    return shapes::mesh(shapes::transformed(p, 1, 0, {x, y}), 0.1);
  };
  return shapes::combine({at(shapes::c_shape(), 0, 0), at(shapes::star(), 1.3, 0), at(shapes::u_shape(), -0.4, 0.8),
                          at(shapes::disk(0.4), 1.3, 1.3)});
}

struct Request {
  double pe_bound;
  double box_aspect;
};

class NamedShapes : public ::testing::TestWithParam<std::tuple<std::size_t, Request>> {};

TEST_P(NamedShapes, ReachTheBound) {
  const auto& [index, request] = GetParam();
  const Atlas atlas = named_shape(index);
  const RefineResult result = refine_soundly(atlas, {.pe_bound = request.pe_bound, .box_aspect = request.box_aspect});
  EXPECT_EQ(result.intervention, Intervention::Squeezed);  // none of them packs this well as it is
  EXPECT_LT(result.after.distortion, request.pe_bound > 0.85 || request.box_aspect > 0 ? 1.25 : 1.08);
  EXPECT_GT(result.price, 0);
  EXPECT_GT(result.iterations, 0);
  EXPECT_TRUE(result.repairs.empty());
}

INSTANTIATE_TEST_SUITE_P(CSUSpiralCombStarRing, NamedShapes,
                         ::testing::Combine(::testing::Range<std::size_t>(0, 7),
                                            ::testing::Values(Request{0.8, 0}, Request{0.9, 0}, Request{0.8, 1})));

TEST(Refine, SeveralChartsReachEveryBound) {
  const Atlas atlas = four_charts();
  double last = 0;
  for (const double bound : {0.8, 0.92}) {
    const RefineResult result = refine_soundly(atlas, {.pe_bound = bound});
    EXPECT_GE(result.after.distortion, last - 2e-3);  // more efficiency is not cheaper
    last = result.after.distortion;
  }
  refine_soundly(atlas, {.pe_bound = 0.8, .box_aspect = 2.5});
}

// ---- the least intervention ----

TEST(Refine, UnchangedReturnsTheInputsOwnBits) {
  Atlas atlas = shapes::mesh(shapes::rectangle(1, 0.7), 0.1);
  for (Vec2& uv : atlas.corner_uvs) uv = 3.7 * uv + Vec2(-11.0 / 3, 0.1);
  const RefineResult result = refine_soundly(atlas, {.pe_bound = 0.95});
  EXPECT_EQ(result.intervention, Intervention::Unchanged);
  EXPECT_TRUE(same_bits(result.corner_uvs, atlas.corner_uvs));
  EXPECT_EQ(result.after.distortion_to_input, 1);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(result.charts[0].distortion_before, result.charts[0].distortion_after);
}

TEST(Refine, AnAskedGapCountsForUnchanged) {
  const Atlas atlas = shapes::two_squares(0.01);
  EXPECT_EQ(refine_soundly(atlas, {.pe_bound = 0.9}).intervention, Intervention::Unchanged);
  EXPECT_EQ(refine_soundly(atlas, {.pe_bound = 0.9, .gap = Gap{0.003}}).intervention, Intervention::Unchanged);
  const RefineResult moved = refine_soundly(atlas, {.pe_bound = 0.9, .gap = Gap{0.01}});
  EXPECT_EQ(moved.intervention, Intervention::Moved);
  EXPECT_GE(moved.after.gap_between, 0.01);
}

TEST(Refine, MovedKeepsEveryShape) {
  const Atlas atlas = shapes::mesh(shapes::transformed(shapes::rectangle(1, 0.6), 1, 0.5, {0, 0}), 0.1, 0.8);
  const RefineResult result = refine_soundly(atlas, {.pe_bound = 0.9});
  EXPECT_EQ(result.intervention, Intervention::Moved);
  EXPECT_NEAR(result.after.distortion_to_input, 1, 1e-9);
  EXPECT_NEAR(result.after.distortion, result.before.distortion, 1e-9);
  EXPECT_EQ(result.iterations, 0);
}

TEST(Refine, SqueezedReportsWhatWasBent) {
  const Atlas atlas = four_charts();
  const RefineResult result = refine_soundly(atlas, {.pe_bound = 0.9});
  EXPECT_EQ(result.intervention, Intervention::Squeezed);
  EXPECT_GT(result.after.distortion_to_input, 1);
  double largest = 0;
  int faces = 0;
  for (const ChartReport& chart : result.charts) {
    EXPECT_GE(chart.distortion_before, 1);
    EXPECT_GE(chart.distortion_after, 1);
    largest = std::max(largest, chart.stretch_max);
    faces += chart.faces;
  }
  EXPECT_NEAR(largest, result.after.stretch_max, 1e-12);
  EXPECT_EQ(faces, atlas.face_count());
  ASSERT_FALSE(result.timings.empty());
  for (const StageTime& time : result.timings) EXPECT_GE(time.seconds, 0);
  double seconds = 0;
  for (const PhaseTime& time : result.profile.phases) seconds += time.seconds;
  EXPECT_GT(seconds, 0);
  EXPECT_GE(result.profile.steps, 1);
  EXPECT_GT(result.profile.mean_step, 0);
  EXPECT_LE(result.profile.mean_step, 1);
}

TEST(Refine, APolygonMeshKeepsItsPolygons) {
  Atlas atlas = shapes::quad_grid(12, 4);
  for (Vec2& uv : atlas.corner_uvs) {  // bent into an arc
    const double angle = 2.2 * uv.x(), radius = 0.7 - uv.y();
    uv = {-radius * std::cos(angle), radius * std::sin(angle)};
  }
  const RefineResult result = refine_soundly(atlas, {.pe_bound = 0.9});
  EXPECT_EQ(result.charts[0].faces, 48);
}

// ---- repairs ----

TEST(Refine, MirroredChartsAreTurnedAndReported) {
  const Atlas atlas =
      shapes::combine({shapes::mesh(shapes::star(), 0.1),
                       shapes::mirrored(shapes::mesh(shapes::transformed(shapes::c_shape(), 1, 0, {-1.2, 0}), 0.1))});
  const RefineResult result = refine_soundly(atlas, {});
  EXPECT_FALSE(result.charts[0].mirrored);
  EXPECT_TRUE(result.charts[1].mirrored);
  ASSERT_EQ(result.repairs.size(), 1u);
  EXPECT_NE(describe(result.repairs[0]).find("chart 1"), std::string::npos);
}

TEST(Refine, AMirroredChartAtTheBoundIsOnlyMoved) {
  const Atlas atlas = shapes::mirrored(shapes::mesh(shapes::rectangle(1, 0.7), 0.1));
  const RefineResult result = refine_soundly(atlas, {});
  EXPECT_EQ(result.intervention, Intervention::Moved);
  EXPECT_NEAR(result.after.distortion_to_input, 1, 1e-9);
}

TEST(Refine, AChartThatOverlapsItselfIsEmbeddedAnewAndReported) {
  const Atlas atlas = shapes::self_overlapping();
  const RefineResult result = refine_soundly(atlas, {});
  EXPECT_TRUE(result.charts[0].re_embedded);
  ASSERT_EQ(result.repairs.size(), 1u);
  EXPECT_NE(describe(result.repairs[0]).find("chart 0"), std::string::npos);
}

TEST(Refine, ChartsThatTouchOrLieOnEachOtherAreSeparated) {
  const RefineResult result = refine_soundly(shapes::touching_charts(), {});
  EXPECT_EQ(result.intervention, Intervention::Moved);
  const Atlas stacked = shapes::combine({shapes::mesh(shapes::star(), 0.1), shapes::mesh(shapes::star(), 0.1)});
  refine_soundly(stacked, {.stacks = Stacks::Separate});
  refine_soundly(shapes::disk_in_ring(), {.pe_bound = 0.85});
}

TEST(Refine, MendsFlipsNamesTheirFacesAndLeavesFacesOnAPoint) {
  const Atlas flipped =
      shapes::combine({shapes::mesh(shapes::star(), 0.1), shapes::with_flipped_face(shapes::mesh(shapes::u_shape(), 0.1))});
  const RefineResult result = refine_soundly(flipped, {});
  ASSERT_EQ(result.repairs.size(), 1u);
  const Repair& repair = result.repairs[0];
  EXPECT_EQ(repair.charts, std::vector<int>{1});
  ASSERT_FALSE(repair.faces.empty());
  EXPECT_GE(repair.faces.front(), shapes::mesh(shapes::star(), 0.1).face_count());
  EXPECT_LE(repair.distortion_to_input, 1.02);
  EXPECT_NE(describe(repair).find(std::to_string(repair.faces.front())), std::string::npos) << describe(repair);

  Atlas flat = shapes::quad_grid(3, 3);
  for (int c = 4 * 4; c < 4 * 5; ++c) flat.corner_uvs[c] = {0.5, 0.5};
  EXPECT_EQ(refine(flat).charts[1].fate, Fate::Left);
}

// ---- gap ----

TEST(Refine, AHardGapIsKept) {
  const Atlas atlas = four_charts();
  for (const Gap gap : {Gap{0.0}, Gap{0.01}}) {
    const RefineResult result = refine_soundly(atlas, {.pe_bound = 0.8, .gap = gap});
    EXPECT_EQ(result.gap.value, gap.value);
    EXPECT_EQ(result.gap.unit, gap.unit);
    EXPECT_GT(result.after.gap_between, 0);
  }
  const RefineResult square =
      refine_soundly(atlas, {.pe_bound = 0.8, .box_aspect = 1, .gap = Gap{8.0 / 1024, Gap::Unit::LongSide}});
  EXPECT_EQ(square.intervention, Intervention::Squeezed);
}

TEST(Refine, TheAutomaticGapShrinksWhereManyChartsNeedIt) {
  const Atlas atlas = shapes::squares(144, 0.3);
  const RefineResult result = refine_soundly(atlas, {.pe_bound = 0.96});
  EXPECT_LT(result.gap.value, Gap{}.value);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("gap"), std::string::npos);
  EXPECT_GT(result.gap.value, 0);
}

/// Wavy strips of a few quads side by side, each squashed to a width and height of the texture of its own.
Atlas hair_cards(int count) {
  std::vector<Atlas> cards;
  for (int k = 0; k < count; ++k) {
    Atlas card = strip(3);
    const double length = 3 + (7 * k % 11) * 1.5 / 11;
    for (Vec2& uv : card.corner_uvs) uv = {(k + 0.72 * uv.y()) / count, 0.3 * uv.x()};
    for (Vec3& p : card.positions) p = Vec3(0.05 * k + 0.04 * p.y(), length * p.x() / 3, 0.1 * std::sin(2 * p.x() + k));
    cards.push_back(card);
  }
  return shapes::combine(cards);
}

TEST(Refine, HairCardsKeepALargeGapAndTheirShapes) {
  const RefineResult result = refine_soundly(hair_cards(120), {});
  EXPECT_GE(result.gap.value, 0.0005);
  EXPECT_LT(result.after.distortion, 1.005);
}

TEST(Refine, ScrapsAmongBlobsHoldTheBound) {
  EXPECT_GE(refine_soundly(shapes::scraps_and_blobs(150), {.threads = 2}).gap.value, 0.0009);
}

TEST(Refine, ABoundThatAHardGapForbidsNamesTheBestPe) {
  const Atlas atlas = shapes::squares(9, 0.3);
  RefineOptions options{.pe_bound = 0.95, .gap = Gap{0.03}};
  const RefineError error = testing::refusal(atlas, options);
  EXPECT_EQ(error.code(), ErrorCode::BoundNotReached);
  options.best_effort = true;
  const RefineResult best = refine(atlas, options);
  EXPECT_FALSE(best.bound_met);
  testing::expect_sound(atlas, best, options);
  char pe[32];
  std::snprintf(pe, sizeof pe, "%.4f", best.after.pe);
  EXPECT_NE(std::string(error.what()).find(pe), std::string::npos) << error.what() << " does not name " << pe;
}

// ---- distortion limit, density ----

TEST(Refine, TheLargestDistortionIsALimit) {
  const Atlas atlas = shapes::mesh(shapes::spiral(), 0.08);
  RefineOptions options{.pe_bound = 0.95, .max_distortion = 1.01};
  const RefineError error = testing::refusal(atlas, options);
  EXPECT_EQ(error.code(), ErrorCode::BoundNotReached);
  EXPECT_NE(std::string(error.what()).find("1.01"), std::string::npos) << error.what();
  options.best_effort = true;
  const RefineResult best = refine(atlas, options);
  EXPECT_FALSE(best.bound_met);
  EXPECT_LE(best.after.distortion, 1.01 + 1e-6);
  EXPECT_GT(best.after.pe, best.before.pe);
  testing::expect_sound(atlas, best, options);
  const RefineResult loose = refine_soundly(atlas, {.pe_bound = 0.7, .max_distortion = 1.2});
  EXPECT_LE(loose.after.distortion, 1.2);
}

TEST(Refine, DensityIsEqualOrKept) {
  Atlas large = shapes::mesh(shapes::transformed(shapes::star(), 1, 0, {1.2, 0}), 0.1);
  for (Vec2& uv : large.corner_uvs) uv *= 2;
  const Atlas atlas = shapes::combine({shapes::mesh(shapes::star(), 0.1), large});
  const auto area_ratio = [&](Density density) {
    RefineOptions options{.density = density};
    const auto result = refine_soundly(atlas, options);
    const auto charts = testing::charts_of(with_corner_uvs(atlas, result.corner_uvs));
    return uv_area(charts[1]) / uv_area(charts[0]);
  };
  // A squeeze inflates one chart a little more than the other.
  EXPECT_NEAR(area_ratio(Density::Equal), 1, 0.15);
  EXPECT_NEAR(area_ratio(Density::Keep), 4, 0.6);
}

// ---- stored values, determinism, invariance ----

TEST(Refine, SinglePrecisionIsCertifiedOnItsOwnValues) {
  for (const Atlas& atlas : {four_charts(), shapes::mesh(shapes::spiral(), 0.08)}) {
    const RefineResult result = refine_soundly(atlas, {.stored = Stored::Float32});
    for (const Vec2& uv : result.corner_uvs) {
      for (const double value : {uv.x(), uv.y()}) {
        volatile float stored = static_cast<float>(value);
        ASSERT_EQ(static_cast<double>(stored), value);
      }
    }
  }
}

TEST(Refine, TheSameBitsFromEveryRunAndNumberOfThreads) {
  const Atlas atlas = four_charts();
  const auto run = [&](int threads) { return refine(atlas, {.pe_bound = 0.85, .seed = 3, .threads = threads}).corner_uvs; };
  const auto one = run(1);
  EXPECT_TRUE(same_bits(one, run(1)));
  EXPECT_TRUE(same_bits(one, run(2)));
}

TEST(Refine, AScaleOrAQuarterTurnOfTheInputChangesNothingThatIsMeasured) {
  const Atlas atlas = shapes::mesh(shapes::s_shape(), 0.08);
  const RefineResult plain = refine_soundly(atlas, {});
  for (const double scale : {0.01, 1000.0}) {
    Atlas changed = atlas;
    for (Vec2& uv : changed.corner_uvs) uv = scale * Vec2(-uv.y(), uv.x()) + Vec2(scale, 0);
    for (Vec3& p : changed.positions) p *= 7;
    const RefineResult result = refine_soundly(changed, {});
    EXPECT_NEAR(result.before.pe, plain.before.pe, 1e-9);
    EXPECT_NEAR(result.before.distortion, plain.before.distortion, 1e-9);
    EXPECT_NEAR(result.after.distortion, plain.after.distortion, 0.1 * (plain.after.distortion - 1));
  }
}

TEST(Refine, PermutedFacesGiveAnEquallyGoodResult) {
  const Atlas atlas = four_charts();
  std::vector<int> order(atlas.face_count());
  std::iota(order.begin(), order.end(), 0);
  Rng rng(6);
  for (int k = atlas.face_count() - 1; k > 0; --k) std::swap(order[k], order[rng.below(k + 1)]);
  Atlas permuted{.name = "", .positions = atlas.positions, .face_offsets = {0}, .corner_vertices = {}, .corner_uvs = {}};
  for (const int face : order) {
    for (int c = atlas.face_offsets[face]; c < atlas.face_offsets[face + 1]; ++c) {
      permuted.corner_vertices.push_back(atlas.corner_vertices[c]);
      permuted.corner_uvs.push_back(atlas.corner_uvs[c]);
    }
    permuted.face_offsets.push_back(permuted.corner_count());
  }
  const RefineResult plain = refine_soundly(atlas, {.pe_bound = 0.85}), other = refine_soundly(permuted, {.pe_bound = 0.85});
  EXPECT_NEAR(other.before.pe, plain.before.pe, 1e-12);
  EXPECT_NEAR(other.after.distortion, plain.after.distortion, 0.02);
}

TEST(Refine, ARefinedAtlasIsLeftAsItIs) {
  const Atlas atlas = four_charts();
  const RefineResult once = refine_soundly(atlas, {});
  const RefineResult twice = refine_soundly(with_corner_uvs(atlas, once.corner_uvs), {});
  EXPECT_EQ(twice.intervention, Intervention::Unchanged);
  EXPECT_TRUE(same_bits(once.corner_uvs, twice.corner_uvs));
}

// ---- options, progress, pictures ----

TEST(Refine, OptionsOutOfRangeAreRefused) {
  const Atlas atlas = shapes::quad_grid(2, 2);
  const double nan = std::nan("");
  std::vector<RefineOptions> wrong;
  for (const double bound : {0.0, 1.0, 1.2, -0.5, nan}) wrong.push_back({.pe_bound = bound});
  for (const double aspect : {-1.0, 0.0099, 101.0, HUGE_VAL, nan}) wrong.push_back({.box_aspect = aspect});
  for (const double gap : {-0.1, 0.2, nan}) wrong.push_back({.gap = Gap{gap}});
  for (const double limit : {0.9, HUGE_VAL, nan}) wrong.push_back({.max_distortion = limit});
  for (const double limit : {0.9, HUGE_VAL, nan}) wrong.push_back({.max_stretch = limit});
  for (const int threads : {-1, 5000}) wrong.push_back({.threads = threads});
  for (const RefineOptions& options : wrong) {
    EXPECT_EQ(testing::refusal(atlas, options).code(), ErrorCode::BadOption);
    EXPECT_EQ(testing::refusal(atlas, options).stage(), "options");
  }
}

TEST(Refine, TheSlimmestTexturesAreTaken) {
  for (const double aspect : {0.01, 100.0}) refine_soundly(shapes::quad_grid(2, 2), {.pe_bound = 0.005, .box_aspect = aspect});
}

TEST(Refine, ProgressRisesAndStopsTheWork) {
  const Atlas atlas = shapes::mesh(shapes::spiral(3), 0.01);
  double last = 0;
  std::string stage;
  const auto watch = [&](const Progress& progress) {
    EXPECT_GE(progress.fraction, last);
    EXPECT_LE(progress.fraction, 1);
    last = progress.fraction;
    stage = progress.stage;
    return stage != "squeeze";
  };
  try {
    refine(atlas, {.pe_bound = 0.95}, watch);
    FAIL() << "must be cancelled";
  } catch (const RefineError& error) {
    EXPECT_EQ(error.code(), ErrorCode::Cancelled);
  }
  EXPECT_EQ(stage, "squeeze");
}

/// What refine() gives where the callback asks for the best so far once `asked` says so.
RefineResult stopped_when(const Atlas& atlas, const RefineOptions& options, const std::function<bool(const Progress&)>& asked) {
  bool once = false;
  return refine(atlas, options, [&](const Progress& progress) -> Answer {
    once = once || asked(progress);
    return once ? Answer::Finish : Answer::GoOn;
  });
}

TEST(Refine, StoppedOnItsWayItKeepsTheBestAtlas) {
  const Atlas atlas = shapes::mesh(shapes::spiral(3), 0.01);
  const double pe_in = measure(atlas).pe;
  const auto on_its_way = [&](const Progress& progress) { return progress.stage == "squeeze" && progress.pe > pe_in + 0.05; };
  const RefineResult result = stopped_when(atlas, {.pe_bound = 0.999}, on_its_way);
  EXPECT_EQ(result.ended, Ended::Stopped);
  EXPECT_FALSE(result.bound_met);
  EXPECT_GT(result.after.pe, pe_in + 0.03);
  EXPECT_EQ(result.intervention, Intervention::Squeezed);
  Atlas after = atlas;
  after.corner_uvs = result.corner_uvs;
  EXPECT_TRUE(validate(after).valid());
}

// What a large atlas covers of the texture that it reaches beyond says nothing.
TEST(Refine, StoppedOnItsWayItIsBetterThanAnInputBesideTheTexture) {
  Atlas atlas = shapes::mesh(shapes::spiral(3), 0.01);
  for (Vec2& uv : atlas.corner_uvs) uv = 1000 * uv;
  const auto on_its_way = [](const Progress& progress) { return progress.stage == "squeeze" && progress.pe > 0; };
  const RefineResult result = stopped_when(atlas, {.pe_bound = 0.999, .in_texture = true}, on_its_way);
  EXPECT_EQ(result.ended, Ended::Stopped);
  EXPECT_EQ(result.intervention, Intervention::Squeezed);
}

TEST(Refine, StoppedAtOnceItKeepsTheInputOrWhatIsBetter) {
  const auto at_once = [](const Progress&) { return true; };
  for (const Seams seams : {Seams::None, Seams::Rectangles}) {
    const Atlas atlas = shapes::mesh(shapes::spiral(3), 0.01);
    const RefineResult result = stopped_when(atlas, {.pe_bound = 0.95, .seams = seams}, at_once);
    EXPECT_EQ(result.ended, Ended::Stopped);
    EXPECT_FALSE(result.warnings.empty());
    EXPECT_GE(result.after.pe, result.before.pe);
    if (result.intervention == Intervention::Unchanged) {
      EXPECT_EQ(result.corner_uvs, atlas.corner_uvs);
    }
  }
}

/// A plus of five squares; onto each side of its border a triangle is put whose third corner is the side's middle.
Atlas plus_with_flat_triangles() {
  const std::vector<Vec3> corners = {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {3, 1, 0}, {3, 2, 0}, {2, 2, 0},
                                     {2, 3, 0}, {1, 3, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}, {1, 1, 0}};
  std::vector<Vec3> positions = corners;
  std::vector<std::vector<int>> faces = {{0, 1, 2, 11}, {2, 3, 4, 5}, {5, 6, 7, 8}, {8, 9, 10, 11}, {11, 2, 5, 8}};
  for (int k = 0; k < 12; ++k) {
    const int next = (k + 1) % 12;
    positions.emplace_back(0.5 * (corners[k] + corners[next]));
    faces.push_back({next, k, 12 + k});
  }
  return flat_atlas(positions, faces);
}

TEST(Refine, FacesWithoutAreaAreNotBlownUpToHoldTheBound) {
  const Atlas atlas = plus_with_flat_triangles();
  const RefineResult result = refine(atlas, {.pe_bound = 0.75});
  EXPECT_GE(result.after.pe, 0.75);
  double flat = 0, all = 0;
  for (const Chart& chart : testing::charts_of(with_corner_uvs(atlas, result.corner_uvs))) {
    all += uv_area(chart);
    for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
      const Triangle& v = chart.triangles[t];
      const double area = 0.5 * doubled_area(chart.uvs[v[0]], chart.uvs[v[1]], chart.uvs[v[2]]);
      if (chart.triangle_faces[t] >= 5) flat += area;
    }
  }
  EXPECT_LT(flat, 0.03 * all);
}

TEST(Refine, EveryStageIsDrawn) {
  struct : DebugSink {
    void receive(const AtlasSnapshot& snapshot) override {
      stages.push_back(snapshot.stage);
      EXPECT_EQ(snapshot.triangles.size(), snapshot.stretch.size());
      EXPECT_FALSE(snapshot.boundary_loops.empty());
    }
    std::vector<std::string> stages;
  } sink;
  refine(shapes::mesh(shapes::c_shape(), 0.1), {}, {}, &sink);
  EXPECT_EQ(sink.stages, (std::vector<std::string>{"input", "placed", "squeezed"}));
}

}  // namespace
}  // namespace atlas_refine
