// Whole calls on sheets as their makers meant them: nothing torn that was whole, what must be torn is told and counted.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>

#include "atlas_refine/refine.h"
#include "input/places.h"
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

TEST(Sheets, MirroredHalvesAreNoStack) {
  const RefineResult result = refine(mirrored_halves(), {.stacks = Stacks::Keep});
  EXPECT_EQ(result.added_seams, 4);
  for (const ChartReport& chart : result.charts) EXPECT_EQ(chart.fate, Fate::Refined);
}

TEST(Sheets, FrontAndBackAreTwoCharts) {
  for (const Atlas& atlas : {double_sided(5, 4), unwelded(double_sided(5, 4))}) {
    const RefineResult result = refine(atlas, {.stacks = Stacks::Separate});
    EXPECT_EQ(result.charts.size(), 2u);
    EXPECT_EQ(result.added_seams, 0);
    EXPECT_NEAR(result.after.distortion, result.before.distortion, 1e-12);
  }
}

/// Length in space of the edges that one face only has; vertices of equal position are one.
double open_length(const std::vector<Vec3>& positions, const std::vector<int>& offsets, const std::vector<int>& vertices) {
  const std::vector<int> place = places({"", positions, {}, {}, {}});
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

TEST(Sheets, CutsLeaveNoOpenEdgeAroundADoubledPatch) {
  Atlas atlas = sheet(10, 10);
  for (int v = 0; v < 121; ++v) atlas.positions[v].z() = 0.1 * std::sin(v % 11) + 0.1 * std::cos(1.3 * (v / 11));
  for (const int f : {33, 34, 35, 43, 44, 45, 53, 54, 55}) add_double(atlas, atlas, f, false);
  const RefineResult result = refine(atlas, {.pe_bound = 0.9, .seams = Seams::Rectangles});
  ASSERT_EQ(result.intervention, Intervention::Cut);
  std::vector<Vec3> positions = atlas.positions;
  for (const NewVertex& vertex : result.cut->new_vertices) {
    positions.push_back(Vec3::Zero());
    for (int k = 0; k < 3; ++k) positions.back() += vertex.weights[k] * atlas.positions[atlas.corner_vertices[vertex.corners[k]]];
  }
  EXPECT_NEAR(open_length(positions, result.cut->face_offsets, result.cut->corner_vertices),
              open_length(atlas.positions, atlas.face_offsets, atlas.corner_vertices), 1e-9);
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
