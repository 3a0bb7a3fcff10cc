// Polygons are valid whoever divides them, and measured the same: both roads on meshes of quads and of larger polygons.
#include <algorithm>

#include "crossing_polygons.h"
#include "geometry/convex_polygon.h"
#include "geometry/predicates.h"
#include "output_atlas.h"
#include "polygon_sheets.h"
#include "refine_checks.h"
#include "shapes.h"
#include "sheets.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

using testing::refine_soundly;

std::vector<Vec2> outline(const std::vector<int>& offsets, const std::vector<Vec2>& corner_uvs, int face) {
  return {corner_uvs.begin() + offsets[face], corner_uvs.begin() + offsets[face + 1]};
}

int faces_not_convex(const std::vector<int>& offsets, const std::vector<Vec2>& corner_uvs) {
  int count = 0;
  for (int f = 0; f + 1 < static_cast<int>(offsets.size()); ++f) count += !is_strictly_convex(outline(offsets, corner_uvs, f));
  return count;
}

void expect_no_face_flipped(const RefineResult& result) {
  EXPECT_EQ(result.triangulations.fan_flipped, 0);
  EXPECT_EQ(result.triangulations.ears_flipped, 0);
  EXPECT_EQ(result.triangulations.not_convex, 0);
}

/// The vertices of the UV map moved a little: quads of all shapes, all convex.
Atlas shaken(Atlas atlas, double by) {
  Rng rng(3);
  std::vector<Vec2> moves;
  for (std::size_t v = 0; v < atlas.positions.size(); ++v) {
    const double x = rng.uniform(-by, by), y = rng.uniform(-by, by);
    moves.emplace_back(x, y);
  }
  for (int c = 0; c < atlas.corner_count(); ++c) atlas.corner_uvs[c] += moves[atlas.corner_vertices[c]];
  return atlas;
}

/// Its surface rough: quads far from flat, which want to be concave where one of their diagonals only is minded.
Atlas rough(Atlas atlas, double by) {
  Rng rng(5);
  for (Vec3& p : atlas.positions) p.z() += rng.uniform(-by, by);
  return atlas;
}

RefineOptions rectangles() {
  RefineOptions options;
  options.seams = Seams::Rectangles;
  options.rectangles.candidates = 40;
  return options;
}

TEST(RefinePolygons, QuadsThatAreSqueezedHardStayConvex) {
  for (const Atlas& atlas : {shapes::quad_band(10, 2, 0.6), shaken(shapes::quad_band(24, 6), 0.006),
                             rough(shapes::quad_band(24, 4), 0.1), rough(shapes::quad_band(12, 3), 0.1)}) {
    ASSERT_EQ(faces_not_convex(atlas.face_offsets, atlas.corner_uvs), 0);
    const RefineResult result = refine_soundly(atlas, {.pe_bound = 0.9, .relax = true});
    EXPECT_EQ(result.intervention, Intervention::Squeezed);
    EXPECT_EQ(faces_not_convex(atlas.face_offsets, result.corner_uvs), 0);
    expect_no_face_flipped(result);
  }
}

/// A strip of hexagons whose UVs are bent into a bow.
Atlas bow_of_hexagons() {
  Atlas atlas = shapes::honeycomb(9, 2);
  for (Vec2& uv : atlas.corner_uvs) uv.y() += 1.5 * (uv.x() - 0.5) * (uv.x() - 0.5);
  return atlas;
}

TEST(RefinePolygons, LargerPolygonsThatAreSqueezedStayConvex) {
  const Atlas atlas = rough(bow_of_hexagons(), 0.1);
  ASSERT_EQ(faces_not_convex(atlas.face_offsets, atlas.corner_uvs), 0);
  const RefineResult result = refine_soundly(atlas, {.pe_bound = 0.85, .relax = true});
  EXPECT_EQ(result.intervention, Intervention::Squeezed);
  EXPECT_EQ(faces_not_convex(atlas.face_offsets, result.corner_uvs), 0);
  expect_no_face_flipped(result);
}

/// One inner vertex of a grid moved so far that a quad is concave.
Atlas with_dart(int columns, int rows) {
  Atlas atlas = shapes::quad_band(columns, rows);
  const int vertex = (columns / 2) * (rows + 1) + rows / 2, other = vertex + rows + 2;
  Vec2 at = Vec2::Zero(), there = Vec2::Zero();
  for (int c = 0; c < atlas.corner_count(); ++c) {
    if (atlas.corner_vertices[c] == vertex) at = atlas.corner_uvs[c];
    if (atlas.corner_vertices[c] == other) there = atlas.corner_uvs[c];
  }
  for (int c = 0; c < atlas.corner_count(); ++c) {
    if (atlas.corner_vertices[c] == vertex) atlas.corner_uvs[c] = at + 0.6 * (there - at);
  }
  return atlas;
}

TEST(RefinePolygons, AConcaveQuadOfTheInputIsNamedAndTheOthersStayConvex) {
  const Atlas atlas = with_dart(24, 4);
  ASSERT_EQ(faces_not_convex(atlas.face_offsets, atlas.corner_uvs), 1);
  const RefineResult result = refine_soundly(atlas, {.pe_bound = 0.85});
  EXPECT_LE(faces_not_convex(atlas.face_offsets, result.corner_uvs), 1);
  EXPECT_EQ(result.triangulations.not_convex, faces_not_convex(atlas.face_offsets, result.corner_uvs));
  const bool told = std::any_of(result.warnings.begin(), result.warnings.end(),
                                [](const std::string& text) { return text.starts_with("1 face is not convex in the UV map"); });
  EXPECT_EQ(told, result.triangulations.not_convex == 1);
}

TEST(RefinePolygons, AFaceThatCrossesItselfByAHairIsMendedByAHair) {
  for (const double by : {1e-4, 1e-5, 1e-6}) {
    const RefineResult result = refine_soundly(testing::plate(testing::crossing_notches(by)), {});
    EXPECT_EQ(result.intervention, Intervention::Moved);
    EXPECT_LT(result.after.distortion, 1.001) << by;
  }
}

/// An L of quads one of whose corners lies in the UVs that far beside the straight line between its neighbours; not on the
/// surface.
Atlas with_straight_corner(double beside) {
  Atlas atlas = testing::quads(testing::l_cells(2));
  std::vector<Vec2> uvs(atlas.positions.size());
  for (int c = 0; c < atlas.corner_count(); ++c) uvs[atlas.corner_vertices[c]] = atlas.corner_uvs[c];
  const auto face = atlas.corner_vertices.begin();  // the first: its second corner is on the border
  const Vec2 from = uvs[face[0]], chord = uvs[face[2]] - from;
  uvs[face[1]] = from + 0.5 * chord + beside * Vec2(chord.y(), -chord.x());
  for (int c = 0; c < atlas.corner_count(); ++c) atlas.corner_uvs[c] = uvs[atlas.corner_vertices[c]];
  return atlas;
}

TEST(RefinePolygons, AQuadWithACornerThatIsAllButStraightStopsNothing) {
  const double clear = refine_soundly(with_straight_corner(0.02), {}).after.distortion;
  for (const double beside : {1e-4, 1e-6, 2e-7, 1e-9})
    EXPECT_NEAR(refine_soundly(with_straight_corner(beside), {}).after.distortion, clear, 1e-3) << beside;
}

TEST(RefinePolygons, CutFacesAreConvexOrTriangles) {
  for (const Atlas& atlas : {shapes::quad_band(24, 5), shaken(shapes::quad_band(30, 6, 0.9), 0.005), bow_of_hexagons()}) {
    const RefineResult result = refine(atlas, rectangles());
    ASSERT_TRUE(result.cut.has_value());
    expect_no_face_flipped(result);
    EXPECT_EQ(faces_not_convex(result.cut->face_offsets, result.corner_uvs), 0);
  }
}

/// The atlas and its mirror image on the same UVs.
Atlas with_mirror_image(const Atlas& atlas) {
  Atlas image = atlas;
  for (Vec3& p : image.positions) p.x() = -p.x();
  for (int f = 0; f < atlas.face_count(); ++f) {
    std::reverse(image.corner_vertices.begin() + atlas.face_offsets[f] + 1,
                 image.corner_vertices.begin() + atlas.face_offsets[f + 1]);
    std::reverse(image.corner_uvs.begin() + atlas.face_offsets[f] + 1, image.corner_uvs.begin() + atlas.face_offsets[f + 1]);
  }
  return shapes::combine({atlas, image});
}

TEST(RefinePolygons, TheMirrorImageOfACutChartIsDividedAsTheChart) {
  const Atlas band = shapes::quad_band(24, 5);
  const RefineResult result = refine(with_mirror_image(band), rectangles());
  ASSERT_TRUE(result.cut.has_value());
  const std::vector<int>& sources = result.cut->face_sources;
  std::array<std::vector<std::size_t>, 2> sides;  // of the faces of either, as they come
  for (int f = 0; f < static_cast<int>(sources.size()); ++f) {
    std::vector<Vec2> uvs = outline(result.cut->face_offsets, result.corner_uvs, f);
    const bool image = sources[f] >= band.face_count();
    if (image) std::reverse(uvs.begin(), uvs.end());
    EXPECT_TRUE(is_strictly_convex(uvs));
    sides[image].push_back(uvs.size());
  }
  for (auto& list : sides) std::sort(list.begin(), list.end());
  EXPECT_EQ(sides[0], sides[1]);
  EXPECT_GT(std::count(sides[1].begin(), sides[1].end(), 4), 60) << "quads that nothing divides stay quads";
}

TEST(RefinePolygons, CutFacesAreTrianglesThroughoutWhereAskedFor) {
  const Atlas atlas = shapes::quad_band(24, 5);
  RefineOptions options = rectangles();
  options.triangulate = true;
  const RefineResult result = refine(atlas, options);
  ASSERT_TRUE(result.cut.has_value());
  std::vector<int> parts(atlas.face_count(), 0);
  for (int source : result.cut->face_sources) ++parts[source];
  int divided = 0;
  for (std::size_t f = 0; f < result.cut->face_sources.size(); ++f) {
    if (parts[result.cut->face_sources[f]] == 1) continue;
    EXPECT_EQ(result.cut->face_offsets[f + 1] - result.cut->face_offsets[f], 3);
    ++divided;
  }
  EXPECT_GT(divided, 0);
  EXPECT_NE(std::count(parts.begin(), parts.end(), 1), 0) << "faces that nothing crosses stay quads";
}

TEST(RefinePolygons, TheTrianglesOfTheReaderStayPositive) {
  Atlas atlas = bow_of_hexagons();
  for (int f = 0; f < atlas.face_count(); ++f) {
    const int c = atlas.face_offsets[f];
    atlas.triangles.push_back({c + 1, c + 2, c + 3});
    atlas.triangles.push_back({c + 3, c + 4, c + 5});
    atlas.triangles.push_back({c + 5, c, c + 1});
    atlas.triangles.push_back({c + 1, c + 3, c + 5});
  }
  const RefineResult result = refine_soundly(atlas, {.pe_bound = 0.85});
  for (const auto& t : atlas.triangles)
    EXPECT_GT(orientation(result.corner_uvs[t[0]], result.corner_uvs[t[1]], result.corner_uvs[t[2]]), 0);
  // What is measured is measured on them.
  Atlas as_triangles = testing::with_corner_uvs(atlas, result.corner_uvs);
  as_triangles.triangles.clear();
  as_triangles.face_offsets = {0};
  as_triangles.corner_vertices.clear();
  as_triangles.corner_uvs.clear();
  for (const auto& t : atlas.triangles) {
    for (int c : t) {
      as_triangles.corner_vertices.push_back(atlas.corner_vertices[c]);
      as_triangles.corner_uvs.push_back(result.corner_uvs[c]);
    }
    as_triangles.face_offsets.push_back(as_triangles.corner_count());
  }
  EXPECT_NEAR(measure(as_triangles).distortion, result.after.distortion, 1e-12);
}

TEST(RefinePolygons, ThreadsDoNotChangeTheResult) {
  for (RefineOptions options : {RefineOptions{.pe_bound = 0.9}, rectangles()}) {
    options.threads = 1;
    const RefineResult one = refine(shapes::quad_band(24, 4), options);
    options.threads = 3;
    const RefineResult three = refine(shapes::quad_band(24, 4), options);
    EXPECT_EQ(one.corner_uvs, three.corner_uvs);
  }
}

/// A sheet of quads in which 3 x 3 are one polygon with a hole in its middle, reached along an edge to and fro.
Atlas sheet_with_keyhole(bool mirrored) {
  const Atlas whole = sheet(9, 6);
  Atlas atlas{whole.name, whole.positions, {0}, {}, {}};
  for (int f = 0; f < whole.face_count(); ++f) {
    const int column = f % 9, row = f / 9;
    if (column < 3 || column > 5 || row < 2 || row > 4) add_double(atlas, whole, f, false);
  }
  const auto vertex = [](int i, int j) { return j * 10 + i; };
  std::vector<int> face;
  for (int i = 3; i < 6; ++i) face.push_back(vertex(i, 2));
  for (int j = 2; j < 5; ++j) face.push_back(vertex(6, j));
  for (int i = 6; i > 3; --i) face.push_back(vertex(i, 5));
  for (int j = 5; j > 1; --j) face.push_back(vertex(3, j));
  for (const int v : {vertex(4, 3), vertex(4, 4), vertex(5, 4), vertex(5, 3), vertex(4, 3)}) face.push_back(v);
  std::vector<Vec2> uvs;
  for (const int v : face) uvs.push_back(whole.positions[v].head<2>());
  add_face(atlas, face, uvs);
  for (Vec3& p : atlas.positions) p.z() = 0.05 * std::sin(7 * p.x()) * std::sin(5 * p.y());
  for (Vec2& uv : atlas.corner_uvs) uv = Vec2((mirrored ? -1 : 1) * uv.x(), uv.y() + uv.x() * uv.x());
  return atlas;
}

TEST(RefinePolygons, AKeyholeTakesPartAsARing) {
  for (const bool mirrored : {false, true}) {
    const Atlas atlas = sheet_with_keyhole(mirrored);
    const ChartSet set = split_charts(atlas);
    ASSERT_EQ(set.charts.size(), 1);
    EXPECT_TRUE(set.defects.empty());
    EXPECT_EQ(set.charts[0].boundary_loops.size(), 2);
    EXPECT_EQ(set.charts[0].boundary_loops[1].size(), 4);
    EXPECT_EQ(set.seam_edges, 0);
    EXPECT_EQ(validate(atlas).valid(), !mirrored) << validate(atlas).problem;
    testing::refine_soundly(atlas, {.pe_bound = 0.85});
    for (const Cut cut : {Cut::Split, Cut::Edges}) {
      const RefineResult result = refine(atlas, {.pe_bound = 0.85, .seams = Seams::Rectangles, .cut = cut});
      const Validity validity = validate(testing::output(atlas, result));
      EXPECT_TRUE(validity.valid()) << validity.problem;
      EXPECT_TRUE(result.bound_met);
    }
  }
}

}  // namespace
}  // namespace atlas_refine
