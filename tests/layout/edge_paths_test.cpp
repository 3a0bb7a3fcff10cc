// Paths along edges beside the trails of real layouts, and the parts that they leave.
#include "layout/edge_paths.h"

#include <limits>

#include "cut_checks.h"
#include "geometry/boundary.h"
#include "input/price_sides.h"
#include "layout/edge_parts.h"
#include "polygon_sheets.h"

namespace atlas_refine {
namespace {

/// What edges a layout's trails become.
struct Snapped {
  testing::Laid laid;
  TracedTrails traced;
  std::vector<SidePrices> prices;
  std::vector<SurfacePath> paths;
};

Snapped snapped(const Atlas& atlas) {
  Snapped out{testing::laid(atlas), {}, {}, {}};
  out.traced = trace_trails(out.laid.aligned, out.laid.layout.trails);
  RefineOptions options;
  options.cut = Cut::Edges;
  out.prices = price_sides(atlas, out.laid.set, options);
  out.paths = edge_paths(out.laid.aligned, out.laid.set.charts, out.traced, out.prices, 1);
  return out;
}

double mean_edge(const Chart& chart) {
  double sum = 0;
  for (const Triangle& t : chart.triangles) {
    for (int k = 0; k < 3; ++k) sum += (chart.uvs[t[(k + 1) % 3]] - chart.uvs[t[k]]).norm();
  }
  return sum / (3.0 * static_cast<double>(chart.triangles.size()));
}

/// Distance of a point in the input's UVs from the nearest trail of its chart.
double distance_to_trails(const Snapped& all, int chart, const Vec2& point) {
  const std::vector<Vec2>& uvs = all.laid.set.charts[chart].uvs;
  const auto place = [&](int v) { return value_at(all.traced.meshes[chart].supports[v], uvs); };
  double least = std::numeric_limits<double>::infinity();
  for (const SurfacePath& trail : all.traced.paths) {
    if (trail.piece != chart) continue;
    for (std::size_t k = 1; k < trail.vertices.size(); ++k)
      least = std::min(least, closest_on_segment(point, place(trail.vertices[k - 1]), place(trail.vertices[k])).distance);
  }
  return least;
}

TEST(EdgePaths, RunAlongInnerEdgesNearTheTrails) {
  for (const shapes::Named& shape : testing::many_polygons()) {
    if (!shape.polygon.holes.empty()) continue;  // their openings are no trails
    SCOPED_TRACE(shape.name);
    const Snapped all = snapped(shapes::mesh(shape.polygon, 0.05));
    ASSERT_EQ(all.paths.empty(), all.traced.paths.empty());
    if (all.paths.empty()) continue;
    double away = 0;
    std::set<std::pair<int, int>> seen;
    for (const SurfacePath& path : all.paths) {
      const Chart& chart = all.laid.set.charts[path.piece];
      ASSERT_EQ(path.vertices.size(), 2);
      EXPECT_TRUE(seen.insert(std::minmax(path.vertices[0], path.vertices[1])).second);
      const SplitMesh mesh(chart);
      const Side side = mesh.find_side(path.vertices[0], path.vertices[1]);
      ASSERT_GE(side.triangle, 0);
      EXPECT_FALSE(mesh.is_boundary(side));
      const double own = distance_to_trails(all, path.piece, chart.uvs[path.vertices[0]]) / mean_edge(chart);
      EXPECT_LT(own, 4);
      away += own;
    }
    EXPECT_LT(away / static_cast<double>(all.paths.size()), 1);
  }
}

TEST(EdgePaths, EveryPathPartsItsChartAndNoPartIsASliver) {
  for (const Atlas& atlas : testing::many_atlases()) {
    const Snapped all = snapped(atlas);
    const std::vector<Chart>& charts = all.laid.set.charts;
    const CutAtlas cut = cut_along(whole_atlas(charts), charts, all.paths);
    std::vector<int> parts(charts.size(), 0);
    for (const Piece& piece : cut.pieces) ++parts[piece.chart];
    for (const Piece& piece : cut.pieces) {
      if (parts[piece.chart] == 1) continue;
      EXPECT_GE(piece.mesh.surface.area(), 0.01 * charts[piece.chart].surface.area());
    }
    // Both sides of every seam lie in different parts: nothing was cut that stays joined.
    std::map<std::array<int, 3>, std::set<int>> pieces_at;
    for (int p = 0; p < static_cast<int>(cut.pieces.size()); ++p) {
      const Piece& piece = cut.pieces[p];
      for (const Triangle& t : piece.mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
          const auto [low, high] = std::minmax(piece.vertices[t[k]], piece.vertices[t[(k + 1) % 3]]);
          pieces_at[{piece.chart, low, high}].insert(p);
        }
      }
    }
    for (const Seam& seam : cut.seams) EXPECT_EQ((pieces_at[{seam.chart, seam.ends[0], seam.ends[1]}].size()), 2);
  }
}

TEST(EdgePaths, ThreadsAndDiagonalsMakeNoDifference) {
  const Atlas atlas = shapes::combine({testing::quads(testing::l_cells(4)), testing::bricks(testing::l_cells(3))});
  const Snapped all = snapped(atlas);
  const auto again = edge_paths(all.laid.aligned, all.laid.set.charts, all.traced, all.prices, 4);
  ASSERT_EQ(again.size(), all.paths.size());
  for (std::size_t k = 0; k < again.size(); ++k) {
    EXPECT_EQ(again[k].piece, all.paths[k].piece);
    EXPECT_EQ(again[k].vertices, all.paths[k].vertices);
    const Chart& chart = all.laid.set.charts[again[k].piece];
    const SplitMesh mesh(chart);
    const Side side = mesh.find_side(again[k].vertices[0], again[k].vertices[1]);
    EXPECT_NE(chart.triangle_faces[side.triangle], chart.triangle_faces[mesh.twin(side).triangle]);
  }
}

TEST(EdgeParts, ACutThatPartsNothingIsNoSeam) {
  const Chart chart = split_charts(testing::quads(testing::l_cells(4))).charts.front();
  const SplitMesh mesh(chart);
  EdgeParts parts(mesh, chart);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.on_boundary(v)) continue;
    parts.cut({mesh.fan(v).front()});
    break;
  }
  EXPECT_TRUE(parts.seams().empty());
}

TEST(EdgeParts, ASliverJoinsTheNeighbourWithTheLongestBorder) {
  const Chart chart = split_charts(testing::quads(testing::cells_where(12, [](int, int) { return true; }))).charts.front();
  const SplitMesh mesh(chart);
  EdgeParts parts(mesh, chart);
  // One quad alone: less than a hundredth of the sheet.
  std::vector<Side> around;
  for (int t = 0; t < 2; ++t) {
    for (int k = 0; k < 3; ++k) {
      if (mesh.neighbours[t][k] > 1) around.push_back({t, k});
    }
  }
  ASSERT_EQ(chart.triangle_faces[0], chart.triangle_faces[1]);
  parts.cut(around);
  EXPECT_TRUE(parts.seams().empty());
}

}  // namespace
}  // namespace atlas_refine
