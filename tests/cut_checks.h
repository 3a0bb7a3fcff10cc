// What the tests of the road that cuts share: aligned charts of generated atlases, and what every divided mesh must hold.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "align/align.h"
#include "charts.h"
#include "cut/boundary_places.h"
#include "cut/cut_atlas.h"
#include "geometry/plane.h"
#include "geometry/predicates.h"
#include "geometry/split_mesh.h"
#include "layout/search_layout.h"
#include "layout/trail_paths.h"
#include "shapes.h"

namespace atlas_refine::testing {

inline double rest_area(const Chart& chart) { return chart.surface.area(); }

inline Chart chart_of(const shapes::Polygon& polygon, double edge_length = 0.08) {
  return charts_of(shapes::mesh(polygon, edge_length)).front();
}

/// The named polygons and a few random ones.
inline std::vector<shapes::Named> many_polygons() {
  std::vector<shapes::Named> out = shapes::named_polygons();
  for (int seed = 0; seed < 3; ++seed) {
    out.push_back({"random " + std::to_string(seed), shapes::random_polygon(seed)});
    out.push_back({"random star " + std::to_string(seed), shapes::random_star_polygon(seed)});
  }
  return out;
}

/// All of `charts` after stage 1.
inline std::vector<AxisAlignedChart> aligned(const std::vector<Chart>& charts, double sigma = 0.01) {
  Monitor monitor;
  return align_charts(charts, {sigma, 1}, monitor);
}

/// Neighbours know each other, share the vertices of their side, and every vertex has one fan of all its triangles.
inline void expect_conforming(const SplitMesh& mesh) {
  std::vector<std::set<int>> around(mesh.vertex_count());
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Side side{t, k};
      around[mesh.from(side)].insert(t);
      if (mesh.is_boundary(side)) continue;
      const Side twin = mesh.twin(side);
      ASSERT_EQ(twin.triangle, mesh.neighbours[t][k]);
      ASSERT_EQ(mesh.from(twin), mesh.to(side));
      ASSERT_EQ(mesh.to(twin), mesh.from(side));
      ASSERT_EQ(mesh.twin(twin).triangle, t);
    }
  }
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (around[v].empty()) continue;
    std::set<int> fan;
    for (const Side& s : mesh.fan(v)) {
      ASSERT_EQ(mesh.from(s), v);
      fan.insert(s.triangle);
    }
    ASSERT_EQ(fan, around[v]) << "vertex " << v << " has several fans";
  }
}

inline void expect_positive(const std::vector<Vec2>& uvs, const std::vector<Triangle>& triangles) {
  for (const Triangle& t : triangles) ASSERT_EQ(orientation(uvs[t[0]], uvs[t[1]], uvs[t[2]]), 1);
}

/// The UVs that the supports' vertices give, where nothing has moved since.
inline Vec2 supported(const std::vector<Vec2>& uvs, const Support& support) {
  Vec2 sum = Vec2::Zero();
  for (int k = 0; k < 3; ++k) {
    if (support.vertices[k] >= 0) sum += support.weights[k] * uvs[support.vertices[k]];
  }
  return sum;
}

/// Edge i of the boundary runs along quarter_turns[i], to the last bit; the turns add up to one.
inline void expect_axis_aligned(const AxisAlignedChart& chart) {
  const int n = static_cast<int>(chart.boundary.size());
  ASSERT_EQ(chart.quarter_turns.size(), chart.boundary.size());
  int sum = 0;
  for (int i = 0; i < n; ++i) {
    const Vec2 edge = chart.mesh.uvs[chart.boundary[(i + 1) % n]] - chart.mesh.uvs[chart.boundary[i]];
    const int direction = ((chart.quarter_turns[i] % 4) + 4) % 4;
    EXPECT_EQ(edge[1 - direction % 2], 0);
    EXPECT_GT(direction < 2 ? edge[direction % 2] : -edge[direction % 2], 0);
    const int before = i > 0 ? chart.quarter_turns[i - 1] : chart.quarter_turns[n - 1] - 4;
    const int turn = chart.quarter_turns[i] - before;
    EXPECT_LE(turn, 1);
    EXPECT_GE(turn, -2);
    sum += turn;
  }
  EXPECT_EQ(sum, 4);
}

/// A cube of n x n quads on each of five sides, cut along all its edges: charts that share their borders in space.
inline Atlas open_box(int n) {
  Atlas atlas;
  atlas.face_offsets = {0};
  std::map<std::array<int, 3>, int> index;
  const std::array<std::array<Vec3, 3>, 5> sides = {{{Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 1, 0)},
                                                     {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)},
                                                     {Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1)},
                                                     {Vec3(0, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1)},
                                                     {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 1)}}};
  const std::array<Vec3, 5> starts = {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(0, 0, 0)};
  for (int side = 0; side < 5; ++side) {
    const auto corner = [&](int i, int j) {
      const Vec3 p = starts[side] * n + i * sides[side][1] + j * sides[side][2];
      const std::array<int, 3> key = {static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())),
                                      static_cast<int>(std::lround(p.z()))};
      const auto [at, added] = index.try_emplace(key, static_cast<int>(atlas.positions.size()));
      if (added) atlas.positions.push_back(p / n);
      atlas.corner_vertices.push_back(at->second);
      // Bent into an arc, so that charts leave their box half empty.
      const double angle = 2.0 * i / n, radius = 1.3 - 0.9 * j / n;
      atlas.corner_uvs.push_back(Vec2(4.0 * side, 0) + radius * Vec2(-std::cos(angle), std::sin(angle)));
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        for (const auto& [di, dj] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) corner(i + di, j + dj);
        std::reverse(atlas.corner_vertices.end() - 4, atlas.corner_vertices.end());
        std::reverse(atlas.corner_uvs.end() - 4, atlas.corner_uvs.end());
        atlas.face_offsets.push_back(atlas.corner_count());
      }
    }
  }
  return atlas;
}

/// An atlas on its way to rectangles.
struct Laid {
  Atlas atlas;
  ChartSet set;
  std::vector<AxisAlignedChart> aligned;
  Layout layout;
  CutAtlas cut;
};

inline LayoutOptions layout_options(double pe_bound, int threads = 1) {
  return {.pe_bound = pe_bound, .gaps = {Gap{}, Gap{0.6 * Gap{}.value}}, .rectangles = {.candidates = 60}, .threads = threads};
}

inline Laid laid(const Atlas& atlas, double pe_bound = 0.8, double sigma = 0.01) {
  Laid out{atlas, split_charts(atlas), {}, {}, {}};
  Monitor monitor;
  out.aligned = aligned(out.set.charts, sigma);
  out.layout = search_layouts(out.aligned, out.set.charts, layout_options(pe_bound), monitor).front();
  TracedTrails traced = trace_trails(out.aligned, out.layout.trails);
  const auto& points = out.set.points;
  follow_divided(match_boundaries(traced.meshes, points), traced.paths);
  out.cut = cut_along(divided_atlas(traced.meshes, out.set.charts, points), out.set.charts, traced.paths);
  return out;
}

/// Generated atlases of one chart, of many, overlapping, with holes, of polygons, and with shared borders in space.
inline std::vector<Atlas> many_atlases() {
  std::vector<Atlas> out;
  for (const shapes::Named& shape : many_polygons()) out.push_back(shapes::mesh(shape.polygon, 0.12));
  out.push_back(shapes::self_overlapping());
  out.push_back(shapes::disk_in_ring());
  out.push_back(shapes::combine({shapes::mesh(shapes::star(), 0.12), shapes::mirrored(shapes::mesh(shapes::c_shape(), 0.12))}));
  out.push_back(open_box(5));
  return out;
}

}  // namespace atlas_refine::testing
