// A chart whose triangles can be divided and cut apart, every vertex knowing where on the chart it came from.
#pragma once

#include <array>
#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

/// A point of a chart as a mean of up to three of its vertices, which belong to one of its triangles.
struct Support {
  std::array<int, 3> vertices{-1, -1, -1};  ///< of the chart; -1 where fewer than three are needed
  std::array<double, 3> weights{0, 0, 0};   ///< sum 1
};

/// One side of a triangle: from its corner `side` to the next one.
struct Side {
  int triangle = -1;
  int side = 0;
};

/// Triangles with neighbours. Vertices and triangles of the chart keep their indices; new ones follow. Every vertex has one fan.
class SplitMesh {
 public:
  explicit SplitMesh(const Chart& chart);

  std::vector<Vec2> uvs;
  std::vector<Triangle> triangles;
  std::vector<std::array<int, 3>> neighbours;  ///< across each side, -1 at the boundary
  std::vector<int> sources;                    ///< triangle of the chart that each one is part of
  std::vector<Support> supports;               ///< one per vertex

  int vertex_count() const { return static_cast<int>(uvs.size()); }
  int triangle_count() const { return static_cast<int>(triangles.size()); }
  int from(const Side& s) const { return triangles[s.triangle][s.side]; }
  int to(const Side& s) const { return triangles[s.triangle][(s.side + 1) % 3]; }
  int opposite(const Side& s) const { return triangles[s.triangle][(s.side + 2) % 3]; }
  bool is_boundary(const Side& s) const { return neighbours[s.triangle][s.side] < 0; }
  /// The same edge seen from the other triangle; triangle -1 at the boundary.
  Side twin(const Side& s) const;

  /// The sides that start at `vertex`, counterclockwise; of a boundary vertex from its boundary edge on.
  std::vector<Side> fan(int vertex) const;
  /// True where the vertex lies on the boundary.
  bool on_boundary(int vertex) const { return is_boundary(fan(vertex).front()); }
  /// The side from one vertex to another; triangle -1 where no triangle has it.
  Side find_side(int from, int to) const;

  /// Puts a vertex on the edge, `along` of the way on the surface, and divides the triangles at it. Returns the vertex.
  int split(const Side& side, double along, const Vec2& uv);
  /// Takes the triangles apart along these edges. Vertices that then have several fans are doubled, copies last; returns what
  /// vertex each of the copies is one of.
  std::vector<int> cut(const std::vector<Side>& sides);

  /// Boundary loops as sides, the triangles on the left, ordered by their first side.
  std::vector<std::vector<Side>> boundary_loops() const;
  /// The same as vertex loops, the longest in the UV plane first.
  std::vector<std::vector<int>> vertex_loops() const;

  /// The triangles as a chart of their own, rest shapes, faces and guards from `source`, the chart this was made from.
  Chart to_chart(const Chart& source) const;

 private:
  void set_neighbour(int triangle, int old_neighbour, int neighbour);
  int divide(const Side& side, int vertex);

  std::vector<int> one_triangle_;  // of each vertex
};

/// Of a square with the UV area of the mesh.
double side_of_square(const SplitMesh& mesh);
/// Times that side: edges that are longer belong to long faces.
inline constexpr double kLongEdge = 1.5;

/// The value at a supported point, from the values at the chart's vertices.
Vec2 value_at(const Support& support, const std::vector<Vec2>& values);
/// Weights on the three corners of a triangle of the chart, which the point must lie in.
Vec3 weights_on(const Support& support, const Triangle& triangle);

/// The rest shape of a part of a chart's triangle, whose corners lie where the supports say.
RestTriangle rest_of_part(const Chart& source, int triangle, const std::array<Support, 3>& corners);

/// The guards of `source` on a mesh of parts of its triangles: those of faces that are whole there, all of their triangles
/// undivided and joined. `sources` and `supports` are those of the parts.
std::vector<Guard> guards_of_whole_faces(const Chart& source, const std::vector<Triangle>& parts, const std::vector<int>& sources,
                                         const std::vector<Support>& supports);

/// Point `along` of the way from a to b.
Support between(const Support& a, const Support& b, double along);

}  // namespace atlas_refine
