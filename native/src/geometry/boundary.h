// The boundaries of all charts of an atlas as one flat structure.
#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

/// All boundary vertices, loop after loop. Edge e runs from boundary vertex e to next[e], the chart on its left.
struct Boundary {
  std::vector<int> vertex;  ///< index into the flat vertex array of all charts
  std::vector<int> next;
  std::vector<int> previous;
  std::vector<int> chart;
  std::vector<int> loop;
  std::vector<double> arc;          ///< position along the loop, measured on the surface
  std::vector<double> loop_length;  ///< one per loop

  int size() const { return static_cast<int>(vertex.size()); }
  /// Distance along the common loop between boundary vertex `point` and edge `edge`, on the surface.
  double arc_between(int point, int edge) const;
};

/// Per vertex: whether it lies on the boundary.
std::vector<char> boundary_flags(const Chart& chart);

/// Lengths on the surface of the sides of triangles with two corners or more on the boundary, all boundary edges among them, by
/// (start, end).
std::map<std::pair<int, int>, double> surface_lengths(const Chart& chart);

/// Flattens the loops of `charts`; vertex k of chart c becomes first_vertex[c] + k.
Boundary make_boundary(const std::vector<Chart>& charts, const std::vector<int>& first_vertex);

/// Length on the surface of the boundaries of all charts.
double boundary_on_surface(const std::vector<Chart>& charts);

struct PointEdge {
  int point;  ///< boundary vertex
  int edge;   ///< boundary edge
};

/// Where a point and a segment are closest.
struct Closest {
  double along;     ///< parameter on the segment, in [0, 1]
  Vec2 offset;      ///< from the closest point of the segment to the point
  double distance;  ///< |offset|
};
inline Closest closest_on_segment(const Vec2& point, const Vec2& start, const Vec2& end) {
  const Vec2 edge = end - start;
  const double length2 = edge.squaredNorm();
  const double along = length2 > 0 ? std::clamp(edge.dot(point - start) / length2, 0.0, 1.0) : 0.0;
  const Vec2 offset = along == 1 ? Vec2(point - end) : Vec2(point - start - along * edge);
  return {along, offset, offset.norm()};
}

/// True where the shortest way between point and edge leaves both into the outside of the chart. Pairs that face each other
/// through the chart's interior are no contacts.
bool faces_outside(const Boundary& boundary, const std::vector<Vec2>& positions, const PointEdge& pair, const Closest& closest);

}  // namespace atlas_refine
