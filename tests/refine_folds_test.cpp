// Whole calls on charts that are folded onto themselves: halves that a Mirror modifier has made stay on each other and joined.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "atlas_refine/refine.h"
#include "input/split_charts.h"
#include "output_atlas.h"
#include "refine_checks.h"
#include "sheets.h"

namespace atlas_refine {
namespace {

using testing::says;

constexpr int kSide = 8;  // cells: there are as many edges along a mirror

/// An L that is nowhere flat, with edges at x = 0 and y = 0: at 0.75 of its box it has to be bent or cut to reach 0.9.
Atlas half() {
  Atlas whole = sheet(kSide, kSide);
  for (Vec3& p : whole.positions) p.z() = 0.06 * std::sin(9 * p.x() + 1) * std::cos(7 * p.y());
  Atlas atlas{whole.name, whole.positions, {0}, {}, {}};
  for (int f = 0; f < kSide * kSide; ++f) {
    if (f % kSide < kSide / 2 || f / kSide < kSide / 2) add_double(atlas, whole, f, false);
  }
  return atlas;
}

int stacked(const RefineResult& result) {
  return static_cast<int>(std::count_if(result.charts.begin(), result.charts.end(),
                                        [](const ChartReport& chart) { return chart.fate == Fate::Stacked; }));
}

/// Nothing is torn or told to be, and every corner of a mirrored face lies on the one that it is the image of.
void expect_halves_on_each_other(const Atlas& atlas, const RefineResult& result) {
  EXPECT_EQ(result.added_seams, 0);
  EXPECT_EQ(result.after.seam_edges, result.before.seam_edges);
  for (const Repair& repair : result.repairs) EXPECT_EQ(repair.what.find("parted"), std::string::npos) << describe(repair);
  for (int f = 0; f < atlas.face_count() / 2; ++f) {
    const int begin = atlas.face_offsets[f], end = atlas.face_offsets[f + 1];
    for (int c = begin; c < end; ++c) {
      const Vec2& image = result.corner_uvs[atlas.corner_count() / 2 + begin + end - 1 - c];
      ASSERT_EQ(result.corner_uvs[c], image);
    }
  }
}

TEST(Folds, MirroredHalvesStayOnEachOtherAndJoined) {
  const Atlas atlas = with_mirror(half(), 0);
  for (const Atlas& each : {atlas, unwelded(atlas), with_noise(atlas, 3e-7)}) {
    const RefineResult result = refine(each, {.pe_bound = 0.9});
    EXPECT_EQ(result.intervention, Intervention::Squeezed);
    EXPECT_EQ(stacked(result), 1);
    EXPECT_EQ(result.before.seam_edges, 0);
    expect_halves_on_each_other(each, result);
    EXPECT_EQ(split_charts(testing::output(each, result), Joining::Exact).charts.size(), 1u);
    // As much of the texture as the half by itself.
    EXPECT_NEAR(result.before.pe, 0.75, 1e-5);
    EXPECT_EQ(result.after.pe, measure(testing::output(each, result)).pe);
    EXPECT_EQ(result.after.chart_count, 1);
  }
}

TEST(Folds, AHalfThatHoldsStaysAsItIs) {
  const RefineResult result = refine(mirrored_halves());
  EXPECT_EQ(result.intervention, Intervention::Unchanged);
  EXPECT_NEAR(result.after.pe, 1, 1e-9);
  EXPECT_EQ(result.added_seams, 0);
}

TEST(Folds, QuartersStayOnEachOther) {
  const Atlas atlas = with_mirror(with_mirror(half(), 0), 1);
  const RefineResult result = refine(atlas, {.pe_bound = 0.9});
  EXPECT_EQ(stacked(result), 3);
  expect_halves_on_each_other(atlas, result);
  EXPECT_EQ(split_charts(testing::output(atlas, result), Joining::Exact).charts.size(), 1u);
}

TEST(Folds, AStripFoldedManyTimesStaysOnItself) {
  Atlas atlas = sheet(24, 1);
  for (int c = 0; c < atlas.corner_count(); ++c) {
    const int step = atlas.corner_vertices[c] % 25 % 8;
    atlas.corner_uvs[c] = Vec2(0.1 * std::min(step, 8 - step), 2 * atlas.corner_uvs[c].y());
  }
  const RefineResult result = refine(atlas, {.box_aspect = 1, .relax = true});
  EXPECT_EQ(stacked(result), 5);
  EXPECT_EQ(result.added_seams, 0);
  EXPECT_EQ(result.after.seam_edges, 0);
}

TEST(Folds, ArePartedWhereStacksAre) {
  const RefineResult result = refine(with_mirror(half(), 0), {.pe_bound = 0.7, .stacks = Stacks::Separate});
  EXPECT_EQ(stacked(result), 0);
  EXPECT_EQ(result.added_seams, kSide);
  EXPECT_EQ(result.after.seam_edges, kSide);
  EXPECT_EQ(result.after.chart_count, 2);
}

TEST(Folds, HalvesOfOtherMaterialsAreParted) {
  const Atlas atlas = with_mirror(half(), 0);
  std::vector<int> materials(atlas.face_count(), 0);
  std::fill(materials.begin() + atlas.face_count() / 2, materials.end(), 1);
  const RefineResult result = refine(atlas, {.pe_bound = 0.7, .stack_groups = materials});
  EXPECT_EQ(stacked(result), 0);
  EXPECT_EQ(result.added_seams, kSide);
}

TEST(Folds, PartsThatAreNoCopiesAreParted) {
  Atlas atlas = sheet(7, 4);  // three columns on four
  for (Vec2& uv : atlas.corner_uvs) uv.x() = std::abs(uv.x() - 0.3);
  const RefineResult result = refine(atlas, {.pe_bound = 0.7});
  EXPECT_EQ(stacked(result), 0);
  EXPECT_EQ(result.added_seams, 4);
  EXPECT_EQ(result.after.chart_count, 2);
}

/// Three sheets: the first and the last are alike, that between them has twice as many columns.
Atlas other_columns_between() {
  Atlas atlas = sheet(16, 3);
  for (int c = 0; c < atlas.corner_count(); ++c) {
    const int i = atlas.corner_vertices[c] % 17;
    atlas.corner_uvs[c].x() = i < 4 ? 0.1 * i : i < 12 ? 0.05 * (12 - i) : 0.1 * (i - 12);
  }
  return atlas;
}

TEST(Folds, CopiesThatOnlyAnotherPartHoldsTogetherAreParted) {
  const RefineResult result = refine(other_columns_between(), {.pe_bound = 0.7});
  EXPECT_EQ(stacked(result), 0);
  EXPECT_EQ(result.added_seams, 6);
  EXPECT_EQ(result.after.chart_count, 3);
}

TEST(Folds, ALockedHalfHoldsTheOther) {
  Atlas atlas = with_mirror(half(), 0);
  for (Vec2& uv : atlas.corner_uvs) uv *= 0.6;
  std::vector<char> flags(atlas.face_count(), 0);
  std::fill(flags.begin() + atlas.face_count() / 2, flags.end(), 1);
  Atlas with_other = atlas;  // which has to move
  const int first = static_cast<int>(with_other.positions.size());
  for (const Vec3& p : {Vec3(3, 0, 0), Vec3(4, 0, 0), Vec3(4, 1, 0), Vec3(3, 1, 0)}) with_other.positions.push_back(p);
  add_face(with_other, {first, first + 1, first + 2, first + 3}, {{0.1, 0.1}, {0.3, 0.1}, {0.3, 0.3}, {0.1, 0.3}});
  flags.push_back(0);
  const RefineResult result = refine(with_other, {.pe_bound = 0.2, .locked = flags});
  EXPECT_NE(result.intervention, Intervention::Unchanged);
  EXPECT_EQ(stacked(result), 1);
  EXPECT_EQ(result.added_seams, 0);
  EXPECT_TRUE(std::equal(atlas.corner_uvs.begin(), atlas.corner_uvs.end(), result.corner_uvs.begin()));
}

TEST(Folds, AKeptShapeIsKeptOnBothSides) {
  const Atlas atlas = with_mirror(half(), 0);
  std::vector<char> flags(atlas.face_count(), 0);
  std::fill(flags.begin() + atlas.face_count() / 2, flags.end(), 1);
  const RefineResult result = refine(atlas, {.pe_bound = 0.5, .box_aspect = 1.5, .relax = true, .keep_shape = flags});
  expect_halves_on_each_other(atlas, result);
  EXPECT_NEAR(result.after.distortion_to_input, 1, 1e-9);
}

/// Both halves have the same cuts, and the line between them is none.
TEST(Folds, AreCutAlike) {
  const Atlas atlas = with_mirror(half(), 0);
  for (const Cut cut : {Cut::Split, Cut::Edges}) {
    for (const Seams seams : {Seams::Rectangles, Seams::Needed}) {
      const RefineResult result =
          refine(atlas, {.pe_bound = 0.95, .seams = seams, .max_distortion = 1.004, .best_effort = true, .cut = cut});
      ASSERT_EQ(result.intervention, Intervention::Cut);
      EXPECT_EQ(stacked(result), 1);
      EXPECT_GT(result.added_seams, 0);
      EXPECT_EQ(result.added_seams % 2, 0);
      EXPECT_EQ(result.after.seam_edges, result.added_seams);
      for (const Repair& repair : result.repairs) EXPECT_EQ(repair.what.find("parted"), std::string::npos);
    }
  }
}

TEST(Folds, AHalfOfOtherPolygonsIsPartedOnlyWhereItIsCut) {
  Atlas atlas = half();
  const Atlas whole = with_mirror(atlas, 0);
  for (int f = atlas.face_count(); f < whole.face_count(); ++f) {
    const int begin = whole.face_offsets[f];
    for (const auto& corners : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
      std::vector<int> vertices;
      std::vector<Vec2> uvs;
      for (const int k : corners) {
        vertices.push_back(whole.corner_vertices[begin + k]);
        uvs.push_back(whole.corner_uvs[begin + k]);
      }
      add_face(atlas, vertices, uvs);
    }
  }
  atlas.positions = whole.positions;
  const RefineResult squeezed = refine(atlas, {.pe_bound = 0.9});
  EXPECT_EQ(stacked(squeezed), 1);
  EXPECT_EQ(squeezed.added_seams, 0);
  const RefineResult cut = refine(atlas, {.pe_bound = 0.9, .seams = Seams::Rectangles});
  ASSERT_EQ(cut.intervention, Intervention::Cut);
  EXPECT_EQ(stacked(cut), 0);
  EXPECT_TRUE(says(cut.warnings, "placed apart"));
  EXPECT_EQ(cut.added_seams, cut.after.seam_edges);
}

TEST(Folds, EdgesThatHalvesArePartedAlongAreNewSeams) {
  const Atlas atlas = with_mirror(half(), 0);
  RefineOptions options{.pe_bound = 0.9, .stacks = Stacks::Separate};
  for (const Seams seams : {Seams::None, Seams::Rectangles}) {
    options.seams = seams;
    const RefineResult result = refine(atlas, options);
    const auto& new_seams = result.cut ? result.cut->new_seams : result.new_seams;
    const auto on_mirror = [&](const std::array<int, 2>& edge) {
      return std::all_of(edge.begin(), edge.end(),
                         [&](int v) { return v < static_cast<int>(atlas.positions.size()) && atlas.positions[v].x() == 0; });
    };
    EXPECT_EQ(std::count_if(new_seams.begin(), new_seams.end(), on_mirror), kSide);
    if (!result.cut) EXPECT_EQ(result.new_seams.size(), static_cast<std::size_t>(result.added_seams));
  }
}

}  // namespace
}  // namespace atlas_refine
