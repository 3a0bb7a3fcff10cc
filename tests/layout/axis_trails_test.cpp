// Trails: straight to the last bit, from boundary to boundary, past vertices and through edges without a flip.
#include "layout/axis_trails.h"

#include "cut_checks.h"

namespace atlas_refine {
namespace {

struct Traced {
  AxisAlignedChart chart;
  std::vector<TrailStart> starts;
  std::vector<std::vector<int>> paths;
};

/// A trail inwards from every reflex corner and from some straight boundary vertices.
Traced traced(const Chart& source, TrailTracer::Until until) {
  Traced out{testing::aligned({source}).front(), {}, {}};
  const auto& turns = out.chart.quarter_turns;
  for (std::size_t i = 1; i < turns.size(); ++i) {
    if (turns[i] < turns[i - 1] || (turns[i] == turns[i - 1] && i % 7 == 0))
      out.starts.push_back({out.chart.boundary[i], turns[i] + 1});
  }
  TrailTracer tracer(out.chart.mesh, out.chart.boundary, turns);
  for (const TrailStart& start : out.starts) tracer.hold(start.vertex);
  std::vector<int> ends;
  for (const TrailStart& start : out.starts) ends.push_back(tracer.trace(start, until).back());
  for (std::size_t k = 0; k < ends.size(); ++k) out.paths.push_back(tracer.path(out.starts[k], ends[k]));
  return out;
}

void expect_straight(const Traced& t) {
  const auto& uvs = t.chart.mesh.uvs;
  for (std::size_t k = 0; k < t.paths.size(); ++k) {
    const int direction = ((t.starts[k].quarter_turns % 4) + 4) % 4;
    for (std::size_t j = 0; j + 1 < t.paths[k].size(); ++j) {
      const Vec2 step = uvs[t.paths[k][j + 1]] - uvs[t.paths[k][j]];
      EXPECT_EQ(step[1 - direction % 2], 0);
      EXPECT_GT(direction < 2 ? step[direction % 2] : -step[direction % 2], 0);
      EXPECT_GE(t.chart.mesh.find_side(t.paths[k][j], t.paths[k][j + 1]).triangle, 0);
    }
  }
}

TEST(AxisTrails, RunStraightThroughEveryShape) {
  std::vector<Chart> charts = {testing::charts_of(shapes::self_overlapping()).front()};
  for (const shapes::Named& shape : testing::many_polygons()) charts.push_back(testing::chart_of(shape.polygon, 0.12));
  for (std::size_t c = 0; c < charts.size(); ++c) {
    SCOPED_TRACE(c);
    const Traced t = traced(charts[c], TrailTracer::Until::Boundary);
    testing::expect_conforming(t.chart.mesh);
    testing::expect_positive(t.chart.mesh.uvs, t.chart.mesh.triangles);
    expect_straight(t);
    const Chart divided = t.chart.mesh.to_chart(charts[c]);
    EXPECT_NEAR(testing::rest_area(divided), testing::rest_area(charts[c]), 1e-12);
    for (const auto& path : t.paths) {
      if (path.size() > 1) {
        EXPECT_TRUE(t.chart.mesh.on_boundary(path.back()));
      }
      for (std::size_t j = 1; j + 1 < path.size(); ++j) EXPECT_FALSE(t.chart.mesh.on_boundary(path[j]));
    }
  }
}

TEST(AxisTrails, StopAtEarlierTrails) {
  const Traced t = traced(testing::chart_of(shapes::star(), 0.12), TrailTracer::Until::BoundaryOrTrail);
  expect_straight(t);
  std::set<int> passed;
  int stopped = 0;
  for (const auto& path : t.paths) {
    for (std::size_t j = 1; j + 1 < path.size(); ++j) EXPECT_FALSE(passed.contains(path[j]));
    if (path.size() > 1 && !t.chart.mesh.on_boundary(path.back())) {
      ++stopped;
      EXPECT_TRUE(passed.contains(path.back()));
    }
    passed.insert(path.begin(), path.end());
  }
  EXPECT_GT(stopped, 0);
}

TEST(AxisTrails, GoNowhereOutsideOrAlongTheBoundary) {
  AxisAlignedChart chart = testing::aligned({testing::chart_of(shapes::rectangle(1, 0.6), 0.1)}).front();
  TrailTracer tracer(chart.mesh, chart.boundary, chart.quarter_turns);
  for (int turn = 0; turn < 4; ++turn) {
    const int along = chart.quarter_turns[1];
    const std::size_t passed = tracer.trace({chart.boundary[1], along + turn}, TrailTracer::Until::Boundary).size();
    if (turn == 1) {
      EXPECT_GT(passed, 1u);
    } else {
      EXPECT_EQ(passed, 1u) << "turn " << turn;
    }
  }
}

}  // namespace
}  // namespace atlas_refine
