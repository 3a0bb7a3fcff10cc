// Whole calls on sheets as their makers meant them: nothing torn that was whole, what must be torn is told and counted.
#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

#include "atlas_refine/refine.h"
#include "input/places.h"
#include "output_atlas.h"
#include "sheets.h"

namespace atlas_refine {
namespace {

bool tells(const std::vector<Repair>& repairs, const std::string& text) {
  return std::any_of(repairs.begin(), repairs.end(), [&](const Repair& repair) { return describe(repair) == text; });
}

/// An L of quads: at 0.75 of its box it has to be bent or cut to reach 0.9.
Atlas l_shape() {
  const Atlas whole = sheet(8, 8);
  Atlas atlas{whole.name, whole.positions, {0}, {}, {}};
  for (int f = 0; f < 64; ++f) {
    if (f % 8 < 4 || f / 8 < 4) add_double(atlas, whole, f, false);
  }
  return atlas;
}

TEST(Sheets, NoiseTearsNothing) {
  for (const Atlas& atlas : {with_noise(l_shape(), 3e-7), with_noise(unwelded(l_shape()), 3e-7)}) {
    const RefineResult squeezed = refine(atlas, {.pe_bound = 0.9});
    EXPECT_EQ(squeezed.intervention, Intervention::Squeezed);
    EXPECT_EQ(squeezed.added_seams, 0);
    EXPECT_EQ(squeezed.after.seam_edges, 0);
    EXPECT_EQ(squeezed.after.chart_count, 1);
    EXPECT_TRUE(squeezed.repairs.empty());
    const RefineResult cut = refine(atlas, {.pe_bound = 0.9, .seams = Seams::Rectangles});
    EXPECT_EQ(cut.intervention, Intervention::Cut);
    EXPECT_EQ(cut.added_seams, cut.after.seam_edges);
  }
  const Atlas good = with_noise(sheet(6, 5), 3e-7);
  EXPECT_EQ(refine(good).intervention, Intervention::Unchanged);
}

TEST(Sheets, CoincidentVerticesTearNothing) {
  Atlas atlas = l_shape();
  atlas.positions[21] = atlas.positions[20];
  for (const Atlas& each : {atlas, unwelded(atlas)}) {
    for (const Seams seams : {Seams::None, Seams::Rectangles}) {
      const RefineResult result = refine(each, {.pe_bound = 0.9, .seams = seams});
      EXPECT_TRUE(result.repairs.empty());
      EXPECT_TRUE(result.fallbacks.empty());
      EXPECT_EQ(result.charts.size(), 1u);
      if (seams == Seams::None) {
        EXPECT_EQ(result.added_seams, 0);
      }
    }
  }
}

TEST(Sheets, MirroredHalvesArePartedToldAndCounted) {
  const RefineResult result = refine(mirrored_halves(), {.stacks = Stacks::Separate});
  EXPECT_EQ(result.after.chart_count, 2);
  EXPECT_EQ(result.added_seams, 4);
  EXPECT_EQ(result.before.seam_edges + 4, result.after.seam_edges);
  EXPECT_TRUE(tells(result.repairs, "charts 0, 1: folded onto each other along 4 edges, parted"));
  EXPECT_TRUE(tells(result.repairs, "chart 0: mirrored, turned over"));
}

/// The L, its upper arm wound the other way round.
Atlas l_shape_of_two_windings() {
  const Atlas whole = l_shape();
  Atlas atlas{whole.name, whole.positions, {0}, {}, {}};
  for (int f = 0; f < whole.face_count(); ++f) add_double(atlas, whole, f, f >= 32);
  return atlas;
}

// By itself, such a piece lies as its faces did in the input, and is no reason to withhold the result.
TEST(Sheets, APieceOfFacesWoundTheOtherWayIsToldToBeMirrored) {
  const Atlas atlas = l_shape_of_two_windings();
  EXPECT_TRUE(validate(atlas).valid());
  const RefineResult result = refine(
      atlas, {.pe_bound = 0.9, .seams = Seams::Rectangles, .cut = Cut::Edges, .prefer_seam = {{36, 37}, {37, 38}, {38, 39}}});
  ASSERT_EQ(result.intervention, Intervention::Cut);
  const Validity validity = validate(testing::output(atlas, result));
  EXPECT_EQ(validity.mirrored_charts, 1);
  EXPECT_EQ(validity.flipped_faces + validity.crossings, 0);
  const auto& warnings = result.warnings;
  EXPECT_TRUE(
      std::any_of(warnings.begin(), warnings.end(), [](const auto& w) { return w.starts_with("1 piece is mirrored: "); }));
}

TEST(Sheets, FrontAndBackAreTwoCharts) {
  for (const Atlas& atlas : {double_sided(5, 4), unwelded(double_sided(5, 4))}) {
    const RefineResult result = refine(atlas, {.stacks = Stacks::Separate});
    EXPECT_EQ(result.charts.size(), 2u);
    EXPECT_EQ(result.added_seams, 0);
    EXPECT_NEAR(result.after.distortion, result.before.distortion, 1e-12);
  }
}

/// Length in space of the edges that one face only has; `place` tells which vertices are one.
double open_length(const std::vector<Vec3>& positions, const std::vector<int>& offsets, const std::vector<int>& vertices,
                   const std::vector<int>& place) {
  std::map<std::pair<int, int>, int> faces;
  for (std::size_t f = 0; f + 1 < offsets.size(); ++f) {
    for (int c = offsets[f]; c < offsets[f + 1]; ++c) {
      const int next = c + 1 < offsets[f + 1] ? c + 1 : offsets[f];
      ++faces[std::minmax(place[vertices[c]], place[vertices[next]])];
    }
  }
  double length = 0;
  for (const auto& [ends, count] : faces) {
    if (count == 1) length += (positions[ends.first] - positions[ends.second]).norm();
  }
  return length;
}

/// Cuts open no edge in space, neither by the vertices that faces have nor by their positions.
void expect_closed_as_before(const Atlas& before, const RefineResult& result) {
  const Atlas after = testing::output(before, result);
  const auto open = [](const Atlas& atlas, const std::vector<int>& place) {
    return open_length(atlas.positions, atlas.face_offsets, atlas.corner_vertices, place);
  };
  const auto by_index = [](const Atlas& atlas) {
    std::vector<int> out(atlas.positions.size());
    std::iota(out.begin(), out.end(), 0);
    return out;
  };
  EXPECT_NEAR(open(after, places(after)), open(before, places(before)), 1e-9);
  EXPECT_NEAR(open(after, by_index(after)), open(before, by_index(before)), 1e-9);
}

/// A sheet that is nowhere flat.
Atlas wavy_sheet(int columns, int rows) {
  Atlas atlas = sheet(columns, rows);
  for (int v = 0; v < static_cast<int>(atlas.positions.size()); ++v)
    atlas.positions[v].z() = 0.1 * std::sin(v % (columns + 1)) + 0.1 * std::cos(1.3 * (v / (columns + 1)));
  return atlas;
}

TEST(Sheets, CutsLeaveNoOpenEdgeAroundADoubledPatch) {
  Atlas atlas = wavy_sheet(10, 10);
  for (const int f : {33, 34, 35, 43, 44, 45, 53, 54, 55}) add_double(atlas, atlas, f, false);
  const RefineResult result = refine(atlas, {.pe_bound = 0.9, .seams = Seams::Rectangles});
  ASSERT_EQ(result.intervention, Intervention::Cut);
  expect_closed_as_before(atlas, result);
}

// A trail runs along an edge where three faces meet, which another chart's cut divides.
TEST(Sheets, CutsMeetAtADoubledStrip) {
  Atlas atlas = sheet(8, 8);
  for (int v = 0; v < 81; ++v) atlas.positions[v].z() = 0.03 * std::sin(v % 9) * std::cos(0.7 * (v / 9));
  for (const int f : {17, 25, 33, 41}) add_double(atlas, atlas, f, false);
  const RefineResult result = refine(atlas, {.seams = Seams::Rectangles, .box_aspect = 2});
  ASSERT_EQ(result.intervention, Intervention::Cut);
  expect_closed_as_before(atlas, result);
}

/// Two C-shaped charts that meet back to back, and the same elsewhere in space with the same UVs. Cuts that start at
/// the corners run across quads and end between vertices of the line where they meet.
Atlas stacked_neighbours() {
  Atlas grid = sheet(16, 12);
  // Rows of quads are not where the corners are.
  const auto bend = [](int v) { return 0.04 * std::sin(v / 17 * std::numbers::pi / 3) * (v % 17 >= 5 && v % 17 < 12); };
  for (int v = 0; v < 17 * 13; ++v) grid.positions[v] += Vec3(0, bend(v), 0.02 * std::sin(v % 17));
  Atlas atlas;
  atlas.face_offsets = {0};
  for (const double z : {0.0, 9.0}) {
    const int first = static_cast<int>(atlas.positions.size());
    for (const Vec3& p : grid.positions) atlas.positions.push_back(p + Vec3(0, 0, z));
    for (int f = 0; f < grid.face_count(); ++f) {
      const int i = f % 16, j = f / 16;
      if (j >= 5 && j < 7 && (i < 4 || i >= 12)) continue;
      std::vector<int> vertices;
      std::vector<Vec2> uvs;
      for (int c = grid.face_offsets[f]; c < grid.face_offsets[f + 1]; ++c) {
        const int v = grid.corner_vertices[c];
        vertices.push_back(first + v);
        uvs.push_back(grid.corner_uvs[c] + Vec2(i < 8 ? 0 : 1, bend(v)));
      }
      add_face(atlas, vertices, uvs);
    }
  }
  return atlas;
}

TEST(Sheets, StackedNeighboursStayClosedWhereTheyFollowCuts) {
  const Atlas atlas = stacked_neighbours();
  const RefineResult result = refine(atlas, {.pe_bound = 0.9, .seams = Seams::Rectangles});
  ASSERT_EQ(result.intervention, Intervention::Cut);
  EXPECT_EQ(result.charts[2].fate, Fate::Stacked);
  expect_closed_as_before(atlas, result);
}

TEST(Sheets, APinchIsLeftAloneWhereChartsAreButMoved) {
  const Atlas atlas = pinched_sheet();
  EXPECT_EQ(refine(atlas, {.pe_bound = 0.9}).intervention, Intervention::Unchanged);
  EXPECT_EQ(refine(atlas, {.pe_bound = 0.9, .seams = Seams::Rectangles}).intervention, Intervention::Unchanged);
  Atlas turned = atlas;
  for (Vec2& uv : turned.corner_uvs) uv = Vec2(0.8 * uv.x() - 0.6 * uv.y(), 0.6 * uv.x() + 0.8 * uv.y());
  const RefineResult moved = refine(turned, {.pe_bound = 0.9});
  EXPECT_EQ(moved.intervention, Intervention::Moved);
  EXPECT_TRUE(moved.repairs.empty());
  EXPECT_NEAR(moved.after.distortion_to_input, 1, 1e-9);
}

TEST(Sheets, APinchIsPartedBeforeASqueeze) {
  const RefineResult result = refine(pinched_sheet(), {.pe_bound = 0.97});
  EXPECT_EQ(result.intervention, Intervention::Squeezed);
  EXPECT_EQ(result.added_seams, 0);
  EXPECT_EQ(result.after.chart_count, 1);
  ASSERT_EQ(result.repairs.size(), 1u);
  EXPECT_EQ(result.repairs[0].what, "touched itself, touching borders drawn apart");
  EXPECT_FALSE(result.charts[0].re_embedded);
}

}  // namespace
}  // namespace atlas_refine
