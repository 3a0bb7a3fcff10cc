// Smallest distances between and within charts.
#include <algorithm>
#include <limits>

#include "geometry/boundary.h"
#include "geometry/box_tree.h"
#include "geometry/predicates.h"
#include "measure/boundary_edges.h"
#include "measure/certificate.h"
#include "measure/distortion.h"

namespace atlas_refine {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double distance(const Vec2& p, const BoundaryEdge& edge) { return closest_on_segment(p, edge.from, edge.to).distance; }

double distance(const BoundaryEdge& a, const BoundaryEdge& b) {
  if (segments_touch(a.from, a.to, b.from, b.to)) return 0;
  return std::min({distance(a.from, b), distance(a.to, b), distance(b.from, a), distance(b.to, a)});
}

/// One boundary per chart set, with the positions it refers to.
struct PlacedBoundary {
  std::vector<Vec2> positions;
  Boundary boundary;

  explicit PlacedBoundary(const std::vector<Chart>& charts) {
    std::vector<int> first_vertex;
    for (const Chart& chart : charts) {
      first_vertex.push_back(static_cast<int>(positions.size()));
      positions.insert(positions.end(), chart.uvs.begin(), chart.uvs.end());
    }
    boundary = make_boundary(charts, first_vertex);
  }

  const Vec2& at(int point) const { return positions[boundary.vertex[point]]; }
  Box edge_box(int edge) const {
    const Vec2 &a = at(edge), &b = at(boundary.next[edge]);
    return {a.cwiseMin(b), a.cwiseMax(b)};
  }
};

/// The loop is the range [first, end) of the boundary.
double gap_within_loop(const PlacedBoundary& placed, int first, int end, double far_arc, double reach) {
  const Boundary& boundary = placed.boundary;
  if (boundary.loop_length[boundary.loop[first]] < 2 * far_arc) return kInfinity;
  std::vector<Box> boxes;
  for (int e = first; e < end; ++e) boxes.push_back(placed.edge_box(e));
  const BoxTree tree(std::move(boxes), std::vector<int>(end - first, 0));
  double best = kInfinity, radius = reach;
  for (int point = first; point < end; ++point) {
    const Vec2& p = placed.at(point);
    tree.visit_within({p, p}, radius, -1, [&](int item) {
      const int edge = first + item;
      if (edge == point || boundary.next[edge] == point || boundary.arc_between(point, edge) < far_arc) return true;
      const Closest closest = closest_on_segment(p, placed.at(edge), placed.at(boundary.next[edge]));
      // Where borders touch there is no direction in which they could face each other.
      const bool facing = closest.distance == 0 || faces_outside(boundary, placed.positions, {point, edge}, closest);
      if (facing && closest.distance <= radius) best = radius = closest.distance;
      return best > 0;
    });
  }
  return best;
}

}  // namespace

double gap_between_charts(const std::vector<Chart>& charts, const Freedoms& freedom) {
  std::vector<BoundaryEdge> edges = boundary_edges(charts);
  const auto first_fixed = std::find(freedom.begin(), freedom.end(), Freedom::Fixed);
  for (BoundaryEdge& edge : edges) {
    // All fixed charts count as one.
    if (is_fixed(freedom, edge.chart)) edge.chart = static_cast<int>(first_fixed - freedom.begin());
  }
  const BoxTree tree = tree_over(edges);
  double best = kInfinity;
  for (const BoundaryEdge& edge : edges) {
    tree.visit_within(edge.box(), best, edge.chart, [&](int other) {
      best = std::min(best, distance(edge, edges[other]));
      return best > 0;
    });
    if (best == 0) return 0;
  }
  return best;
}

std::vector<double> gap_within_charts(const std::vector<Chart>& charts, double far_arc, double reach) {
  std::vector<double> gaps(charts.size(), kInfinity);
  const PlacedBoundary placed(charts);
  const Boundary& boundary = placed.boundary;
  for (int first = 0, end = 0; first < boundary.size(); first = end) {
    while (end < boundary.size() && boundary.loop[end] == boundary.loop[first]) ++end;
    double& gap = gaps[boundary.chart[first]];
    gap = std::min(gap, gap_within_loop(placed, first, end, far_arc, reach));
  }
  return gaps;
}

double gap_within(const std::vector<Chart>& charts, double best_scale, double reach) {
  const Box box = uv_box(charts);
  const double diagonal = box.diagonal() > 0 ? box.diagonal() : 1;
  const std::vector<double> gaps = gap_within_charts(charts, kFarArc * diagonal * best_scale, reach * diagonal);
  return *std::min_element(gaps.begin(), gaps.end()) / diagonal;
}

}  // namespace atlas_refine
