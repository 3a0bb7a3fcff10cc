// Cuts only where they are needed or pay, by the public measures of the output mesh.
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "closed_shapes.h"
#include "cut_checks.h"
#include "output_checks.h"
#include "sheets.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

using testing::refusal;
using testing::same_bits;

RefineOptions needed() {
  RefineOptions options;
  options.seams = Seams::Needed;
  options.effort = Effort::Fast;
  return options;
}

RefineOptions needed_within(double max_distortion) {
  RefineOptions options = needed();
  options.max_distortion = max_distortion;
  return options;
}

RefineResult refine_soundly(const Atlas& atlas, const RefineOptions& options) {
  RefineResult result = refine(atlas, options);
  testing::expect_sound_output(atlas, result, options);
  if (options.max_distortion) {
    EXPECT_LE(result.after.distortion, *options.max_distortion + 1e-6);
  }
  if (options.max_boundary_growth) {
    EXPECT_LE(result.boundary_growth, *options.max_boundary_growth + 1e-9);
  }
  const bool cut = result.intervention == Intervention::Cut;
  EXPECT_EQ(result.added_seams > 0, cut);
  EXPECT_EQ(result.boundary_growth > 0, cut);
  EXPECT_EQ(result.after.seam_edges > result.before.seam_edges, cut);
  return result;
}

// Flat shapes whose UVs are the surface: what is lost is lost for the bound alone.
Atlas flat_s() { return shapes::mesh(shapes::s_shape(), 0.1, 0); }
Atlas flat_star() { return shapes::mesh(shapes::star(), 0.1, 0); }

double without_cuts(const Atlas& atlas) {
  RefineOptions options;
  return refine(atlas, options).after.distortion;
}

TEST(Needed, WithinTheLimitNothingIsCut) {
  const Atlas atlas = flat_s();
  const RefineResult result = refine_soundly(atlas, needed_within(without_cuts(atlas) + 0.001));
  EXPECT_EQ(result.intervention, Intervention::Squeezed);
  EXPECT_EQ(result.added_seams, 0);
  ASSERT_TRUE(result.cuts.has_value());
  EXPECT_EQ(result.cuts->cuts, 0);
}

TEST(Needed, AboveTheLimitAFewCutsKeepIt) {
  for (const Atlas& atlas : {flat_s(), flat_star()}) {
    const double whole = without_cuts(atlas);
    const RefineResult result = refine_soundly(atlas, needed_within(1 + 0.5 * (whole - 1)));
    EXPECT_GT(result.cuts->cuts, 0);
    RefineOptions all = needed();
    all.seams = Seams::Rectangles;
    EXPECT_LT(result.boundary_growth, refine(atlas, all).boundary_growth);
  }
}

TEST(Needed, AboveTheLargestStretchAFewCutsKeepIt) {
  for (const Atlas& atlas : {flat_s(), flat_star()}) {
    const double whole = refine(atlas, {}).after.stretch_99;
    RefineOptions options = needed();
    options.max_stretch = 1 + 0.6 * (whole - 1);
    const RefineResult result = refine_soundly(atlas, options);
    EXPECT_LE(result.after.stretch_99, *options.max_stretch * (1 + 1e-5));
    EXPECT_GT(result.cuts->cuts, 0);
    options.max_boundary_growth = 0.01;
    const std::string message = refusal(atlas, options).what();
    EXPECT_NE(message.find("no atlas within a stretch of"), std::string::npos) << message;
    options.best_effort = true;
    EXPECT_FALSE(refine(atlas, options).bound_met);
  }
}

TEST(Needed, ALowerLimitNeedsMoreBoundary) {
  const Atlas atlas = flat_star();
  const double loss = without_cuts(atlas) - 1;
  const RefineResult loose = refine_soundly(atlas, needed_within(1 + 0.8 * loss));
  const RefineResult tight = refine_soundly(atlas, needed_within(1 + 0.2 * loss));
  EXPECT_LT(loose.boundary_growth, tight.boundary_growth);
}

TEST(Needed, ALooserLimitNeedsNoMoreBoundary) {
  for (const Atlas& atlas : {flat_s(), flat_star()}) {
    const double loss = without_cuts(atlas) - 1;
    double before = 0;
    for (const double part : {0.9, 0.75, 0.6, 0.45, 0.3, 0.2}) {
      const double growth = refine_soundly(atlas, needed_within(1 + part * loss)).boundary_growth;
      EXPECT_GE(growth, before) << part;
      before = growth;
    }
  }
}

TEST(Needed, ALargerBudgetIsNeverWorse) {
  for (const Atlas& atlas : {flat_s(), flat_star()}) {
    RefineOptions options = needed();
    options.seam_cost = 0;
    double before = without_cuts(atlas);
    for (const double budget : {0.02, 0.04, 0.06, 0.08, 0.1, 0.15, 0.2, 0.3}) {
      options.max_boundary_growth = budget;
      const double distortion = refine_soundly(atlas, options).after.distortion;
      EXPECT_LE(distortion, before) << budget;
      before = distortion;
    }
    EXPECT_LT(before, without_cuts(atlas));
  }
}

/// More of them than are placed anew for every set of cuts: the path itself squeezes what it passes.
TEST(Needed, ManyChartsKeepTheBudget) {
  std::vector<Atlas> charts;
  for (int k = 0; k < 10; ++k) {
    charts.push_back(k % 2 == 0 ? flat_s() : flat_star());
    for (Vec2& uv : charts.back().corner_uvs) uv.x() += 3 * k;
  }
  const Atlas atlas = shapes::combine(charts);
  RefineOptions options = needed();
  options.seam_cost = 0;
  double before = without_cuts(atlas);
  for (const double budget : {0.01, 0.02, 0.04}) {
    options.max_boundary_growth = budget;
    const double distortion = refine_soundly(atlas, options).after.distortion;
    EXPECT_LE(distortion, before);
    before = distortion;
  }
}

TEST(Needed, AboveTheLimitWhatPromisesNothingIsForecastAsWell) {
  RefineOptions options = needed_within(1.0001);
  options.pe_bound = 0.85;
  options.best_effort = true;
  EXPECT_GT(refine(shapes::mesh(shapes::s_shape(), 0.12, 0), options).cuts->tried, 16);
}

// Teeth longer than the box: no neck shortens them.
TEST(Needed, WhereNothingKeepsTheLimitRectanglesMayBeNearest) {
  shapes::Polygon comb = shapes::comb(4);
  for (Vec2& corner : comb.outer) corner.y() *= 10;
  const Atlas atlas = shapes::mesh(comb, 0.2, 0);
  RefineOptions options = needed_within(1.0001);
  options.box_aspect = 1;
  options.best_effort = true;
  const RefineResult nearest = refine(atlas, options);
  options.seams = Seams::Rectangles;
  options.max_distortion.reset();
  const double by_rectangles = refine(atlas, options).after.distortion;
  EXPECT_LE(nearest.after.distortion, by_rectangles + 1e-9);
}

TEST(Needed, WithoutALimitCutsAreMadeWhereTheyPay) {
  const Atlas atlas = flat_s();
  RefineOptions options = needed();
  options.seam_cost = 10;
  EXPECT_EQ(refine_soundly(atlas, options).added_seams, 0);
  options.seam_cost = 0.01;
  const RefineResult cheap = refine_soundly(atlas, options);
  EXPECT_GT(cheap.added_seams, 0);
  EXPECT_LT(cheap.after.distortion + options.seam_cost * cheap.boundary_growth, without_cuts(atlas));
}

TEST(Needed, WhereSeamsCostNothingTheBudgetIsSpentOnTheLeastDistortion) {
  const Atlas atlas = flat_star();
  RefineOptions options = needed();
  options.max_boundary_growth = 0.3;
  options.seam_cost = 0;
  const RefineResult result = refine_soundly(atlas, options);
  options.best_effort = true;
  options.max_distortion = 1;
  EXPECT_EQ(result.after.distortion, refine(atlas, options).after.distortion);
  EXPECT_LT(result.after.distortion, 1 + 0.7 * (without_cuts(atlas) - 1));
}

/// A ball with a snout and two ears, one face left out, all UVs one point.
Atlas collapsed_head() {
  Atlas atlas = shapes::cube_sphere(8);
  for (Vec3& p : atlas.positions) {
    const double x = p.x(), z = p.z(), front = std::exp((z - 1) / 0.1);
    const double ears = std::exp((0.95 * std::abs(x) + 0.31 * z - 1) / 0.05);
    p *= 1 + 0.25 * std::sin(3 * x + 1) * std::cos(4 * p.y()) + 0.4 * front + ears;
  }
  const std::size_t first_corner = atlas.face_offsets[1];
  atlas.corner_vertices.erase(atlas.corner_vertices.begin(), atlas.corner_vertices.begin() + first_corner);
  atlas.face_offsets.erase(atlas.face_offsets.begin());
  for (int& offset : atlas.face_offsets) offset -= static_cast<int>(first_corner);
  atlas.corner_uvs.assign(atlas.corner_vertices.size(), Vec2(0.5, 0.5));
  return atlas;
}

TEST(Needed, AChartWithHardlyAnyBorderIsCutAllTheSame) {
  // Any cut makes that border many times as long, which says nothing of what it costs.
  const Atlas head = collapsed_head();
  RefineOptions options = needed();
  options.collapsed = Collapsed::Embed;
  const RefineResult result = refine(head, options);
  EXPECT_GT(result.boundary_growth, 5);
  EXPECT_LT(result.after.distortion, 1.15);
  options.seam_cost = 10;
  EXPECT_GT(refine(head, options).after.distortion, 2);
}

TEST(Needed, AlongEdgesTheMeshIsKept) {
  const Atlas atlas = shapes::quad_band(60, 8);
  RefineOptions options = needed_within(1 + 0.6 * (without_cuts(atlas) - 1));
  options.cut = Cut::Edges;
  const RefineResult result = refine_soundly(atlas, options);
  EXPECT_FALSE(result.cut.has_value());
  EXPECT_EQ(result.corner_uvs.size(), atlas.corner_uvs.size());
  EXPECT_GT(result.new_seams.size(), 0u);
}

TEST(Needed, AShortCutThatDoesMoreThanForeseenIsFound) {
  // Straight ways through a band are told longer than its rungs, and ways along it, which follow edges around it, much shorter.
  const Atlas atlas = shapes::quad_band(24, 3, 0.8);
  RefineOptions options = needed_within(1 + 0.5 * (without_cuts(atlas) - 1));
  options.cut = Cut::Edges;
  options.effort = Effort::Normal;
  const RefineResult result = refine_soundly(atlas, options);
  EXPECT_EQ(result.new_seams.size(), 3u);
  options.max_boundary_growth = result.boundary_growth + 1e-6;
  EXPECT_EQ(refine_soundly(atlas, options).new_seams.size(), 3u);
}

TEST(Needed, CutsAlongEdgesAreToldByTheWayThatTheyRun) {
  // The edges across an arc are the shortest cuts: straight chords lie between them, and run along others for the most part.
  for (const double turn_rad : {3, 4}) {
    RefineOptions options = needed_within(1.03);
    options.cut = Cut::Edges;
    options.box_aspect = 1;
    options.effort = Effort::Normal;
    const RefineResult result = refine_soundly(bent_into_arc(sheet(24, 3), turn_rad), options);
    EXPECT_EQ(result.new_seams.size(), 6u) << turn_rad;
  }
}

/// Cuts at a slant leave polygons that are read otherwise than the triangles that were squeezed.
Atlas leaning_arc() {
  Atlas atlas = bent_into_arc(sheet(24, 3), 5);
  for (Vec3& p : atlas.positions) p.x() += 2 * p.y();
  return atlas;
}

TEST(Needed, LimitsAreKeptByWhatIsStored) {
  const Atlas atlas = leaning_arc();
  for (const double most : {1.06, 1.05, 1.04, 1.03, 1.02}) {
    RefineOptions options = needed_within(most);
    options.box_aspect = 1;
    options.effort = Effort::Normal;
    EXPECT_LE(refine_soundly(atlas, options).after.distortion, most);
  }
}

TEST(Needed, WhatCannotBeHadTogetherIsNamed) {
  const Atlas atlas = flat_star();
  RefineOptions options = needed_within(1.0001);
  options.max_boundary_growth = 0.05;
  const RefineError error = refusal(atlas, options);
  EXPECT_EQ(error.code(), ErrorCode::BoundNotReached);
  const std::string words = error.what();
  EXPECT_NE(words.find("boundary growth of 0.05"), std::string::npos) << words;
  EXPECT_NE(words.find("distortion of 1.0001"), std::string::npos) << words;
  options.best_effort = true;
  const RefineResult result = refine(atlas, options);
  EXPECT_FALSE(result.bound_met);
  EXPECT_LE(result.boundary_growth, 0.05 + 1e-9);
  EXPECT_LE(result.after.distortion, without_cuts(atlas) + 1e-6);
  EXPECT_GE(result.after.pe, 0.8);
}

TEST(Needed, ChartsThatKeepTheirShapeAreNotCut) {
  const Atlas atlas = shapes::combine({flat_s(), flat_star()});
  RefineOptions options = needed();
  options.seam_cost = 0.01;
  options.best_effort = true;
  options.keep_shape.assign(atlas.face_count(), 0);
  for (int f = 0; f < flat_s().face_count(); ++f) options.keep_shape[f] = 1;
  const RefineResult result = refine(atlas, options);
  for (const PieceReport& piece : result.pieces) {
    if (result.charts[piece.chart].fate == Fate::Kept) {
      EXPECT_EQ(piece.faces, flat_s().face_count());
    }
  }
}

TEST(Needed, SameBitsOnOneAndTwoThreads) {
  const Atlas atlas = flat_star();
  RefineOptions options = needed_within(1 + 0.5 * (without_cuts(atlas) - 1));
  options.threads = 1;
  const RefineResult one = refine(atlas, options);
  options.threads = 2;
  const RefineResult two = refine(atlas, options);
  EXPECT_TRUE(same_bits(one.corner_uvs, two.corner_uvs));
  EXPECT_GT(one.cuts->cuts, 0);
}

// Of several charts the layout stays; what curves much is relieved by a cut into it, and no chart more.
TEST(Needed, AmongManyChartsTheLayoutStays) {
  std::vector<Atlas> domes;
  for (int k = 0; k < 10; ++k) domes.push_back(shapes::mesh(shapes::disk(0.5 + 0.05 * k, 24), 0.15, 2.0));
  const Atlas atlas = shapes::combine(domes);
  const RefineResult result = refine_soundly(atlas, needed_within(1 + 0.8 * (without_cuts(atlas) - 1)));
  EXPECT_GT(result.cuts->cuts, 0);
  EXPECT_EQ(result.after.chart_count, 10);
}

// What another packing comes to a little below needs no seam.
TEST(Needed, SeveralChartsAreFirstPackedAgain) {
  std::vector<Atlas> flat;
  for (int k = 0; k < 8; ++k) flat.push_back(shapes::mesh(shapes::disk(0.5 + 0.05 * k, 7), 0.2, 0));
  const Atlas atlas = shapes::combine(flat);
  std::vector<double> whole;
  RefineOptions options;
  for (options.seed = 1; options.seed <= 8; ++options.seed) whole.push_back(refine(atlas, options).after.distortion);
  int tried = 0;
  for (std::size_t k = 0; k + 2 < whole.size(); ++k) {
    const double again = std::min(whole[k + 1], whole[k + 2]);
    if (whole[k] < again + 1e-5 || whole[k] > again + 4e-4) continue;
    ++tried;
    options = needed_within(0.5 * (whole[k] + again));
    options.seed = k + 1;
    EXPECT_EQ(refine_soundly(atlas, options).cuts->cuts, 0) << options.seed;
  }
  EXPECT_GT(tried, 0);
}

// The first packing of their pieces comes to a little above the limit: twice as many seams kept it.
TEST(Needed, PiecesThatNearlyKeepTheLimitArePackedAgain) {
  const Atlas star = shapes::mesh(shapes::star(6), 0.12, 0), random = shapes::mesh(shapes::random_star_polygon(2), 0.08, 0);
  EXPECT_LT(refine_soundly(star, needed_within(1 + 0.65 * (without_cuts(star) - 1))).boundary_growth, 0.1);
  EXPECT_LT(refine_soundly(random, needed_within(1 + 0.2 * (without_cuts(random) - 1))).boundary_growth, 0.2);
}

/// A chart, and beside it its mirror image, whose borders begin elsewhere.
Atlas with_image(const Atlas& half) {
  double left = half.positions.front().x();
  for (const Vec3& p : half.positions) left = std::min(left, p.x());
  Atlas own = half, image = half;
  for (Vec3& p : own.positions) p.x() += 1 - left;
  for (std::size_t v = 0; v < own.positions.size(); ++v) {
    image.positions[v] = own.positions[v];
    image.positions[v].x() *= -1;
  }
  for (int f = 0; f < half.face_count(); ++f) {
    const auto first = half.face_offsets[f], end = half.face_offsets[f + 1];
    std::reverse(image.corner_vertices.begin() + first, image.corner_vertices.begin() + end);
    std::reverse(image.corner_uvs.begin() + first, image.corner_uvs.begin() + end);
  }
  for (Vec2& uv : image.corner_uvs) uv.x() *= -1;
  return shapes::combine({own, image});
}

/// Of the cuts' edges those whose image by the middle of all vertices is none of them.
int lopsided_seams(const Atlas& atlas, const RefineResult& result) {
  const std::vector<Vec3> positions = testing::output(atlas, result).positions;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : atlas.positions) middle += p / static_cast<double>(atlas.positions.size());
  std::vector<Vec2> seams;
  for (const auto& [a, b] : result.cut ? result.cut->new_seams : result.new_seams)
    seams.push_back((0.5 * (positions[a] + positions[b]) - middle).head<2>());
  return static_cast<int>(std::count_if(seams.begin(), seams.end(), [&](const Vec2& at) {
    const Vec2 image(-at.x(), at.y());
    return std::none_of(seams.begin(), seams.end(), [&](const Vec2& other) { return (image - other).norm() < 1e-6; });
  }));
}

TEST(Needed, SymmetricMeshesAreCutSymmetrically) {
  for (const Atlas& half : {flat_s(), flat_star()}) {
    const Atlas atlas = with_image(half);
    for (const int threads : {1, 2}) {
      RefineOptions options = needed_within(1 + 0.6 * (without_cuts(atlas) - 1));
      options.threads = threads;
      const RefineResult result = refine_soundly(atlas, options);
      EXPECT_EQ(result.cuts->cuts, 2);
      EXPECT_EQ(lopsided_seams(atlas, result), 0);
    }
  }
}

// Edges of four faces: torn in both copies they are two seams.
TEST(Needed, CopiesInPlaceGrowEachByItsOwnCuts) {
  Atlas atlas = shapes::combine({flat_s(), flat_s()});
  const std::size_t half = atlas.positions.size() / 2;
  std::copy_n(atlas.positions.begin(), half, atlas.positions.begin() + static_cast<std::ptrdiff_t>(half));
  RefineOptions options = needed_within(1 + 0.3 * (without_cuts(atlas) - 1));
  options.stacks = Stacks::Separate;
  const RefineResult result = refine_soundly(atlas, options);
  EXPECT_GT(result.cuts->cuts, 1);
  EXPECT_NEAR(result.boundary_growth, result.cuts->trade_off[result.cuts->chosen].boundary_growth, 1e-6);
}

// Other cuts, into what is pent up, ended with twice the seams and two pieces.
TEST(Needed, TubesAreOpenedByOneStraightCut) {
  for (const double twist_rad : {0.0, 0.25, 0.5}) {
    SCOPED_TRACE(twist_rad);
    const Atlas tube = tube_as_ring(12, 3, twist_rad);
    RefineOptions options = needed();
    options.cut = Cut::Edges;
    const RefineResult result = refine_soundly(tube, options);
    EXPECT_LT(result.after.distortion, 1.001);
    EXPECT_EQ(result.after.chart_count, 1);
    EXPECT_EQ(result.added_seams, 3);
  }
}

TEST(Needed, TheTradeOffHasEveryChoice) {
  const Atlas atlas = flat_s();
  RefineOptions options = needed();
  options.trade_off = true;
  const RefineResult all = refine_soundly(atlas, options);
  const std::vector<TradeOff>& points = all.cuts->trade_off;
  ASSERT_GE(points.size(), 2u);
  EXPECT_EQ(points[0].cuts, 0);
  for (std::size_t k = 1; k < points.size(); ++k) {
    EXPECT_GT(points[k].boundary_growth, points[k - 1].boundary_growth);
    EXPECT_LT(points[k].distortion, points[k - 1].distortion);
  }
  options.point = 1;
  const RefineResult second = refine_soundly(atlas, options);
  EXPECT_EQ(second.cuts->chosen, 1);
  EXPECT_NEAR(second.after.distortion, points[1].distortion, 1e-9);
  EXPECT_NEAR(second.boundary_growth, points[1].boundary_growth, 1e-9);
}

TEST(Needed, APointOfTheTradeOffIsWantedWhateverItsDistortion) {
  RefineOptions options = needed_within(1.00001);
  options.trade_off = true;
  options.point = 0;
  const RefineResult result = refine(flat_s(), options);
  EXPECT_EQ(result.boundary_growth, 0);
  EXPECT_EQ(result.cuts->chosen, 0);
}

void expect_all_points_can_be_had(const Atlas& atlas, RefineOptions options) {
  options.trade_off = true;
  const std::vector<TradeOff> points = refine_soundly(atlas, options).cuts->trade_off;
  for (std::size_t k = 0; k < points.size(); ++k) {
    options.point = static_cast<int>(k);
    const RefineResult result = refine_soundly(atlas, options);
    EXPECT_NEAR(result.after.distortion, points[k].distortion, 1e-9) << k;
    EXPECT_NEAR(result.boundary_growth, points[k].boundary_growth, 1e-9) << k;
  }
}

TEST(Needed, EveryPointOfTheTradeOffCanBeHadAsListed) {
  // Cuts that are nearly mirror images, and would be made so without a trade-off.
  RefineOptions options = needed();
  options.cut = Cut::Edges;
  expect_all_points_can_be_had(with_image(flat_s()), options);
  options = needed();
  options.box_aspect = 1;
  options.max_boundary_growth = 0.25;
  expect_all_points_can_be_had(leaning_arc(), options);
}

// E_d has one scale for all charts: what kept densities cost of it no cut can save.
TEST(Needed, ForecastsAreOfTheDistortionOnTheSurface) {
  Atlas dense = flat_star();
  for (Vec2& uv : dense.corner_uvs) uv = 2 * uv;
  RefineOptions options = needed();
  options.density = Density::Keep;
  options.seam_cost = 0.02;
  const RefineResult result = refine(shapes::combine({flat_s(), dense}), options);
  for (const TradeOff& outcome : result.cuts->trade_off) EXPECT_GT(outcome.distortion, 1.1);
}

TEST(Needed, OptionsOutOfRangeAreRefused) {
  const Atlas atlas = flat_s();
  for (const auto& set : std::vector<void (*)(RefineOptions&)>{
           [](RefineOptions& o) { o.max_boundary_growth = -0.1; }, [](RefineOptions& o) { o.seam_cost = -1; },
           [](RefineOptions& o) { o.seam_cost = std::nan(""); }, [](RefineOptions& o) { o.point = 0; }}) {
    RefineOptions options = needed();
    set(options);
    EXPECT_EQ(refusal(atlas, options).code(), ErrorCode::BadOption);
  }
}

/// Length of edges in space that one face has alone.
double open_length(const Atlas& atlas) {
  std::set<std::pair<int, int>> sides;
  for (int f = 0; f < atlas.face_count(); ++f) {
    const int first = atlas.face_offsets[f], end = atlas.face_offsets[f + 1];
    for (int c = first; c < end; ++c) sides.emplace(atlas.corner_vertices[c], atlas.corner_vertices[c + 1 < end ? c + 1 : first]);
  }
  double length = 0;
  for (const auto& [a, b] : sides) {
    if (!sides.contains({b, a})) length += (atlas.positions[a] - atlas.positions[b]).norm();
  }
  return length;
}

// Where nothing is but a face's long edges cuts begin inside them; whole, a plank 20 x 1 ends at 8.03.
TEST(Needed, ChartsOfOneLongFaceAreCutAcross) {
  RefineOptions options = needed_within(1.05);
  options.box_aspect = 1;
  const Atlas atlas = plank(20);
  const RefineResult result = refine_soundly(atlas, options);
  EXPECT_EQ(result.intervention, Intervention::Cut);
  EXPECT_LT(result.boundary_growth, 0.25);
  options.cut = Cut::Edges;
  EXPECT_EQ(refusal(atlas, options).code(), ErrorCode::BoundNotReached);
}

// The face beyond the seam is divided there too: the mesh stays closed.
TEST(Needed, BesideCutsThroughLongFacesTheMeshStaysClosed) {
  RefineOptions options = needed_within(1.2);
  options.box_aspect = 1;
  const Atlas atlas = tube(4, 20);
  const RefineResult result = refine_soundly(atlas, options);
  EXPECT_EQ(result.intervention, Intervention::Cut);
  EXPECT_NEAR(open_length(atlas), 8, 1e-9);
  EXPECT_NEAR(open_length(testing::output(atlas, result)), 8, 1e-9);
}

}  // namespace
}  // namespace atlas_refine
