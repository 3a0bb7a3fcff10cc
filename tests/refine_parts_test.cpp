// Who takes part: charts without UV area, faces without UVs, stacks, groups, tiles; what stays keeps its bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include "atlas_refine/inspect.h"
#include "atlas_refine/refine.h"
#include "output_atlas.h"
#include "refine_checks.h"
#include "shapes.h"
#include "sheets.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

using testing::says;

const double kNaN = std::numeric_limits<double>::quiet_NaN();

Atlas star(double bend = 0.5) { return shapes::mesh(shapes::star(), 0.1, bend); }

/// All UVs of an atlas moved.
Atlas moved(Atlas atlas, const Vec2& by) {
  for (Vec2& uv : atlas.corner_uvs) uv += by;
  return atlas;
}

Atlas on_point(Atlas atlas, const Vec2& point) {
  for (Vec2& uv : atlas.corner_uvs) uv = point;
  return atlas;
}

bool same_bits(const Vec2& a, const Vec2& b) { return std::memcmp(a.data(), b.data(), 2 * sizeof(double)) == 0; }

/// Corners [first, end) hold their input's bits.
bool kept_bits(const Atlas& atlas, const RefineResult& result, int first, int end) {
  for (int c = first; c < end; ++c) {
    if (!same_bits(atlas.corner_uvs[c], result.corner_uvs[c])) return false;
  }
  return true;
}

/// The faces [first, end) with these UVs as an atlas of their own.
Atlas part(const Atlas& atlas, const std::vector<Vec2>& uvs, int first, int end) {
  Atlas out{.name = "", .positions = atlas.positions, .face_offsets = {0}, .corner_vertices = {}, .corner_uvs = {}};
  for (int f = first; f < end; ++f) {
    for (int c = atlas.face_offsets[f]; c < atlas.face_offsets[f + 1]; ++c) {
      out.corner_vertices.push_back(atlas.corner_vertices[c]);
      out.corner_uvs.push_back(uvs[c]);
    }
    out.face_offsets.push_back(out.corner_count());
  }
  return out;
}

TEST(Parts, ACollapsedChartStaysAsItIsAndIsCounted) {
  const Atlas one = star(), other = on_point(shapes::quad_grid(3, 3), {0.25, 0.75});
  const Atlas atlas = shapes::combine({one, other, moved(star(), {2, 0})});
  const RefineResult result = refine(atlas, {.pe_bound = 0.75});
  EXPECT_TRUE(result.bound_met);
  ASSERT_EQ(result.charts.size(), 3u);
  EXPECT_EQ(result.charts[0].fate, Fate::Refined);
  EXPECT_EQ(result.charts[1].fate, Fate::Left);
  EXPECT_EQ(result.charts[1].reason, "has no area in the UV map");
  EXPECT_TRUE(kept_bits(atlas, result, one.corner_count(), one.corner_count() + other.corner_count()));
  EXPECT_TRUE(says(result.warnings, "chart 1: has no area in the UV map"));
  const Atlas out = part(atlas, result.corner_uvs, one.face_count() + other.face_count(), atlas.face_count());
  EXPECT_TRUE(validate(out).valid());
  EXPECT_GE(result.after.pe, 0.75);
}

TEST(Parts, ALineInUVsIsCollapsedToo) {
  Atlas flat = shapes::quad_grid(4, 4);
  for (Vec2& uv : flat.corner_uvs) uv.y() = 0.5;
  const RefineResult result = refine(shapes::combine({star(), flat}), {.pe_bound = 0.7});
  EXPECT_EQ(result.charts[1].fate, Fate::Left);
}

TEST(Parts, WhereAllIsCollapsedNothingChangesAndAWarningSaysSo) {
  const Atlas atlas = on_point(shapes::quad_grid(3, 3), {0.5, 0.5});
  const RefineResult result = refine(atlas);
  EXPECT_EQ(result.intervention, Intervention::Unchanged);
  EXPECT_TRUE(kept_bits(atlas, result, 0, atlas.corner_count()));
  EXPECT_TRUE(says(result.warnings, "no chart takes part"));
  EXPECT_TRUE(std::isnan(result.before.distortion) && std::isnan(result.after.distortion)) << "E_d of nothing is none";
}

TEST(Parts, AVertexThatWasLostFarAwayDoesNotMakeALineOfTheRest) {
  for (const double far : {1e3, 1e5, 1e7, 1e9}) {
    Atlas atlas = shapes::quad_grid(10, 10);
    const Vec2 lost = atlas.corner_uvs[4 * 55];
    for (Vec2& uv : atlas.corner_uvs) {
      if (uv == lost) uv.x() = far;
    }
    const RefineResult result = refine(atlas, {.pe_bound = 0.7});
    EXPECT_EQ(result.charts[0].fate, Fate::Refined) << far;
    EXPECT_GE(result.after.pe, 0.7) << far;
    EXPECT_LT(result.after.distortion, 1.01) << far;
    EXPECT_TRUE(validate(testing::output(atlas, result)).valid()) << far;
  }
}

TEST(Parts, FacesWithoutFiniteUVsKeepTheirBitsOutsideTheAtlas) {
  const Atlas one = star();
  Atlas other = shapes::quad_grid(3, 3);
  for (Vec2& uv : other.corner_uvs) uv = {kNaN, std::numeric_limits<double>::infinity()};
  const Atlas atlas = shapes::combine({one, other});
  for (const Seams seams : {Seams::None, Seams::Rectangles}) {
    const RefineResult result = refine(atlas, {.pe_bound = 0.75, .seams = seams});
    EXPECT_GE(result.after.pe, 0.75);
    EXPECT_EQ(result.charts.back().fate, Fate::Left);
    const auto corners = static_cast<int>(result.corner_uvs.size());
    for (int k = 1; k <= other.corner_count(); ++k)
      EXPECT_TRUE(same_bits(atlas.corner_uvs[atlas.corner_count() - k], result.corner_uvs[corners - k]));
  }
}

/// A sheet, bent in the UVs, one of whose rows is so high in space and in the UVs.
Atlas with_thin_row(double height) {
  Atlas atlas = sheet(7, 7);
  for (Vec3& p : atlas.positions) {
    if (p.y() > 0.35) p.y() -= 0.1 - height;
  }
  for (int c = 0; c < atlas.corner_count(); ++c) atlas.corner_uvs[c] = atlas.positions[atlas.corner_vertices[c]].head<2>();
  return bent_into_arc(atlas, 1.5);
}

TEST(Parts, AChartWithFacesTooSmallToBeStoredIsLeftAndTheOthersAreRefined) {
  const Atlas atlas = shapes::combine({with_thin_row(1e-8), moved(with_thin_row(0.05), {3, 0})});
  const RefineResult result = refine(atlas, {.pe_bound = 0.7, .stored = Stored::Float32});
  EXPECT_EQ(result.charts[0].fate, Fate::Left);
  EXPECT_EQ(result.charts[1].fate, Fate::Refined);
  EXPECT_TRUE(says(result.warnings, "too small to be stored"));
  EXPECT_GE(result.after.pe, 0.7);
}

TEST(Parts, OnlyNaNIsRefusedByName) {
  Atlas atlas = shapes::quad_grid(2, 2);
  for (Vec2& uv : atlas.corner_uvs) uv = {kNaN, 0};
  try {
    refine(atlas);
    FAIL();
  } catch (const RefineError& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadInput);
    EXPECT_EQ(error.face(), 0);
  }
}

TEST(Parts, MessagesNameChartsOfTheInput) {
  const Atlas atlas =
      shapes::combine({on_point(shapes::quad_grid(1, 1), {0, 0}), star(), shapes::mirrored(moved(star(), {2, 0}))});
  const RefineResult result = refine(atlas, {.pe_bound = 0.7});
  ASSERT_FALSE(result.repairs.empty());
  EXPECT_EQ(result.repairs.front().charts, std::vector<int>{2});
  EXPECT_EQ(describe(result.repairs.front()), "chart 2: mirrored, turned over");
}

TEST(Stacks, ChartsOnEachOtherStayOnEachOther) {
  const Atlas one = star();
  for (const double noise : {0.0, 3e-6}) {
    const Atlas atlas = shapes::combine({one, moved(one, {noise, -noise}), moved(shapes::mesh(shapes::s_shape(), 0.1), {2, 0})});
    const RefineResult result = refine(atlas, {.pe_bound = 0.75});
    EXPECT_EQ(result.charts[1].fate, Fate::Stacked);
    EXPECT_EQ(result.charts[1].stacked_on, 0);
    for (int c = 0; c < one.corner_count(); ++c) EXPECT_EQ(result.corner_uvs[c], result.corner_uvs[one.corner_count() + c]);
    EXPECT_GE(result.after.pe, 0.75);
    EXPECT_LE(result.after.pe, 1);
    EXPECT_TRUE(validate(part(atlas, result.corner_uvs, one.face_count(), atlas.face_count())).valid());
  }
}

TEST(Stacks, FollowersKeepTheDensityThatTheirOwnSurfaceHas) {
  const Atlas one = star();
  Atlas larger = one;
  for (Vec3& p : larger.positions) p = 2 * p;
  const RefineResult result = refine(shapes::combine({one, larger, moved(star(), {2, 0})}), {.density = Density::Keep});
  ASSERT_EQ(result.charts[1].fate, Fate::Stacked);
  for (const auto density : {&ChartReport::density_before, &ChartReport::density_after})
    EXPECT_NEAR(result.charts[1].*density, 0.5 * result.charts[0].*density, 1e-9);
}

TEST(Stacks, AMirroredHalfStaysOnTheOther) {
  // The same UVs on a surface that is mirrored in space: wound the other way.
  const Atlas one = star();
  Atlas other = one;
  for (int f = 0; f < other.face_count(); ++f) {
    std::reverse(other.corner_vertices.begin() + other.face_offsets[f],
                 other.corner_vertices.begin() + other.face_offsets[f + 1]);
    std::reverse(other.corner_uvs.begin() + other.face_offsets[f], other.corner_uvs.begin() + other.face_offsets[f + 1]);
  }
  const Atlas atlas = shapes::combine({other, one});
  const RefineResult result = refine(atlas, {.pe_bound = 0.75});
  EXPECT_EQ(result.charts[0].fate, Fate::Stacked);  // the one that is not mirrored leads
  EXPECT_TRUE(result.repairs.empty());
  for (int f = 0; f < one.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) EXPECT_EQ(result.corner_uvs[3 * f + k], result.corner_uvs[one.corner_count() + 3 * f + 2 - k]);
  }
}

TEST(Stacks, AreCutAlike) {
  const Atlas one = star();
  const Atlas atlas = shapes::combine({one, one});
  const RefineResult result = refine(atlas, {.pe_bound = 0.85, .seams = Seams::Rectangles});
  ASSERT_EQ(result.intervention, Intervention::Cut);
  ASSERT_TRUE(result.cut);
  const int half = static_cast<int>(result.corner_uvs.size()) / 2;
  ASSERT_EQ(static_cast<int>(result.corner_uvs.size()), 2 * half);
  for (int c = 0; c < half; ++c) EXPECT_EQ(result.corner_uvs[c], result.corner_uvs[half + c]);
  const int faces = static_cast<int>(result.cut->face_sources.size()) / 2;
  for (int f = 0; f < faces; ++f) EXPECT_EQ(result.cut->face_sources[f] + one.face_count(), result.cut->face_sources[faces + f]);
}

/// Every corner of the cut is a mean of corners of its own face, where its vertex lies, and no face names a vertex twice.
void expect_whole_cut(const Atlas& atlas, const CutMesh& cut) {
  const auto old = static_cast<int>(atlas.positions.size());
  const auto position = [&](int corner) { return atlas.positions[atlas.corner_vertices[corner]]; };
  for (std::size_t f = 0; f < cut.face_sources.size(); ++f) {
    const int face = cut.face_sources[f];
    std::set<int> vertices;
    for (int c = cut.face_offsets[f]; c < cut.face_offsets[f + 1]; ++c) {
      EXPECT_TRUE(vertices.insert(cut.corner_vertices[c]).second) << "face " << face;
      Vec3 mean = Vec3::Zero();
      for (int k = 0; k < 3; ++k) {
        const int source = cut.corner_sources[c][k];
        ASSERT_GE(source, atlas.face_offsets[face]);
        ASSERT_LT(source, atlas.face_offsets[face + 1]);
        mean += cut.corner_weights[c][k] * position(source);
      }
      if (cut.corner_vertices[c] < old) continue;
      const NewVertex& vertex = cut.new_vertices[cut.corner_vertices[c] - old];
      for (int k = 0; k < 3; ++k) mean -= vertex.weights[k] * position(vertex.corners[k]);
      EXPECT_LT(mean.norm(), 1e-12);
    }
  }
}

TEST(Stacks, ChartsOfWhichOneHasATipAreCutAlike) {
  // The tip is many vertices at one place: edges from them are one edge in space on the cone, and several on the sheet.
  const Atlas quads = cone(8);
  Atlas tip{quads.name, quads.positions, {0}, {}, {}};  // in triangles, so that all are divided alike
  for (int f = 0; f < quads.face_count(); ++f) {
    for (const std::array<int, 3>& three : {std::array{0, 1, 2}, {0, 2, 3}}) {
      for (const int k : three) {
        tip.corner_vertices.push_back(quads.corner_vertices[quads.face_offsets[f] + k]);
        tip.corner_uvs.push_back(quads.corner_uvs[quads.face_offsets[f] + k]);
      }
      tip.face_offsets.push_back(tip.corner_count());
    }
  }
  Atlas flat = tip;
  for (int c = 0; c < flat.corner_count(); ++c)
    flat.positions[flat.corner_vertices[c]] = {flat.corner_uvs[c].x(), flat.corner_uvs[c].y(), 0};
  for (const std::vector<Atlas>& charts : {std::vector{tip, flat}, {flat, tip}, {tip, tip}, {tip, flat, tip}}) {
    const Atlas atlas = shapes::combine(charts);
    const RefineResult result = refine(atlas, {.pe_bound = 0.8, .seams = Seams::Rectangles});
    EXPECT_EQ(result.charts[1].fate, Fate::Stacked);
    ASSERT_EQ(result.intervention, Intervention::Cut);
    ASSERT_TRUE(result.cut);
    expect_whole_cut(atlas, *result.cut);
    const std::set<std::array<int, 2>> seams(result.cut->new_seams.begin(), result.cut->new_seams.end());
    EXPECT_EQ(seams.size(), result.cut->new_seams.size()) << "a seam is named twice";
  }
}

/// Every face begins at its next corner: the fan has the other diagonal.
Atlas begun_elsewhere(Atlas atlas) {
  for (int f = 0; f < atlas.face_count(); ++f) {
    const int begin = atlas.face_offsets[f], end = atlas.face_offsets[f + 1];
    std::rotate(atlas.corner_vertices.begin() + begin, atlas.corner_vertices.begin() + begin + 1,
                atlas.corner_vertices.begin() + end);
    std::rotate(atlas.corner_uvs.begin() + begin, atlas.corner_uvs.begin() + begin + 1, atlas.corner_uvs.begin() + end);
  }
  return atlas;
}

/// Every face as its fan.
Atlas in_triangles(const Atlas& atlas) {
  Atlas out{atlas.name, atlas.positions, {0}, {}, {}};
  for (int f = 0; f < atlas.face_count(); ++f) {
    for (int c = atlas.face_offsets[f] + 1; c + 1 < atlas.face_offsets[f + 1]; ++c) {
      for (const int corner : {atlas.face_offsets[f], c, c + 1}) {
        out.corner_vertices.push_back(atlas.corner_vertices[corner]);
        out.corner_uvs.push_back(atlas.corner_uvs[corner]);
      }
      out.face_offsets.push_back(out.corner_count());
    }
  }
  return out;
}

TEST(Stacks, PolygonsThatAreDividedOtherwiseAreCutAlike) {
  const Atlas one = shapes::quad_band(16, 4);
  const Atlas atlas = shapes::combine({one, begun_elsewhere(one)});
  for (const Cut cut : {Cut::Split, Cut::Edges}) {
    const RefineResult result = refine(atlas, {.pe_bound = 0.85, .seams = Seams::Rectangles, .cut = cut});
    ASSERT_EQ(result.intervention, Intervention::Cut);
    EXPECT_EQ(result.charts[1].fate, Fate::Stacked);
    EXPECT_FALSE(says(result.warnings, "placed apart"));
    if (result.cut) expect_whole_cut(atlas, *result.cut);
    EXPECT_EQ(result.cut.has_value(), cut == Cut::Split);
  }
}

TEST(Stacks, OfOtherPolygonsArePartedOnlyWhereTheyAreCut) {
  const Atlas band = shapes::quad_band(16, 4), sheet = shapes::quad_grid(8, 4);
  for (const Seams seams : {Seams::Needed, Seams::Rectangles}) {
    const Atlas atlas = shapes::combine({sheet, in_triangles(sheet)});
    const RefineResult result = refine(atlas, {.pe_bound = 0.9, .seams = seams});
    EXPECT_EQ(result.charts[1].fate, Fate::Stacked);
    EXPECT_FALSE(says(result.warnings, "placed apart"));
  }
  const RefineResult result = refine(shapes::combine({band, in_triangles(band)}), {.pe_bound = 0.85, .seams = Seams::Rectangles});
  ASSERT_EQ(result.intervention, Intervention::Cut);
  EXPECT_NE(result.charts[1].fate, Fate::Stacked);
  EXPECT_TRUE(says(result.warnings, "placed apart"));
}

TEST(Stacks, OfDifferentGroupsGetPlacesOfTheirOwn) {
  const Atlas one = star();
  const Atlas atlas = shapes::combine({one, one, one});
  std::vector<int> groups(atlas.face_count(), 0);
  std::fill(groups.begin() + 2 * one.face_count(), groups.end(), 1);
  const RefineResult result = refine(atlas, {.pe_bound = 0.7, .stack_groups = groups});
  EXPECT_EQ(result.charts[1].fate, Fate::Stacked);
  EXPECT_EQ(result.charts[2].fate, Fate::Refined);
  EXPECT_TRUE(validate(part(atlas, result.corner_uvs, one.face_count(), atlas.face_count())).valid());
  EXPECT_THROW(refine(atlas, {.stack_groups = {0, 1}}), RefineError);
}

TEST(Stacks, AreSeparatedWhereAsked) {
  const Atlas one = star();
  const Atlas atlas = shapes::combine({one, one});
  const RefineResult result = refine(atlas, {.pe_bound = 0.75, .stacks = Stacks::Separate});
  EXPECT_TRUE(validate([&] {
                Atlas out = atlas;
                out.corner_uvs = result.corner_uvs;
                return out;
              }())
                  .valid());
  EXPECT_TRUE(says(result.warnings, "overlapped"));
}

TEST(Stacks, ChartsThatOverlapOtherwiseArePartedWithAWord) {
  const Atlas atlas = shapes::combine({star(), moved(shapes::mesh(shapes::s_shape(), 0.1), {0.1, 0})});
  const RefineResult result = refine(atlas, {.pe_bound = 0.75});
  EXPECT_EQ(result.charts[1].fate, Fate::Refined);
  EXPECT_TRUE(says(result.warnings, "overlapped"));
}

TEST(Groups, EachHasABoxOfItsOwnAtTheSamePlace) {
  const Atlas one = star(), other = shapes::mesh(shapes::s_shape(), 0.1);
  const Atlas atlas = shapes::combine({one, other});
  RefineOptions options{.pe_bound = 0.8, .stored = Stored::Float32};
  options.groups.assign(atlas.face_count(), 7);
  std::fill(options.groups.begin(), options.groups.begin() + one.face_count(), 3);
  options.group_names = {"", "", "", "wood"};
  const RefineResult result = refine(atlas, options);
  ASSERT_EQ(result.groups.size(), 2u);
  EXPECT_EQ(result.groups[0].name, "wood");
  EXPECT_EQ(result.groups[1].name, "group 7");
  for (const auto& [first, end] : {std::pair(0, one.face_count()), std::pair(one.face_count(), atlas.face_count())}) {
    const Atlas out = part(atlas, result.corner_uvs, first, end);
    EXPECT_TRUE(validate(out).valid());
    const Measures m = measure(out);
    EXPECT_GE(m.pe, 0.8);
    EXPECT_EQ(std::max(m.box_width, m.box_height), 1);
  }
}

TEST(Groups, OneThatCannotReachTheBoundKeepsItsUVsAndTheOthersAreRefined) {
  const Atlas one = star(), sliver = flat_atlas({{0, 0, 0}, {1, 0, 0}, {0, 0.1, 0}}, {{0, 1, 2}});
  const Atlas atlas = shapes::combine({one, sliver, one});
  RefineOptions options{.pe_bound = 0.8};
  options.groups.assign(atlas.face_count(), 0);
  options.groups[one.face_count()] = 1;
  std::fill(options.groups.begin() + one.face_count() + 1, options.groups.end(), 2);
  options.group_names = {"bark", "glass", "leaf"};
  for (const Seams seams : {Seams::None, Seams::Rectangles}) {
    options.seams = seams;
    options.cut = Cut::Edges;  // across its only face it can be cut, and then be packed
    const RefineResult result = refine(atlas, options);
    EXPECT_FALSE(result.bound_met);
    ASSERT_EQ(result.groups.size(), 3u);
    for (const int refined : {0, 2}) {
      EXPECT_TRUE(result.groups[refined].bound_met);
      EXPECT_TRUE(result.groups[refined].reason.empty());
      EXPECT_GE(result.groups[refined].after.pe, 0.8);
    }
    EXPECT_FALSE(result.groups[1].bound_met);
    EXPECT_EQ(result.groups[1].intervention, Intervention::Unchanged);
    EXPECT_NE(result.groups[1].reason.find("the bound 0.8 was not reached"), std::string::npos) << result.groups[1].reason;
    EXPECT_TRUE(says(result.warnings, "glass: keeps its UVs: the bound 0.8"));
    if (!result.cut) {
      EXPECT_TRUE(kept_bits(atlas, result, one.corner_count(), one.corner_count() + 3));
    }
  }
}

TEST(Groups, WhereNoneReachesTheBoundTheFirstIsNamed) {
  const Atlas sliver = flat_atlas({{0, 0, 0}, {1, 0, 0}, {0, 0.1, 0}}, {{0, 1, 2}});
  try {
    refine(shapes::combine({sliver, sliver}), {.groups = {0, 1}, .group_names = {"glass", "steel"}});
    FAIL();
  } catch (const RefineError& error) {
    EXPECT_EQ(error.code(), ErrorCode::BoundNotReached);
    EXPECT_TRUE(std::string(error.what()).starts_with("glass: ")) << error.what();
  }
}

TEST(Meshes, ThoseThatLieAtOnePlaceShareNoChartAndNoCut) {
  // Two models that abut in space and in the UVs, as the levels of detail of one do.
  const Atlas one = shapes::quad_grid(8, 2);
  Atlas other = one;
  const double width = one.positions.back().x() - one.positions.front().x();
  for (Vec3& p : other.positions) p.x() = 2 * width - p.x();
  Atlas atlas{.name = "",
              .positions = one.positions,
              .face_offsets = one.face_offsets,
              .corner_vertices = one.corner_vertices,
              .corner_uvs = one.corner_uvs};
  const int vertices = static_cast<int>(one.positions.size());
  atlas.positions.insert(atlas.positions.end(), other.positions.begin(), other.positions.end());
  double far = 0;
  for (const Vec2& uv : one.corner_uvs) far = std::max(far, uv.x());
  for (int f = 0; f < other.face_count(); ++f) {
    for (int c = other.face_offsets[f + 1]; c-- > other.face_offsets[f];) {
      atlas.corner_vertices.push_back(vertices + other.corner_vertices[c]);
      atlas.corner_uvs.push_back({2 * far - other.corner_uvs[c].x(), other.corner_uvs[c].y()});
    }
    atlas.face_offsets.push_back(atlas.corner_count());
  }
  EXPECT_EQ(measure(atlas).chart_count, 1);
  atlas.vertex_meshes.assign(2 * vertices, 0);
  std::fill(atlas.vertex_meshes.begin() + vertices, atlas.vertex_meshes.end(), 1);
  EXPECT_EQ(measure(atlas).chart_count, 2);
  EXPECT_EQ(measure(atlas).seam_edges, 0);
  const RefineResult result = refine(atlas, {.pe_bound = 0.9});
  EXPECT_EQ(result.after.chart_count, 2);
  EXPECT_EQ(result.after.seam_edges, 0);
  atlas.vertex_meshes.pop_back();
  EXPECT_THROW(refine(atlas, {}), RefineError);
}

/// Flat: a chart whose face has these UVs.
Atlas triangle_at(const std::vector<Vec2>& uvs) {
  return {"triangle", {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {0, 3}, {0, 1, 2}, uvs};
}

TEST(Groups, TheUpperSidesOfATileAreTheNextTiles) {
  EXPECT_EQ(group_by_tile(triangle_at({{1, 2}, {2, 2}, {2, 3}})).names, std::vector<std::string>{"1022"});
  EXPECT_EQ(group_by_tile(triangle_at({{2, 2}, {2, 2.5}, {2, 3}})).names, std::vector<std::string>{"1023"});
  EXPECT_EQ(group_by_tile(triangle_at({{1.5, 0}, {2.5, 0}, {1.5, 1}})).names, std::vector<std::string>{"1003"});
}

TEST(Groups, TilesStayWhereTheyAre) {
  const Atlas one = moved(star(), {0.5, 0.5}), other = moved(shapes::mesh(shapes::s_shape(), 0.1), {2.5, 1.5});
  const Atlas atlas = shapes::combine({one, other});
  const TileGroups tiles = group_by_tile(atlas);
  EXPECT_EQ(tiles.names, (std::vector<std::string>{"1001", "1013"}));
  RefineOptions options{.pe_bound = 0.75, .stored = Stored::Float32};
  options.groups = tiles.groups;
  options.group_origins = tiles.origins;
  const RefineResult result = refine(atlas, options);
  EXPECT_TRUE(result.bound_met);
  for (int c = one.corner_count(); c < atlas.corner_count(); ++c) {
    const Vec2 in_tile = result.corner_uvs[c] - Vec2(2, 1);
    EXPECT_GE(in_tile.minCoeff(), 0);
    EXPECT_LE(in_tile.maxCoeff(), 1);
    EXPECT_EQ(result.corner_uvs[c].x(), static_cast<double>(static_cast<float>(result.corner_uvs[c].x())));
  }
}

TEST(Groups, EachFillsATextureOfItsOwnShapeWithItsOwnGap) {
  // Textures of 1024 x 512 and 256 x 512, 4 texels apart.
  const Atlas one = shapes::combine({star(), moved(star(), {2, 0})});
  const Atlas other = shapes::combine({star(), moved(star(), {2, 0}), moved(star(), {4, 0})});
  const Atlas atlas = shapes::combine({one, other});
  RefineOptions options{.pe_bound = 0.7, .box_aspect = 1, .in_texture = true, .gap = Gap{0.05, Gap::Unit::LongSide}};
  options.groups.assign(atlas.face_count(), 0);
  std::fill(options.groups.begin() + one.face_count(), options.groups.end(), 1);
  options.group_aspects = {2, 0.5};
  options.group_gaps = {4.0 / 1024, 4.0 / 512};
  const RefineResult result = refine(atlas, options);
  EXPECT_TRUE(result.bound_met);
  ASSERT_EQ(result.groups.size(), 2u);
  const int faces[] = {0, one.face_count(), atlas.face_count()};
  for (const int g : {0, 1}) {
    const double aspect = options.group_aspects[g];
    const Measures alone = measure(part(atlas, result.corner_uvs, faces[g], faces[g + 1]), aspect, true);
    EXPECT_GE(alone.pe_fixed_aspect, 0.7);
    EXPECT_NEAR(alone.pe_fixed_aspect, result.groups[g].after.pe_fixed_aspect, 1e-9);
    EXPECT_EQ(result.groups[g].gap.value, options.group_gaps[g]);
    const Vec2 texture(aspect, 1);
    const double margin = options.group_gaps[g] * texture.maxCoeff();
    for (int c = atlas.face_offsets[faces[g]]; c < atlas.face_offsets[faces[g + 1]]; ++c) {
      const Vec2 uv = result.corner_uvs[c].cwiseProduct(texture);
      EXPECT_GE(uv.minCoeff(), margin - 1e-9);
      EXPECT_GE((texture - uv).minCoeff(), margin - 1e-9);
    }
  }
}

TEST(Groups, AspectsAndGapsAreChecked) {
  RefineOptions options;
  options.group_aspects = {1, 0};
  EXPECT_THROW(refine(star(), options), RefineError);
  options = {};
  options.group_gaps = {0.01};
  EXPECT_THROW(refine(star(), options), RefineError);
  options.gap = Gap{};
  EXPECT_NO_THROW(refine(star(), options));
  options.group_gaps = {0.2};
  EXPECT_THROW(refine(star(), options), RefineError);
}

}  // namespace
}  // namespace atlas_refine
