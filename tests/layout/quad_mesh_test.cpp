// Q: its faces are rectangles that tile the chart, trails and segments fit together; so do the rectangles of any graph.
#include "layout/quad_mesh.h"

#include "cut_checks.h"
#include "layout/motorcycles.h"

namespace atlas_refine {
namespace {

struct Case {
  Chart source;
  AxisAlignedChart aligned;
  double area;  ///< in the UV plane
};

std::vector<Case> cases() {
  std::vector<Chart> charts = {testing::charts_of(shapes::self_overlapping()).front()};
  for (const shapes::Named& shape : testing::many_polygons()) charts.push_back(testing::chart_of(shape.polygon, 0.12));
  const auto aligned = testing::aligned(charts);
  std::vector<Case> out;
  for (std::size_t c = 0; c < charts.size(); ++c)
    out.push_back({charts[c], aligned[c], uv_area({aligned[c].mesh.to_chart(charts[c])})});
  return out;
}

void expect_tiles(const std::vector<Box>& boxes, const std::vector<double>& areas, double whole) {
  double sum = 0;
  for (std::size_t f = 0; f < boxes.size(); ++f) {
    EXPECT_NEAR(areas[f], boxes[f].area(), 1e-10) << "not a rectangle";
    sum += areas[f];
  }
  EXPECT_NEAR(sum, whole, 1e-10);
}

TEST(QuadMesh, FacesAreRectanglesThatTileTheChart) {
  for (const Case& c : cases()) {
    for (const int extra : {0, 4}) {
      const QuadMesh quads = make_quad_mesh(c.aligned, c.source, extra);
      expect_tiles(quads.faces, quads.face_areas, c.area);
      EXPECT_GT(quads.boundary_length, 0);
      ASSERT_EQ(quads.corners.size(), quads.optional_corner.size());
    }
  }
}

TEST(QuadMesh, TrailsNodesAndSegmentsFitTogether) {
  for (const Case& c : cases()) {
    const QuadMesh quads = make_quad_mesh(c.aligned, c.source, 4);
    std::map<int, std::pair<int, int>> ends;  // of each segment
    std::vector<int> trail_of_corner(quads.trails.size(), 0);
    for (const auto& corner : quads.corners) {
      for (int t : corner) ++trail_of_corner[t];
    }
    EXPECT_EQ(std::count(trail_of_corner.begin(), trail_of_corner.end(), 1), static_cast<long>(quads.trails.size()));
    for (const auto& trail : quads.trails) {
      ASSERT_EQ(trail.nodes.size(), trail.segments.size() + 1);
      double length = 0;
      for (std::size_t k = 0; k < trail.segments.size(); ++k) {
        const auto& segment = quads.segments[trail.segments[k]];
        length += segment.length;
        EXPECT_NE(segment.left, segment.right);
        EXPECT_GT(segment.length, 0);
        const std::pair<int, int> key = std::minmax(trail.nodes[k], trail.nodes[k + 1]);
        EXPECT_EQ(ends.try_emplace(trail.segments[k], key).first->second, key);
      }
      EXPECT_NEAR(trail.length, length, 1e-9);
      for (int node : trail.nodes) {
        EXPECT_GE(node, 0);
        EXPECT_LT(node, quads.node_count);
      }
    }
  }
}

TEST(QuadMesh, ACornerOfOneQuarterBackHasTwoTrails) {
  for (const Case& c : cases()) {
    const auto& turns = c.aligned.quarter_turns;
    int expected = 0;
    for (std::size_t i = 0; i < turns.size(); ++i) {
      const int reflex = (i > 0 ? turns[i - 1] : turns.back() - 4) - turns[i];
      if (reflex > 0) expected += 1 + reflex;
    }
    EXPECT_EQ(static_cast<int>(make_quad_mesh(c.aligned, c.source, 0).trails.size()), expected);
  }
}

void expect_rule(const QuadMesh& quads, const MotorcycleGraph& graph) {
  for (std::size_t c = 0; c < quads.corners.size(); ++c) {
    if (quads.optional_corner[c]) continue;
    const auto& trails = quads.corners[c];
    int driven = 0;
    for (std::size_t k = 0; k < trails.size(); ++k) {
      driven += graph.driven[trails[k]];
      EXPECT_TRUE(k == 0 || graph.driven[trails[k]] || graph.driven[trails[k - 1]]);
    }
    EXPECT_GE(driven, static_cast<int>(trails.size()) / 2);
  }
}

void expect_decomposed(const Case& c, const QuadMesh& quads, const MotorcycleGraph& graph) {
  expect_rule(quads, graph);
  const Decomposition parts = drive(quads, graph);
  ASSERT_EQ(parts.rectangles.size(), parts.areas.size());
  expect_tiles(parts.rectangles, parts.areas, c.area);
  double all = 0;
  for (const auto& segment : quads.segments) all += segment.length;
  EXPECT_LE(parts.cut_length, all * (1 + 1e-12));
}

TEST(Motorcycles, EveryGraphLeavesRectangles) {
  for (const Case& c : cases()) {
    for (const int extra : {0, 4}) {
      const QuadMesh quads = make_quad_mesh(c.aligned, c.source, extra);
      if (quads.corners.empty()) continue;
      expect_decomposed(c, quads, shortest_graph(quads));
      for (int seed = 0; seed < 30; ++seed) {
        SCOPED_TRACE(seed);
        Rng rng(seed);
        MotorcycleGraph graph = random_graph(quads, rng);
        expect_decomposed(c, quads, graph);
        for (int k = 0; k < 10; ++k) mutate(quads, graph, rng);
        expect_decomposed(c, quads, graph);
      }
    }
  }
}

TEST(Motorcycles, ARectangleNeedsNone) {
  const Chart source = testing::chart_of(shapes::rectangle(1, 0.6), 0.1);
  const QuadMesh quads = make_quad_mesh(testing::aligned({source}).front(), source, 0);
  EXPECT_TRUE(quads.trails.empty());
  EXPECT_EQ(quads.faces.size(), 1u);
  EXPECT_EQ(drive(quads, shortest_graph(quads)).rectangles.size(), 1u);
}

}  // namespace
}  // namespace atlas_refine
