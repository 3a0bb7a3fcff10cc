// Flat boundaries and the grid search for near pairs.
#include "geometry/boundary.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

namespace atlas_refine {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Surface length of every boundary edge of a chart, keyed by (start, end).
std::map<std::pair<int, int>, double> surface_lengths(const Chart& chart) {
  std::map<std::pair<int, int>, double> lengths;
  std::vector<char> on_boundary(chart.vertex_count(), 0);
  for (const auto& loop : chart.boundary_loops) {
    for (int v : loop) on_boundary[v] = 1;
  }
  for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
    const Triangle& triangle = chart.triangles[t];
    if (on_boundary[triangle[0]] + on_boundary[triangle[1]] + on_boundary[triangle[2]] < 2) continue;
    const Mat2 edges = chart.surface[t].inverse_edges.inverse();
    const Vec2 e1 = edges.col(0);
    const Vec2 e2 = edges.col(1);
    lengths[{triangle[0], triangle[1]}] = e1.norm();
    lengths[{triangle[1], triangle[2]}] = (e2 - e1).norm();
    lengths[{triangle[2], triangle[0]}] = e2.norm();
  }
  return lengths;
}

struct Bounds {
  Vec2 low, high;
};

Bounds swept_bounds(const Vec2& a, const Vec2& b) { return {a.cwiseMin(b), a.cwiseMax(b)}; }
Bounds united(const Bounds& a, const Bounds& b) { return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)}; }
bool overlap(const Bounds& a, const Bounds& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

/// Uniform grid over edge bounds, stored as one array sorted by cell.
class EdgeGrid {
 public:
  EdgeGrid(const std::vector<Bounds>& edges, double radius) {
    Bounds all = edges.front();
    double extent = 0;
    for (const Bounds& b : edges) {
      all = united(all, b);
      extent += (b.high - b.low).sum();
    }
    const Vec2 size = all.high - all.low;
    const double count = static_cast<double>(edges.size());
    // Cells as large as a typical edge and the radius, but not many more of them than edges.
    cell_ = std::max({extent / count, 2 * radius, std::sqrt(size.x() * size.y() / (4 * count)), size.maxCoeff() / 4096, 1e-300});
    low_ = all.low;
    columns_ = 1 + static_cast<int>(size.x() / cell_);
    rows_ = 1 + static_cast<int>(size.y() / cell_);
    start_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
    for (const Bounds& b : edges) for_cells(b, [&](int cell) { ++start_[cell + 1]; });
    for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
    members_.resize(start_.back());
    std::vector<int> fill(start_.begin(), start_.end() - 1);
    for (int e = 0; e < static_cast<int>(edges.size()); ++e) {
      for_cells(edges[e], [&](int cell) { members_[fill[cell]++] = e; });
    }
  }

  template <class Visit>
  void for_members(const Bounds& bounds, Visit visit) const {
    for_cells(bounds, [&](int cell) {
      for (int k = start_[cell]; k < start_[cell + 1]; ++k) visit(members_[k]);
    });
  }

 private:
  int clamped(double offset, int count) const {
    return static_cast<int>(std::clamp(std::floor(offset / cell_), 0.0, static_cast<double>(count - 1)));
  }
  template <class Visit>
  void for_cells(const Bounds& b, Visit visit) const {
    const int x0 = clamped(b.low.x() - low_.x(), columns_), x1 = clamped(b.high.x() - low_.x(), columns_);
    const int y0 = clamped(b.low.y() - low_.y(), rows_), y1 = clamped(b.high.y() - low_.y(), rows_);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) visit(y * columns_ + x);
    }
  }

  double cell_;
  Vec2 low_;
  int columns_, rows_;
  std::vector<int> start_;
  std::vector<int> members_;
};

/// True where `direction` points out of the chart at boundary vertex v.
bool points_outside(const Boundary& boundary, const std::vector<Vec2>& positions, int v, const Vec2& direction) {
  const Vec2& at = positions[boundary.vertex[v]];
  const Vec2 in = at - positions[boundary.vertex[boundary.previous[v]]];
  const Vec2 out = positions[boundary.vertex[boundary.next[v]]] - at;
  const bool right_of_in = cross(in, direction) < 0;
  const bool right_of_out = cross(out, direction) < 0;
  return cross(in, out) >= 0 ? right_of_in || right_of_out : right_of_in && right_of_out;
}

}  // namespace

double Boundary::arc_between(int point, int edge) const {
  const double length = loop_length[loop[point]];
  const auto between = [&](int a, int b) {
    const double d = std::abs(arc[a] - arc[b]);
    return std::min(d, length - d);
  };
  return std::min(between(point, edge), between(point, next[edge]));
}

Boundary make_boundary(const std::vector<Chart>& charts, const std::vector<int>& first_vertex) {
  Boundary boundary;
  for (std::size_t c = 0; c < charts.size(); ++c) {
    const auto lengths = surface_lengths(charts[c]);
    for (const auto& loop : charts[c].boundary_loops) {
      const int first = boundary.size();
      const int count = static_cast<int>(loop.size());
      double arc = 0;
      for (int k = 0; k < count; ++k) {
        boundary.vertex.push_back(first_vertex[c] + loop[k]);
        boundary.next.push_back(first + (k + 1) % count);
        boundary.previous.push_back(first + (k + count - 1) % count);
        boundary.chart.push_back(static_cast<int>(c));
        boundary.loop.push_back(static_cast<int>(boundary.loop_length.size()));
        boundary.arc.push_back(arc);
        arc += lengths.at({loop[k], loop[(k + 1) % count]});
      }
      boundary.loop_length.push_back(arc);
    }
  }
  return boundary;
}

std::vector<PointEdge> near_pairs(const Boundary& boundary, const std::vector<Vec2>& positions,
                                  const std::vector<Vec2>& displacements, double radius) {
  const int n = boundary.size();
  std::vector<PointEdge> pairs;
  if (n == 0) return pairs;
  std::vector<Bounds> points(n);
  for (int i = 0; i < n; ++i) {
    const Vec2& p = positions[boundary.vertex[i]];
    points[i] = displacements.empty() ? Bounds{p, p} : swept_bounds(p, p + displacements[boundary.vertex[i]]);
  }
  std::vector<Bounds> edges(n);
  for (int e = 0; e < n; ++e) edges[e] = united(points[e], points[boundary.next[e]]);
  const EdgeGrid grid(edges, radius);
  std::vector<int> seen(n, -1);
  std::vector<int> found;
  for (int i = 0; i < n; ++i) {
    const Bounds reach{points[i].low.array() - radius, points[i].high.array() + radius};
    found.clear();
    grid.for_members(reach, [&](int e) {
      if (seen[e] == i || e == i || boundary.next[e] == i) return;
      seen[e] = i;
      if (boundary.chart[e] == boundary.chart[i] && boundary.loop[e] != boundary.loop[i]) return;
      if (overlap(reach, edges[e])) found.push_back(e);
    });
    std::sort(found.begin(), found.end());
    for (int e : found) pairs.push_back({i, e});
  }
  return pairs;
}

Closest closest_on_segment(const Vec2& point, const Vec2& start, const Vec2& end) {
  const Vec2 edge = end - start;
  const double length2 = edge.squaredNorm();
  const double along = length2 > 0 ? std::clamp(edge.dot(point - start) / length2, 0.0, 1.0) : 0.0;
  const Vec2 offset = along == 1 ? Vec2(point - end) : Vec2(point - start - along * edge);
  return {along, offset, offset.norm()};
}

bool faces_outside(const Boundary& boundary, const std::vector<Vec2>& positions, const PointEdge& pair, const Closest& closest) {
  if (!points_outside(boundary, positions, pair.point, -closest.offset)) return false;
  if (closest.along == 0) return points_outside(boundary, positions, pair.edge, closest.offset);
  if (closest.along == 1) return points_outside(boundary, positions, boundary.next[pair.edge], closest.offset);
  const Vec2 edge = positions[boundary.vertex[boundary.next[pair.edge]]] - positions[boundary.vertex[pair.edge]];
  return cross(edge, closest.offset) < 0;
}

}  // namespace atlas_refine
