// Cutting: pieces are rectangles that tile their charts, new points know where they lie, borders fit together in space.
#include "cut/cut_atlas.h"

#include <Eigen/Geometry>

#include "cut/open_to_disk.h"
#include "cut_checks.h"

namespace atlas_refine {
namespace {

using testing::Laid;

/// Where the vertices of each chart lie in space.
std::vector<std::vector<Vec3>> chart_positions(const Laid& laid) {
  std::vector<std::vector<Vec3>> out;
  for (const Chart& chart : laid.set.charts) out.emplace_back(chart.vertex_count());
  for (int c = 0; c < laid.atlas.corner_count(); ++c) {
    const CornerRef& at = laid.set.corners[c];
    out[at.chart][at.vertex] = laid.atlas.positions[laid.atlas.corner_vertices[c]];
  }
  return out;
}

Vec3 in_space(const std::vector<Vec3>& positions, const Support& support) {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    if (support.vertices[k] >= 0) sum += support.weights[k] * positions[support.vertices[k]];
  }
  return sum;
}

TEST(CutAtlas, PiecesAreRectanglesThatTileTheirCharts) {
  for (const Atlas& atlas : testing::many_atlases()) {
    const Laid laid = testing::laid(atlas);
    std::vector<double> surface(laid.set.charts.size(), 0), plane(laid.set.charts.size(), 0);
    for (const Piece& piece : laid.cut.pieces) {
      testing::expect_positive(piece.mesh.uvs, piece.mesh.triangles);
      testing::expect_conforming(SplitMesh(piece.mesh));
      EXPECT_EQ(piece.mesh.boundary_loops.size(), 1u);
      surface[piece.chart] += testing::rest_area(piece.mesh);
      plane[piece.chart] += uv_area({piece.mesh});
      if (laid.aligned[piece.chart].way != AxisAlignedChart::Way::AsItIs) {
        EXPECT_NEAR(uv_area({piece.mesh}), uv_box({piece.mesh}).area(), 1e-10) << "not a rectangle";
      }
    }
    for (std::size_t c = 0; c < laid.set.charts.size(); ++c) {
      EXPECT_NEAR(surface[c], testing::rest_area(laid.set.charts[c]), 1e-10);
      EXPECT_NEAR(plane[c], uv_area({laid.aligned[c].mesh.to_chart(laid.set.charts[c])}), 1e-10);
    }
  }
}

TEST(CutAtlas, VerticesKnowWhereTheyLie) {
  for (const Atlas& atlas : testing::many_atlases()) {
    const Laid laid = testing::laid(atlas);
    const auto positions = chart_positions(laid);
    for (const Piece& piece : laid.cut.pieces) {
      const int count = piece.mesh.vertex_count();
      ASSERT_EQ(static_cast<int>(piece.vertices.size()), count);
      ASSERT_EQ(static_cast<int>(piece.points.size()), count);
      ASSERT_EQ(static_cast<int>(piece.supports.size()), count);
      for (int v = 0; v < count; ++v) {
        ASSERT_NE(piece.vertices[v] >= 0, piece.points[v] >= 0);
        if (piece.vertices[v] >= 0) {
          EXPECT_EQ(piece.supports[v].vertices[0], piece.vertices[v]);
          continue;
        }
        const SurfacePoint& point = laid.cut.points[piece.points[v]];
        const Vec3 there = in_space(positions[point.chart], point.support);
        EXPECT_LT((there - in_space(positions[piece.chart], piece.supports[v])).norm(), 1e-9);
      }
      // Parts have the rest shapes of what they are in space.
      for (std::size_t t = 0; t < piece.mesh.triangles.size(); ++t) {
        std::array<Vec3, 3> p;
        for (int k = 0; k < 3; ++k) p[k] = in_space(positions[piece.chart], piece.supports[piece.mesh.triangles[t][k]]);
        const double area = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
        EXPECT_NEAR(piece.mesh.surface[t].area, area, 1e-9 * (1 + area));
      }
    }
  }
}

/// How many triangles of all pieces have each edge of points in space; chart vertices are positive, new points negative.
std::map<std::pair<int, int>, int> edge_uses(const Laid& laid) {
  const auto& points = laid.set.points;
  std::map<std::pair<int, int>, int> uses;
  for (const Piece& piece : laid.cut.pieces) {
    const auto id = [&](int v) { return piece.points[v] >= 0 ? ~piece.points[v] : points[piece.chart][piece.vertices[v]]; };
    for (const Triangle& t : piece.mesh.triangles) {
      for (int k = 0; k < 3; ++k) ++uses[std::minmax(id(t[k]), id(t[(k + 1) % 3]))];
    }
  }
  return uses;
}

TEST(CutAtlas, TheSurfaceStaysClosed) {
  for (const Atlas& atlas : testing::many_atlases()) {
    const Laid laid = testing::laid(atlas);
    const auto& points = laid.set.points;
    const auto positions = chart_positions(laid);
    std::map<std::pair<int, int>, int> before;
    std::map<int, Vec3> where;
    for (std::size_t c = 0; c < laid.set.charts.size(); ++c) {
      for (int v = 0; v < laid.set.charts[c].vertex_count(); ++v) where[points[c][v]] = positions[c][v];
      for (const Triangle& t : laid.set.charts[c].triangles) {
        for (int k = 0; k < 3; ++k) ++before[std::minmax(points[c][t[k]], points[c][t[(k + 1) % 3]])];
      }
    }
    for (std::size_t p = 0; p < laid.cut.points.size(); ++p)
      where[~static_cast<int>(p)] = in_space(positions[laid.cut.points[p].chart], laid.cut.points[p].support);
    const auto length = [&](const auto& uses, int count) {
      double sum = 0;
      for (const auto& [edge, used] : uses) {
        EXPECT_LE(used, 2);
        if (used == count) sum += (where.at(edge.first) - where.at(edge.second)).norm();
      }
      return sum;
    };
    EXPECT_NEAR(length(edge_uses(laid), 1), length(before, 1), 1e-9) << "the border of the surface has changed";
  }
}

TEST(CutAtlas, BordersOfTwoChartsAreDividedAlike) {
  const Laid laid = testing::laid(testing::open_box(5), 0.85);
  ASSERT_FALSE(laid.cut.seams.empty());
  EXPECT_FALSE(laid.cut.points.empty());
  // A new point on a border in space is one point for both charts.
  std::map<int, std::set<int>> charts_of_point;
  for (const Piece& piece : laid.cut.pieces) {
    for (int point : piece.points) {
      if (point >= 0) charts_of_point[point].insert(piece.chart);
    }
  }
  EXPECT_TRUE(std::any_of(charts_of_point.begin(), charts_of_point.end(), [](const auto& p) { return p.second.size() == 2; }));
}

TEST(CutAtlas, WithoutTrailsChartsStayWhole) {
  const Atlas atlas = shapes::mesh(shapes::u_shape(), 0.12);
  Laid laid = testing::laid(atlas);
  const CutAtlas divided = divided_atlas({laid.aligned[0].mesh}, laid.set.charts, laid.set.points);
  const CutAtlas cut = cut_along(divided, laid.set.charts, {});
  EXPECT_EQ(cut.pieces.size(), 1u);
  EXPECT_TRUE(cut.seams.empty());
}

TEST(CutAtlas, AnUncutAtlasIsTheIdentity) {
  const std::vector<Chart> charts = testing::charts_of(shapes::disk_in_ring());
  const CutAtlas atlas = whole_atlas(charts);
  ASSERT_EQ(atlas.pieces.size(), charts.size());
  EXPECT_TRUE(atlas.points.empty());
  EXPECT_TRUE(atlas.seams.empty());
  for (std::size_t c = 0; c < charts.size(); ++c) {
    EXPECT_EQ(atlas.pieces[c].mesh.triangles, charts[c].triangles);
    for (int v = 0; v < charts[c].vertex_count(); ++v)
      EXPECT_EQ(value_at(atlas.pieces[c].supports[v], charts[c].uvs), charts[c].uvs[v]);
  }
}

// A ring opened along a path, then cut along another: both are seams, met from both sides and counted once.
TEST(CutAtlas, OpeningsAndPathsAreSeamsOnce) {
  const std::vector<Chart> ring = {testing::chart_of(shapes::ring(), 0.1)};
  SplitMesh mesh(ring[0]);
  const Opening opening = open_to_disk(mesh);
  EXPECT_EQ(opening.holes_cut, 1);
  EXPECT_TRUE(opening.is_disk);
  std::vector<std::vector<int>> points(1);
  for (int v = 0; v < ring[0].vertex_count(); ++v) points[0].push_back(v);
  const CutAtlas opened = divided_atlas({mesh}, ring, points);
  const std::size_t doubled = mesh.vertex_count() - ring[0].vertex_count();
  EXPECT_EQ(opened.seams.size(), doubled - 1);
  // From every boundary vertex with an inner edge to another boundary vertex the piece falls apart.
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const auto fan = mesh.fan(v);
    if (!mesh.is_boundary(fan.front())) continue;
    for (std::size_t k = 1; k < fan.size(); ++k) {
      const int other = mesh.to(fan[k]);
      if (!mesh.on_boundary(other)) continue;
      const SurfacePath path{0, {v, other}};
      const CutAtlas cut = cut_along(opened, ring, {&path, 1});
      EXPECT_EQ(cut.pieces.size(), 2u);
      EXPECT_EQ(cut.seams.size(), opened.seams.size() + 1);
      EXPECT_NEAR(cut.pieces[0].mesh.surface.area() + cut.pieces[1].mesh.surface.area(), ring[0].surface.area(), 1e-12);
    }
  }
}

}  // namespace
}  // namespace atlas_refine
