// Cuts along existing edges as a whole, by the public measures: the mesh is kept, only its own edges become seams.
#include <algorithm>
#include <array>
#include <set>

#include "cut_checks.h"
#include "polygon_sheets.h"
#include "refine_checks.h"

namespace atlas_refine {
namespace {

using Edge = std::pair<int, int>;

RefineOptions along_edges(double pe_bound = 0.8) {
  RefineOptions options;
  options.pe_bound = pe_bound;
  options.seams = Seams::Rectangles;
  options.cut = Cut::Edges;
  options.rectangles.candidates = 40;
  return options;
}

/// The edges of polygons at which two faces meet with equal UVs.
std::set<Edge> whole_edges(const Atlas& atlas, const std::vector<Vec2>& uvs) {
  std::map<Edge, std::vector<std::array<Vec2, 2>>> sides;
  for (int f = 0; f < atlas.face_count(); ++f) {
    const int begin = atlas.face_offsets[f], end = atlas.face_offsets[f + 1];
    for (int c = begin; c < end; ++c) {
      const int next = c + 1 < end ? c + 1 : begin;
      const int a = atlas.corner_vertices[c], b = atlas.corner_vertices[next];
      const Edge edge = std::minmax(a, b);
      sides[edge].push_back(a < b ? std::array{uvs[c], uvs[next]} : std::array{uvs[next], uvs[c]});
    }
  }
  std::set<Edge> out;
  for (const auto& [edge, both] : sides) {
    if (both.size() == 2 && both[0] == both[1]) out.insert(edge);
  }
  return out;
}

std::set<Edge> new_seams(const RefineResult& result) {
  std::set<Edge> out;
  for (const auto& [a, b] : result.new_seams) out.insert(std::minmax(a, b));
  return out;
}

/// No face divided, and the new seams are exactly the edges that are torn.
std::set<Edge> expect_mesh_kept(const Atlas& atlas, const RefineResult& result) {
  EXPECT_FALSE(result.cut.has_value());
  EXPECT_EQ(result.corner_uvs.size(), atlas.corner_uvs.size());
  std::set<Edge> torn;
  const std::set<Edge> before = whole_edges(atlas, atlas.corner_uvs), left = whole_edges(atlas, result.corner_uvs);
  std::set_difference(before.begin(), before.end(), left.begin(), left.end(), std::inserter(torn, torn.end()));
  EXPECT_EQ(new_seams(result), torn);
  EXPECT_EQ(result.new_seams.size(), torn.size()) << "a seam is named twice";
  EXPECT_EQ(result.intervention == Intervention::Cut, !torn.empty());
  return torn;
}

/// Refines and checks: the mesh is kept, all else as always.
RefineResult cut_soundly(const Atlas& atlas, const RefineOptions& options) {
  RefineResult result;
  try {
    result = refine(atlas, options);
  } catch (const RefineError& error) {
    ADD_FAILURE() << to_string(error.code()) << ": " << error.what();
    return result;
  }
  const std::set<Edge> torn = expect_mesh_kept(atlas, result);
  const Atlas after = testing::with_corner_uvs(atlas, result.corner_uvs);
  const Validity validity = validate(after);
  EXPECT_TRUE(validity.valid()) << validity.problem;
  EXPECT_TRUE(result.bound_met);
  const Measures m = measure(after, options.box_aspect);
  EXPECT_GE(m.pe_fixed_aspect, options.pe_bound);
  EXPECT_EQ(m.pe, result.after.pe);
  EXPECT_EQ(m.chart_count, result.after.chart_count);
  if (m.chart_count > 1 && result.gap.value > 0) {
    EXPECT_GE(testing::gap_in_unit(m, result.gap, options.box_aspect), result.gap.value * (1 - 1e-9));
  }
  EXPECT_EQ(result.pieces.size(), torn.empty() ? 0 : static_cast<std::size_t>(m.chart_count));
  return result;
}

std::vector<std::array<int, 2>> pairs(const std::set<Edge>& edges) {
  std::vector<std::array<int, 2>> out;
  for (const auto& [a, b] : edges) out.push_back({a, b});
  return out;
}

TEST(RefineEdges, EveryAtlasKeepsItsMesh) {
  const std::vector<Atlas> atlases = testing::many_atlases();
  int cut = 0;
  for (std::size_t k = 0; k < atlases.size(); ++k) {
    SCOPED_TRACE("atlas " + std::to_string(k));
    const RefineResult result = cut_soundly(atlases[k], along_edges());
    EXPECT_LT(result.after.distortion, std::max(1.1, 1.02 * result.before.distortion));
    cut += result.intervention == Intervention::Cut;
  }
  EXPECT_GE(2 * cut, static_cast<int>(atlases.size()));
}

TEST(RefineEdges, QuadsAndLargerPolygonsAreCutBetweenThem) {
  for (const Atlas& atlas :
       {testing::quads(testing::l_cells(4)), testing::bricks(testing::l_cells(4)), testing::bricks(testing::l_cells(5))}) {
    const RefineResult result = cut_soundly(atlas, along_edges());
    EXPECT_EQ(result.intervention, Intervention::Cut);
    EXPECT_EQ(result.after.chart_count, 2);
  }
}

TEST(RefineEdges, ACubeInOneChartIsCutAtItsEdges) {
  const RefineResult result = cut_soundly(testing::cube_cross(), along_edges());
  EXPECT_EQ(result.intervention, Intervention::Cut);
  EXPECT_GE(result.after.chart_count, 2);
  EXPECT_LT(result.after.distortion, 1.01);
}

TEST(RefineEdges, AFewQuadsAreCutWhereTheyCanBe) {
  const Atlas atlas = testing::quads(testing::l_cells(1));
  EXPECT_EQ(cut_soundly(atlas, along_edges(0.9)).after.chart_count, 2);
}

TEST(RefineEdges, ChartsWithHolesAreTakenApart) {
  const auto window = testing::cells_where(12, [](int x, int y) { return x < 3 || x > 8 || y < 3 || y > 8; });
  const RefineResult result = cut_soundly(testing::quads(window), along_edges());
  EXPECT_EQ(result.intervention, Intervention::Cut);
  // A slit from the hole to the border that parts nothing would be a seam for nothing.
  for (const PieceReport& piece : result.pieces) EXPECT_LT(piece.faces, 108);
}

TEST(RefineEdges, ThreadsChangeNoBit) {
  const Atlas atlas = shapes::combine({shapes::mesh(shapes::star(), 0.1), shapes::mesh(shapes::comb(), 0.1)});
  RefineOptions options = along_edges();
  options.threads = 1;
  const RefineResult one = refine(atlas, options);
  options.threads = 4;
  const RefineResult four = refine(atlas, options);
  EXPECT_EQ(one.intervention, Intervention::Cut);
  EXPECT_TRUE(testing::same_bits(one.corner_uvs, four.corner_uvs));
  EXPECT_EQ(one.new_seams, four.new_seams);
}

TEST(RefineEdges, EdgesWithoutSeamsStayWhole) {
  const Atlas atlas = testing::quads(testing::l_cells(5));
  RefineOptions options = along_edges();
  for (int round = 0; round < 2; ++round) {
    const RefineResult result = cut_soundly(atlas, options);
    ASSERT_EQ(result.intervention, Intervention::Cut);
    const std::vector<std::array<int, 2>> seams = pairs(new_seams(result));
    for (const auto& edge : seams)
      EXPECT_EQ(std::find(options.no_seam.begin(), options.no_seam.end(), edge), options.no_seam.end());
    options.no_seam.insert(options.no_seam.end(), seams.begin(), seams.end());
  }
}

TEST(RefineEdges, WhereEveryEdgeMustStayWholeNothingIsCut) {
  const Atlas atlas = testing::quads(testing::l_cells(4));
  RefineOptions options = along_edges();
  options.no_seam = pairs(whole_edges(atlas, atlas.corner_uvs));
  const RefineResult result = cut_soundly(atlas, options);
  EXPECT_EQ(result.intervention, Intervention::Squeezed);
  ASSERT_EQ(result.fallbacks.size(), 1);
  EXPECT_EQ(result.fallbacks[0], "charts were not cut into rectangles: along edges no more than slivers can be cut off");
}

TEST(RefineEdges, EdgesThatAreWantedAreTakenAsFarFromATrailAsAThirdOfItsLength) {
  const Atlas atlas = testing::quads(testing::l_cells(6));
  RefineOptions options = along_edges();
  const std::set<Edge> straight = new_seams(cut_soundly(atlas, options));
  ASSERT_EQ(straight.size(), 6);
  const auto at = [&](int vertex) { return atlas.positions[vertex].head<2>(); };
  const bool upright = at(straight.begin()->first).x() == at(straight.begin()->second).x();
  for (const int line : {7, 8}) {
    // The same line further into the leg.
    std::set<Edge> wanted;
    for (const Edge& edge : whole_edges(atlas, atlas.corner_uvs)) {
      const Vec2 a = at(edge.first), b = at(edge.second);
      if (upright ? a.x() == line && b.x() == line : a.y() == line && b.y() == line) wanted.insert(edge);
    }
    ASSERT_EQ(wanted.size(), 6);
    options.prefer_seam = pairs(wanted);
    EXPECT_EQ(new_seams(cut_soundly(atlas, options)), wanted) << "line " << line;
  }
}

TEST(RefineEdges, UntilInputStopsWhereTheBoundHolds) {
  const Atlas atlas = shapes::mesh(shapes::star(), 0.1);
  RefineOptions options = along_edges(0.6);
  options.rectangles.until_input = true;
  const RefineResult result = cut_soundly(atlas, options);
  EXPECT_LE(result.after.distortion, result.before.distortion + 1e-9);
}

TEST(RefineEdges, AStatedGapAspectAndPrecisionHold) {
  RefineOptions options = along_edges();
  options.gap = Gap{4.0 / 512, Gap::Unit::LongSide};
  options.box_aspect = 1;
  options.stored = Stored::Float32;
  const RefineResult result = cut_soundly(shapes::mesh(shapes::star(), 0.1), options);
  EXPECT_EQ(result.gap.value, options.gap->value);
}

TEST(RefineEdges, KeptDensitiesAreTheInputs) {
  const Atlas atlas = shapes::combine(
      {shapes::mesh(shapes::star(), 0.1), shapes::mesh(shapes::transformed(shapes::comb(), 0.5, 0, {2, 0}), 0.05)});
  RefineOptions options = along_edges();
  options.density = Density::Keep;
  const RefineResult result = cut_soundly(atlas, options);
  for (const ChartReport& chart : result.charts) EXPECT_NEAR(chart.density_after / chart.density_before, 1, 0.05);
}

TEST(RefineEdges, AStackIsCutAtTheSameEdges) {
  const Atlas sheet = testing::quads(testing::l_cells(4));
  const RefineResult result = refine(shapes::combine({sheet, sheet}), along_edges());
  const std::set<Edge> torn = expect_mesh_kept(shapes::combine({sheet, sheet}), result);
  ASSERT_EQ(result.charts[1].fate, Fate::Stacked);
  const std::size_t corners = sheet.corner_uvs.size();
  EXPECT_EQ(torn.size(), 8);
  for (std::size_t c = 0; c < corners; ++c) EXPECT_EQ(result.corner_uvs[c], result.corner_uvs[corners + c]);
}

TEST(RefineEdges, GroupsAreCutEachByItself) {
  const Atlas sheet = testing::quads(testing::l_cells(4));
  const Atlas both = shapes::combine({sheet, testing::bricks(testing::l_cells(4))});
  RefineOptions options = along_edges();
  options.groups.assign(both.face_count(), 1);
  std::fill(options.groups.begin(), options.groups.begin() + sheet.face_count(), 0);
  const RefineResult result = refine(both, options);
  expect_mesh_kept(both, result);
  ASSERT_EQ(result.groups.size(), 2);
  for (const GroupReport& group : result.groups) EXPECT_EQ(group.intervention, Intervention::Cut);
}

TEST(RefineEdges, EdgesThatAreNoVerticesAreRefused) {
  const Atlas atlas = unit_square();
  for (const std::array<int, 2>& edge : {std::array{0, 4}, std::array{-1, 1}}) {
    RefineOptions options = along_edges();
    options.no_seam = {edge};
    EXPECT_EQ(testing::refusal(atlas, options).code(), ErrorCode::BadOption);
    options.no_seam.clear();
    options.prefer_seam = {edge};
    EXPECT_EQ(testing::refusal(atlas, options).code(), ErrorCode::BadOption);
  }
}

// From the corner of an L there are two ways across: each is taken where no seam is wanted along the other.
TEST(RefineRectangles, TrailsKeepOffEdgesWithoutSeamsWhereOthersHoldTheBound) {
  const Atlas atlas = testing::quads(testing::l_cells(4));
  RefineOptions options = along_edges();
  options.cut = Cut::Split;
  for (const int axis : {0, 1}) {
    const auto in_the_way = [&](int v) {
      const Vec3& p = atlas.positions[v];
      return p[axis] <= 3 && p[1 - axis] >= 3 && p[1 - axis] <= 5;
    };
    std::set<Edge> avoided;
    for (const auto& [a, b] : whole_edges(atlas, atlas.corner_uvs)) {
      if (in_the_way(a) && in_the_way(b)) avoided.insert({a, b});
    }
    options.no_seam = pairs(avoided);
    const RefineResult result = refine(atlas, options);
    EXPECT_EQ(result.intervention, Intervention::Cut);
    EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
  }
}

TEST(RefineRectangles, ATrailAcrossEdgesWithoutSeamsIsTold) {
  const Atlas atlas = testing::quads(testing::l_cells(4));
  RefineOptions options = along_edges();
  options.cut = Cut::Split;
  EXPECT_TRUE(refine(atlas, options).warnings.empty());
  options.no_seam = pairs(whole_edges(atlas, atlas.corner_uvs));
  const RefineResult result = refine(atlas, options);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_TRUE(result.warnings.front().ends_with("where no seam is wanted")) << result.warnings.front();
}

}  // namespace
}  // namespace atlas_refine
