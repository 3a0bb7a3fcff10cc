// Every chart comes out valid, changed as little as will do; what cannot be mended is left and named.
#include "repair/repair_charts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "atlas_refine/refine.h"
#include "charts.h"
#include "closed_shapes.h"
#include "geometry/guards.h"
#include "geometry/rest_triangle.h"
#include "refine_checks.h"
#include "repair/bad_triangles.h"
#include "shapes.h"
#include "small_atlases.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

using What = ChartRepair::What;

RepairedCharts repaired(const std::vector<Chart>& charts, RepairOptions options = {}) {
  Monitor monitor;
  return repair_charts(charts, options, monitor);
}

/// The repair of the atlas' only chart that needs one; all charts must be valid by themselves then.
ChartRepair only_repair(const Atlas& atlas, const RepairOptions& options = {}) {
  const std::vector<Chart> charts = testing::charts_of(atlas);
  const RepairedCharts one = repaired(charts, options);
  EXPECT_TRUE(one.unmended.empty()) << one.unmended.front().reason;
  EXPECT_EQ(one.repairs.size(), 1u);
  for (const Chart& chart : meshes_of(one.atlas)) testing::expect_certified({chart});
  RepairOptions more = options;
  more.threads = 4;
  const std::vector<Chart> again = meshes_of(repaired(charts, more).atlas);
  for (std::size_t c = 0; c < again.size(); ++c) EXPECT_TRUE(testing::same_bits(again[c].uvs, one.atlas.pieces[c].mesh.uvs));
  return one.repairs.empty() ? ChartRepair{} : one.repairs.front();
}

/// The corners of the faces at the vertex nearest to `at` in the UV plane, moved together.
Atlas with_vertex_moved(Atlas atlas, const Vec2& at, const Vec2& by) {
  const auto nearest = std::min_element(atlas.corner_uvs.begin(), atlas.corner_uvs.end(), [&](const Vec2& a, const Vec2& b) {
    return (a - at).squaredNorm() < (b - at).squaredNorm();
  });
  const Vec2 old = *nearest;
  std::replace(atlas.corner_uvs.begin(), atlas.corner_uvs.end(), old, Vec2(old + by));
  return atlas;
}

TEST(RepairCharts, ValidChartsStayBitForBit) {
  const std::vector<Chart> charts = testing::charts_of(shapes::squares(5));
  const RepairedCharts out = repaired(charts);
  EXPECT_TRUE(out.repairs.empty());
  for (std::size_t c = 0; c < charts.size(); ++c) EXPECT_TRUE(testing::same_bits(charts[c].uvs, out.atlas.pieces[c].mesh.uvs));
}

TEST(RepairCharts, OneFlippedTriangleInALargeChartKeepsItsShape) {
  const Atlas good = shapes::mesh(shapes::disk(0.5), 0.03);
  for (const double far : {0.045, 0.2}) {
    const Atlas atlas = with_vertex_moved(good, {0.1, 0.05}, {far, 0});
    const std::vector<Chart> charts = testing::charts_of(atlas);
    const std::vector<char> bad = bad_triangles(charts[0]);
    ASSERT_GT(std::count(bad.begin(), bad.end(), 1), 0);
    const ChartRepair repair = only_repair(atlas);
    EXPECT_EQ(repair.what, What::Untangled);
    EXPECT_FALSE(repair.faces.empty());
    EXPECT_LE(repair.distortion_to_input, 1.02);
  }
}

TEST(RepairCharts, OneFlippedTriangleInAChartThatIsAllButALineHasItEmbeddedAnew) {
  Atlas atlas = with_vertex_moved(shapes::mesh(shapes::disk(0.5), 0.03), {0.1, 0.05}, {0, 0.045});
  for (Vec2& uv : atlas.corner_uvs) uv.y() *= 1e-3;
  EXPECT_EQ(only_repair(atlas).what, What::Embedded);
}

TEST(RepairCharts, FacesThatAVertexDrewOutHaveNoShapeToKeep) {
  const Atlas good = shapes::quad_grid(20, 20);
  for (const Vec2& at : {Vec2(0.65, 0.9), Vec2(0.5, 0.5), Vec2(0.9, 0.1)}) {
    const Chart before = testing::charts_of(good)[0];
    const Chart drawn = testing::charts_of(with_vertex_moved(good, at, -at))[0];
    const Chart after = repaired({drawn}).atlas.pieces[0].mesh;
    std::vector<Triangle> untouched;
    std::vector<RestTriangle> shapes_before;
    for (const Triangle& t : before.triangles) {
      if (std::any_of(t.begin(), t.end(), [&](int v) { return before.uvs[v] != drawn.uvs[v]; })) continue;
      untouched.push_back(t);
      shapes_before.push_back(rest_from_plane(before.uvs[t[0]], before.uvs[t[1]], before.uvs[t[2]], 1));
    }
    ASSERT_LT(untouched.size(), before.triangles.size());
    EXPECT_LE(dirichlet_sums(shapes_before, untouched, after.uvs).best_energy(), 1.02) << at.transpose();
  }
}

/// Faces whose polygons hold under every division.
std::set<int> convex_faces(Chart chart) {
  drop_broken_guards(chart);
  std::set<int> faces;
  for (const Guard& guard : chart.guards) faces.insert(guard.face);
  return faces;
}

/// Every vertex moved by itself, in the UV map and on the surface: many quads are nearly concave.
Atlas shaken(Atlas atlas, double amount, std::uint64_t seed) {
  Rng rng(seed, 0);
  std::map<std::pair<double, double>, Vec2> by;
  for (int c = 0; c < atlas.corner_count(); ++c) {
    Vec2& uv = atlas.corner_uvs[c];
    const auto [at, added] = by.emplace(std::pair(uv.x(), uv.y()), Vec2::Zero());
    if (added) at->second = amount * Vec2(rng.uniform(-1, 1), rng.uniform(-1, 1));
    uv += at->second;
    atlas.positions[atlas.corner_vertices[c]].head<2>() = uv;
  }
  return atlas;
}

TEST(RepairCharts, QuadsThatWereConvexStaySo) {
  for (int k = 20; k < 30; ++k) {
    Rng rng(k, 1);
    const Vec2 at(rng.uniform(0.1, 0.9), rng.uniform(0.1, 0.9)), by(rng.uniform(-0.25, 0.25), rng.uniform(-0.25, 0.25));
    const Chart before = testing::charts_of(with_vertex_moved(shaken(shapes::quad_grid(12, 12), 0.045, k), at, by))[0];
    const std::set<int> after = convex_faces(repaired({before}).atlas.pieces[0].mesh);
    for (const int face : convex_faces(before)) EXPECT_TRUE(after.contains(face)) << "face " << face << ", seed " << k;
  }
}

TEST(RepairCharts, FarFromTheBadTriangleNothingMoves) {
  const Atlas atlas = with_vertex_moved(shapes::mesh(shapes::disk(0.5), 0.03), {0.3, 0}, {0.045, 0});
  const Chart before = testing::charts_of(atlas)[0];
  const Chart after = repaired({before}).atlas.pieces[0].mesh;
  int still = 0;
  for (int v = 0; v < before.vertex_count(); ++v) still += before.uvs[v] == after.uvs[v];
  EXPECT_GT(still, 0.8 * before.vertex_count());
  EXPECT_LT(still, before.vertex_count());
}

TEST(RepairCharts, AFlippedBoundaryTriangleIsTurnedBack) {
  const Atlas atlas = with_vertex_moved(shapes::mesh(shapes::rectangle(1, 0.6), 0.08), {1, 0.3}, {-0.12, 0});
  const ChartRepair repair = only_repair(atlas);
  EXPECT_EQ(repair.what, What::Untangled);
  EXPECT_LE(repair.distortion_to_input, 1.02);
}

TEST(RepairCharts, AQuadWithTwoEqualUvCornersOpensALittle) {
  // The corners of one inner edge fall together in the UV map.
  Atlas atlas = shapes::quad_grid(8, 8);
  const Vec2 kept = atlas.corner_uvs[4 * 27 + 1], lost = atlas.corner_uvs[4 * 27 + 2];
  ASSERT_NE(kept, lost);
  std::replace(atlas.corner_uvs.begin(), atlas.corner_uvs.end(), lost, kept);
  const ChartRepair repair = only_repair(atlas);
  EXPECT_EQ(repair.what, What::Untangled);
  EXPECT_LE(repair.distortion_to_input, 1.02);
}

TEST(RepairCharts, AFaceWithoutAreaInSpaceAndUvsStaysBetweenItsNeighbours) {
  // Two strips that meet along a T: the filler triangle has its three corners on one line, in space too.
  const Atlas atlas = flat_atlas({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {1, 0, 0}, {0, -1, 0}, {2, -1, 0}, {1, -1, 0}},
                                 {{0, 1, 2, 3}, {0, 4, 1}, {5, 7, 4, 0}, {7, 6, 1, 4}});
  const ChartRepair repair = only_repair(atlas);
  EXPECT_EQ(repair.what, What::Untangled);
  EXPECT_EQ(repair.faces, std::vector<int>{1});
  EXPECT_LE(repair.distortion_to_input, 1.02);
}

TEST(RepairCharts, AChartMostlyAtOnePointGetsAreas) {
  Atlas atlas = shapes::quad_grid(6, 6);
  for (std::size_t c = 0; c < atlas.corner_uvs.size(); ++c) {
    if (atlas.corner_uvs[c].x() > 0.2) atlas.corner_uvs[c] = {0.2, 0.5};
  }
  const std::vector<Chart> charts = testing::charts_of(atlas);
  ASSERT_EQ(charts.size(), 1u);
  const RepairedCharts out = repaired(charts);
  ASSERT_TRUE(out.unmended.empty());
  testing::expect_certified(meshes_of(out.atlas));
  EXPECT_LT(dirichlet_sums(out.atlas.pieces[0].mesh).best_energy(), 1.5);
}

TEST(RepairCharts, AStripThatOverlapsItselfIsUnwound) {
  const std::vector<Chart> charts = testing::charts_of(shapes::self_overlapping());
  ASSERT_FALSE(certify_charts(charts).valid());
  const RepairedCharts out = repaired(charts);
  ASSERT_EQ(out.repairs.size(), 1u);
  EXPECT_EQ(out.repairs[0].what, What::DrawnApart);
  EXPECT_LT(out.repairs[0].distortion_to_input, 1.08);
  const Chart& embedded = out.atlas.pieces[0].mesh;
  testing::expect_certified({embedded});
  EXPECT_EQ(embedded.triangles, charts[0].triangles);
  // The strip lies as a spiral now: a little bent, not crushed.
  EXPECT_LT(dirichlet_sums(embedded).best_energy(), 1.08);
  EXPECT_NEAR(dirichlet_sums(embedded).best_scale(), 1, 0.02);
  const double far_arc = kFarArc * testing::box_sides({embedded}).norm();
  EXPECT_GT(gap_within_charts({embedded}, far_arc, 1)[0], 0.5 * 0.0025 * testing::box_sides({embedded}).norm());
}

/// Columns x rows quads of a straight strip in space, laid in the UV map as `uv(i, j)` says.
template <class Uv>
Atlas strip_laid(int columns, int rows, const Uv& uv) {
  std::vector<Vec3> positions;
  std::vector<std::vector<int>> faces;
  for (int k = 0; k < (columns + 1) * (rows + 1); ++k) positions.emplace_back(k % (columns + 1), k / (columns + 1), 0);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i;
      faces.push_back({a, a + 1, a + columns + 2, a + columns + 1});
    }
  }
  Atlas atlas = flat_atlas(positions, faces);
  for (Vec2& corner : atlas.corner_uvs) corner = uv(corner.x(), corner.y());
  return atlas;
}

TEST(RepairCharts, EndsThatOverlapAreDrawnApartAndTheRestKeepsItsShape) {
  // A ring a little more than once around: bent by the artist, as the strip in space is straight.
  const Atlas atlas = strip_laid(60, 4, [](double i, double j) {
    const double angle_rad = 2.06 * std::numbers::pi * i / 60;
    return Vec2((10 - j) * std::cos(angle_rad), (10 - j) * std::sin(angle_rad));
  });
  const Chart before = testing::charts_of(atlas).at(0);
  const ChartRepair repair = only_repair(atlas);
  EXPECT_EQ(repair.what, What::DrawnApart);
  EXPECT_LT(repair.distortion_to_input, 1.005);
  const Chart after = repaired({before}).atlas.pieces[0].mesh;
  EXPECT_LT(dirichlet_sums(after).best_energy(), dirichlet_sums(before).best_energy() + 1e-3);
  EXPECT_EQ(after.guards.size(), before.guards.size());
}

TEST(RepairCharts, OverlappingUvsThatAreNoShapeToKeepAreEmbeddedAnew) {
  const Atlas atlas = strip_laid(60, 4, [](double i, double j) {
    const double angle_rad = 2.5 * std::numbers::pi * i / 60;
    return Vec2((10 - 2.4 * j) * std::cos(angle_rad), 0.2 * (10 - 2.4 * j) * std::sin(angle_rad));
  });
  const ChartRepair repair = only_repair(atlas);
  EXPECT_EQ(repair.what, What::Embedded);
  EXPECT_LT(dirichlet_sums(repaired(testing::charts_of(atlas)).atlas.pieces[0].mesh).best_energy(), 1.001);
}

TEST(RepairCharts, WhereChartsMayOverlapOnlyFlipsAreMended) {
  const std::vector<Chart> charts = testing::charts_of(shapes::self_overlapping());
  EXPECT_TRUE(repaired(charts, {.may_overlap = true}).repairs.empty());
  const ChartRepair repair =
      repaired(testing::charts_of(shapes::with_flipped_face(shapes::self_overlapping())), {.may_overlap = true}).repairs.at(0);
  EXPECT_EQ(repair.what, What::Untangled);
  EXPECT_LE(repair.distortion_to_input, 1.02);
}

TEST(RepairCharts, FlippedFacesDoNotRefuseAFile) {
  const Atlas atlas = with_vertex_moved(shapes::mesh(shapes::disk(0.5), 0.06), {0, 0}, {0.2, 0.03});
  const RefineOptions options{.pe_bound = 0.7};
  const RefineResult result = testing::refine_soundly(atlas, options);
  EXPECT_EQ(result.repairs.size(), 1u);
}

TEST(RepairCharts, AHandleIsLeftAndNamedWithoutPermission) {
  const RepairedCharts out = repaired(shapes::unparted(shapes::torus(12, 8, 1)));
  EXPECT_TRUE(out.repairs.empty());
  ASSERT_EQ(out.unmended.size(), 1u);
  EXPECT_NE(out.unmended[0].reason.find("has a handle"), std::string::npos);
  EXPECT_NE(out.unmended[0].reason.find("--open-closed"), std::string::npos);
}

TEST(RepairCharts, ClosedChartsAreOpenedWherePermitted) {
  for (const auto& [atlas, most] : {std::pair(shapes::cube_sphere(6), 1.6), std::pair(shapes::torus(24, 12), 1.6),
                                    std::pair(shapes::torus(24, 12, 1), 1.6)}) {
    const std::vector<Chart> charts = shapes::unparted(atlas);
    const RepairedCharts out = repaired(charts, {.open_closed = true});
    ASSERT_EQ(out.repairs.size(), 1u);
    EXPECT_EQ(out.repairs[0].what, What::Opened);
    EXPECT_FALSE(out.atlas.seams.empty());
    ASSERT_EQ(out.atlas.pieces.size(), 1u);
    testing::expect_certified(meshes_of(out.atlas));
    EXPECT_LT(dirichlet_sums(out.atlas.pieces[0].mesh).best_energy(), most);
  }
}

TEST(RepairCharts, ACubeBecomesACrossOrAnotherNet) {
  const RepairedCharts out = repaired(shapes::unparted(shapes::cube(1)), {.open_closed = true});
  ASSERT_TRUE(out.unmended.empty());
  EXPECT_EQ(out.atlas.seams.size(), 7u);
  EXPECT_LT(dirichlet_sums(out.atlas.pieces[0].mesh).best_energy(), 1.0005);
}

TEST(RepairCharts, ACubeOfManyFacesIsOpenedAlongItsSharpEdges) {
  Atlas atlas = shapes::cube(4);
  for (Vec2& uv : atlas.corner_uvs) uv = {0.5, 0.5};
  const RefineResult result = refine(atlas, {.pe_bound = 0.4, .open_closed = true, .collapsed = Collapsed::Embed});
  EXPECT_EQ(result.new_seams.size(), 7u * 4);
  EXPECT_LT(result.after.distortion, 1.01);
}

/// Wrapped around, but not by a whole tile: nobody can tell that from a closed chart.
Atlas closed_torus() {
  Atlas atlas = shapes::wrapped(shapes::torus(24, 12));
  for (Vec2& uv : atlas.corner_uvs) uv *= 0.45;
  return atlas;
}

using VertexPairs = std::vector<std::array<int, 2>>;

/// Edges of torus(24, 12) around the tube at column i, and once around the torus at row j.
VertexPairs loops_of_torus(int i, int j) {
  VertexPairs out;
  for (int k = 0; k < 12; ++k) out.push_back({i * 12 + k, i * 12 + (k + 1) % 12});
  for (int k = 0; k < 24; ++k) out.push_back({k * 12 + j, (k + 1) % 24 * 12 + j});
  return out;
}

std::set<std::pair<int, int>> as_set(const VertexPairs& pairs) {
  std::set<std::pair<int, int>> out;
  for (const auto& [a, b] : pairs) out.insert(std::minmax(a, b));
  return out;
}

TEST(RepairCharts, OpeningsKeepOffEdgesThatMustStayWhole) {
  RefineOptions options{.pe_bound = 0.6, .open_closed = true};
  const RefineResult free = refine(closed_torus(), options);
  options.no_seam = free.new_seams;
  const RefineResult other = refine(closed_torus(), options);
  ASSERT_FALSE(other.new_seams.empty());
  const auto forbidden = as_set(options.no_seam);
  for (const auto& [a, b] : other.new_seams) EXPECT_FALSE(forbidden.contains(std::minmax(a, b)));
}

TEST(RepairCharts, OpeningsFollowPreferredEdges) {
  const VertexPairs loops = loops_of_torus(7, 4);
  const RefineResult result = refine(closed_torus(), {.pe_bound = 0.6, .open_closed = true, .prefer_seam = loops});
  const auto seams = as_set(result.new_seams);
  for (const auto& pair : loops) EXPECT_TRUE(seams.contains(std::minmax(pair[0], pair[1])));
}

TEST(RepairCharts, WhereNoEdgeMayOpenTheChartIsLeftAndTold) {
  const Atlas atlas = closed_torus();
  RefineOptions options{.pe_bound = 0.6, .open_closed = true};
  for (int i = 0; i < 24; ++i) {
    for (const auto& pair : loops_of_torus(i, i % 12)) options.no_seam.push_back(pair);
  }
  const RefineError refused = testing::refusal(atlas, options);
  EXPECT_NE(std::string(refused.what()).find("--no-seam"), std::string::npos) << refused.what();
}

TEST(RepairCharts, ARefinedTorusHasRealSeams) {
  const Atlas atlas = closed_torus();
  const RefineResult result = refine(atlas, {.pe_bound = 0.6, .open_closed = true});
  EXPECT_FALSE(result.cut);
  EXPECT_FALSE(result.new_seams.empty());
  EXPECT_EQ(result.added_seams, static_cast<int>(result.new_seams.size()));
  EXPECT_GE(result.after.pe, 0.6);
  const RefineError refused = testing::refusal(atlas);
  EXPECT_NE(std::string(refused.what()).find("has no boundary"), std::string::npos) << refused.what();
}

TEST(RepairCharts, AClosedChartIsLeftAndTheOthersRefined) {
  const Atlas torus = closed_torus();
  const Atlas atlas = shapes::combine({torus, shapes::mesh(shapes::star(), 0.1)});
  const RefineResult result = refine(atlas, {.pe_bound = 0.7});
  EXPECT_TRUE(result.bound_met);
  EXPECT_EQ(result.charts[0].fate, Fate::Left);
  EXPECT_NE(result.charts[0].reason.find("--open-closed"), std::string::npos);
  for (int c = 0; c < torus.corner_count(); ++c) EXPECT_EQ(result.corner_uvs[c], atlas.corner_uvs[c]);
}

TEST(RepairCharts, OpenedChartsAreCutIntoRectangles) {
  for (const Atlas& atlas : {closed_torus()}) {
    const RefineOptions options{
        .pe_bound = 0.7, .seams = Seams::Rectangles, .rectangles = {.candidates = 50}, .open_closed = true};
    const RefineResult result = refine(atlas, options);
    EXPECT_TRUE(result.fallbacks.empty()) << result.fallbacks.front();
    EXPECT_EQ(result.intervention, Intervention::Cut);
    ASSERT_TRUE(result.cut);
    EXPECT_FALSE(result.cut->new_seams.empty());
    EXPECT_LT(result.after.distortion, 1.3);
  }
}

TEST(RepairCharts, BordersWithinRoundingOfEachOtherAreParted) {
  // A square with a slit that is 1e-15 wide.
  const double half = 5e-16;
  const Atlas atlas =
      flat_atlas({{0, 0, 0}, {1, 0, 0}, {1, 0.5 - half, 0}, {0.5, 0.5, 0}, {1, 0.5 + half, 0}, {1, 1, 0}, {0, 1, 0}},
                 {{0, 1, 3}, {1, 2, 3}, {3, 4, 5}, {3, 5, 6}, {0, 3, 6}});
  const std::vector<Chart> charts = testing::charts_of(atlas);
  ASSERT_TRUE(certify_charts(charts).valid());
  const ChartRepair repair = only_repair(atlas);
  EXPECT_EQ(repair.what, What::Parted);
  EXPECT_LE(repair.distortion_to_input, 1.02);
}

/// A U of quads on a wavy surface, half of its inner rows' edges with a needle of this height on them.
Atlas with_needles(double height) {
  constexpr int n = 18;
  std::vector<Vec3> positions;
  std::vector<std::vector<int>> faces;
  for (int k = 0; k < (n + 1) * (n + 1); ++k) {
    const int x = k % (n + 1), y = k / (n + 1);
    positions.emplace_back(x, y, 0.6 * std::sin(0.7 * x) * std::cos(0.5 * y));
  }
  const auto inside = [&](int i, int j) { return i < n / 3 || i >= 2 * n / 3 || j < n / 3; };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      if (!inside(i, j)) continue;
      const int a = j * (n + 1) + i, b = a + 1, d = a + n + 1, c = d + 1;
      if (j == 0 || !inside(i, j - 1) || (i + j) % 2 == 1) {
        faces.insert(faces.end(), {{a, b, c}, {a, c, d}});
        continue;
      }
      const int m = static_cast<int>(positions.size());
      positions.push_back(0.5 * (positions[a] + positions[b]) + Vec3(0, height, 0));
      faces.insert(faces.end(), {{a, b, m}, {a, m, d}, {m, b, c}, {m, c, d}});
    }
  }
  Atlas atlas = flat_atlas(positions, faces);
  for (Vec2& uv : atlas.corner_uvs) uv = {uv.x() / n + 0.02 * std::sin(0.3 * uv.y()), 0.9 * uv.y() / n};
  return atlas;
}

TEST(RepairCharts, NeedlesOfAnyHeightLeaveTheResultAlone) {
  const RefineOptions options{.pe_bound = 0.9};
  const double without = testing::refine_soundly(with_needles(0.2), options).after.distortion;
  for (const double height : {1e-3, 1e-5, 1e-6, 1e-7, 1e-8, 1e-12, 0.0}) {
    const RefineResult result = testing::refine_soundly(with_needles(height), options);
    EXPECT_NEAR(result.after.distortion - 1, without - 1, 0.1 * (without - 1)) << height;
    EXPECT_LT(result.iterations, 200) << height;
  }
}

TEST(RepairCharts, ADoubledTriangleIsOpenedAlongTwoSides) {
  Chart pillow{.uvs = {{0, 0}, {1, 0}, {0.3, 0.8}},
               .triangles = {{0, 1, 2}, {2, 1, 0}},
               .surface = {},
               .triangle_faces = {0, 1},
               .boundary_loops = {}};
  const Vec3 p(0, 0, 0), q(1, 0, 0), r(0.3, 0.8, 0);
  pillow.surface = Surface({rest_from_space(p, q, r), rest_from_space(r, q, p)});
  const RepairedCharts out = repaired({pillow}, {.open_closed = true});
  ASSERT_TRUE(out.unmended.empty()) << out.unmended[0].reason;
  EXPECT_EQ(out.atlas.seams.size(), 2u);
  testing::expect_certified(meshes_of(out.atlas));
}

TEST(RepairCharts, AWrappedTubeEndsFlat) {
  // A tube whose last column runs back over the whole width, as unwrapping without a seam makes it.
  Atlas atlas = shapes::torus(24, 12, 1);
  for (int f = 0; f < atlas.face_count(); ++f) {
    const int i = (f + 1) / 12, j = (f + 1) % 12;
    for (int k = 0; k < 4; ++k)
      atlas.corner_uvs[4 * f + k] = {((k == 1 || k == 2 ? i + 1 : i) % 24) / 24.0, ((k >= 2 ? j + 1 : j) % 12) / 12.0};
  }
  const RepairedCharts out = repaired(testing::charts_of(atlas), {.open_closed = true});
  ASSERT_TRUE(out.unmended.empty());
  testing::expect_certified(meshes_of(out.atlas));
}

}  // namespace
}  // namespace atlas_refine
