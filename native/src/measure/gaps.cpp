// Smallest distances between and within charts.
#include <cmath>
#include <limits>

#include "geometry/predicates.h"
#include "measure/boundary_edges.h"
#include "measure/certificate.h"

namespace atlas_refine {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec2 nearest_on_edge(const Vec2& p, const BoundaryEdge& edge) {
  const Vec2 along = edge.to - edge.from;
  const double squared = along.squaredNorm();
  const double t = squared > 0 ? std::clamp((p - edge.from).dot(along) / squared, 0.0, 1.0) : 0;
  return edge.from + t * along;
}

double distance(const BoundaryEdge& a, const BoundaryEdge& b) {
  if (segments_touch(a.from, a.to, b.from, b.to)) return 0;
  return std::min({(nearest_on_edge(a.from, b) - a.from).norm(), (nearest_on_edge(a.to, b) - a.to).norm(),
                   (nearest_on_edge(b.from, a) - b.from).norm(), (nearest_on_edge(b.to, a) - b.to).norm()});
}

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Whether `direction` leaves the corner between the boundary edges with directions `in` and `out` into the outside.
bool leaves_outside(const Vec2& in, const Vec2& out, const Vec2& direction) {
  const bool left_of_in = cross(in, direction) > 0, left_of_out = cross(out, direction) > 0;
  const bool inside = cross(in, out) >= 0 ? left_of_in && left_of_out : left_of_in || left_of_out;
  return !inside;
}

/// One boundary loop of a chart, with arc lengths.
class LoopGap {
 public:
  LoopGap(const BoundaryEdge* edges, int count, double far_arc) : edges_(edges), count_(count), far_arc_(far_arc) {
    arcs_.assign(count + 1, 0);
    for (int i = 0; i < count; ++i) arcs_[i + 1] = arcs_[i] + (edges[i].to - edges[i].from).norm();
  }

  double perimeter() const { return arcs_.back(); }

  /// Distance from the start of edge i to edge j; infinity where they do not face each other or are near along the boundary.
  double facing_distance(int i, int j) const {
    const Vec2& p = edges_[i].from;
    const Vec2 q = nearest_on_edge(p, edges_[j]);
    const double arc = std::abs(arcs_[i] - arcs_[j] - (q - edges_[j].from).norm());
    if (std::min(arc, perimeter() - arc) < far_arc_) return kInfinity;
    if (!leaves_outside(direction(i - 1), direction(i), q - p)) return kInfinity;
    const bool at_start = q == edges_[j].from, at_end = q == edges_[j].to;
    const Vec2 in = direction(at_start ? j - 1 : j), out = direction(at_end ? j + 1 : j);
    return leaves_outside(in, out, p - q) ? (q - p).norm() : kInfinity;
  }

 private:
  Vec2 direction(int i) const {
    const BoundaryEdge& edge = edges_[(i + count_) % count_];
    return edge.to - edge.from;
  }

  const BoundaryEdge* edges_;
  int count_;
  double far_arc_;
  std::vector<double> arcs_;
};

double gap_within_loop(const std::vector<BoundaryEdge>& edges, double far_arc) {
  const LoopGap loop(edges.data(), static_cast<int>(edges.size()), far_arc);
  if (loop.perimeter() < 2 * far_arc) return kInfinity;
  const BoxTree tree = tree_over(edges);
  double radius = far_arc;
  double best = kInfinity;
  for (int i = 0; i < static_cast<int>(edges.size()); ++i) {
    tree.visit_within({edges[i].from, edges[i].from}, radius, -1, [&](int j) {
      const double d = loop.facing_distance(i, j);
      if (d < radius || (d == radius && d < best)) best = radius = d;
      return true;
    });
  }
  return best;
}

}  // namespace

double gap_between_charts(const std::vector<Chart>& charts) {
  const std::vector<BoundaryEdge> edges = boundary_edges(charts);
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

std::vector<double> gap_within_charts(const std::vector<Chart>& charts, double far_arc) {
  std::vector<double> gaps(charts.size(), kInfinity);
  const std::vector<BoundaryEdge> edges = boundary_edges(charts);
  for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
    const int chart = edges[first].chart;
    while (end < edges.size() && edges[end].chart == chart && edges[end].loop == edges[first].loop) ++end;
    const std::vector<BoundaryEdge> loop(edges.begin() + first, edges.begin() + end);
    gaps[chart] = std::min(gaps[chart], gap_within_loop(loop, far_arc));
  }
  return gaps;
}

}  // namespace atlas_refine
