// Axis-parallel trails traced through the triangles of an axis-aligned chart (section 3.2, "Naive decomposition" and "Cutting").
#pragma once

#include <vector>

#include "geometry/split_mesh.h"

namespace atlas_refine {

/// Where a trail begins: a boundary vertex, and its direction in quarter turns.
struct TrailStart {
  int vertex;
  int quarter_turns;
};

/// Traces through a mesh and divides it on the way, so that every trail is a path of edges. Works triangle by triangle: charts
/// that overlap themselves are no special case. Coordinates on a trail are equal to the last bit.
class TrailTracer {
 public:
  /// `boundary` vertices are counterclockwise; the edge from boundary[i] on runs towards quarter_turns[i] * pi/2.
  TrailTracer(SplitMesh& mesh, const std::vector<int>& boundary, const std::vector<int>& quarter_turns);

  enum class Until { Boundary, BoundaryOrTrail };

  /// Vertices that are not to move: the starts of trails, before any of them is traced.
  void hold(int vertex) { marks_[vertex] |= kKeepX | kKeepY; }

  /// The vertices passed, the start first. The start alone where the way leads out of the chart or along its boundary. Where a
  /// trail would pass a vertex closely the vertex is drawn onto it, if its triangles allow; else the edge is divided.
  std::vector<int> trace(const TrailStart& start, Until until);

  /// The vertices of a trail that was traced to `end`; other trails may have added some since.
  std::vector<int> path(const TrailStart& start, int end);

 private:
  static constexpr unsigned char kKeepX = 1, kKeepY = 2, kOnTrail = 4, kOnBoundary = 8;

  int next_vertex(int at, int quarter_turns);
  bool draw_onto(int vertex, int coordinate, double value);

  SplitMesh& mesh_;
  std::vector<unsigned char> marks_;  // per vertex: what it lies on, and which coordinates must stay
};

}  // namespace atlas_refine
