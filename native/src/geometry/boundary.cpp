// Flat boundaries.
#include "geometry/boundary.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "geometry/plane.h"
#include "geometry/rest_triangle.h"

namespace atlas_refine {
namespace {

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

std::vector<char> boundary_flags(const Chart& chart) {
  std::vector<char> flags(chart.vertex_count(), 0);
  for (const std::vector<int>& loop : chart.boundary_loops) {
    for (const int v : loop) flags[v] = 1;
  }
  return flags;
}

std::map<std::pair<int, int>, double> surface_lengths(const Chart& chart) {
  std::map<std::pair<int, int>, double> lengths;
  const std::vector<char> on_boundary = boundary_flags(chart);
  for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
    const Triangle& triangle = chart.triangles[t];
    if (on_boundary[triangle[0]] + on_boundary[triangle[1]] + on_boundary[triangle[2]] < 2) continue;
    const std::array<double, 3> sides = side_lengths(chart.surface[t]);
    for (int k = 0; k < 3; ++k) lengths[{triangle[k], triangle[(k + 1) % 3]}] = sides[k];
  }
  return lengths;
}

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

double boundary_on_surface(const std::vector<Chart>& charts) {
  double sum = 0;
  for (const Chart& chart : charts) {
    const auto lengths = surface_lengths(chart);
    for (const std::vector<int>& loop : chart.boundary_loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) sum += lengths.at({loop[k], loop[(k + 1) % loop.size()]});
    }
  }
  return sum;
}

bool faces_outside(const Boundary& boundary, const std::vector<Vec2>& positions, const PointEdge& pair, const Closest& closest) {
  if (!points_outside(boundary, positions, pair.point, -closest.offset)) return false;
  if (closest.along == 0) return points_outside(boundary, positions, pair.edge, closest.offset);
  if (closest.along == 1) return points_outside(boundary, positions, boundary.next[pair.edge], closest.offset);
  const Vec2 edge = positions[boundary.vertex[boundary.next[pair.edge]]] - positions[boundary.vertex[pair.edge]];
  return cross(edge, closest.offset) < 0;
}

}  // namespace atlas_refine
