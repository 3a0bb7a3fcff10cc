// Places on boundary edges in space: what is divided on one side of a seam is divided on the other, at one and the same point.
#pragma once

#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "cut/cut_atlas.h"

namespace atlas_refine {

/// An edge in space; `low` < `high` are points in space.
struct SpaceEdge {
  int low, high;
  bool operator<(const SpaceEdge& other) const { return std::tie(low, high) < std::tie(other.low, other.high); }
};

/// The edges in space that some chart's boundary runs along. `space_points` as in divided_atlas.
std::set<SpaceEdge> borders_in_space(const std::vector<SplitMesh>& meshes, const std::vector<std::vector<int>>& space_points);

/// The vertices that were put on sides of one mesh, by the ends of each side, in the order from its first end to its second.
using DividedSides = std::map<std::pair<int, int>, std::vector<int>>;

/// Divides every side along such an edge where some chart has a vertex at that place in space, so that the mesh in space stays
/// closed. Inside a chart there are such sides where more than two faces meet. One entry per mesh.
std::vector<DividedSides> match_boundaries(std::vector<SplitMesh>& meshes, const std::vector<std::vector<int>>& space_points);

/// The same paths, `piece` a mesh, over the vertices that were put on their sides.
void follow_divided(const std::vector<DividedSides>& divided, std::vector<SurfacePath>& paths);

/// Numbers the points of divided charts: one number for all vertices at one place of a boundary edge in
/// space; that is an edge of `borders` also where another chart has it inside.
class PointNumbers {
 public:
  PointNumbers(const std::vector<std::vector<int>>& space_points, std::vector<SurfacePoint>& points,
               std::set<SpaceEdge> borders = {})
      : space_points_(space_points), points_(points), borders_(std::move(borders)) {}

  /// Per vertex the index of its point, -1 where it is a vertex of the chart.
  std::vector<int> of_chart(int chart, const SplitMesh& mesh);

  /// Of a mesh whose first vertices have numbers already: those, the ones at a place that has one already changed to that.
  std::vector<int> joined(int chart, const SplitMesh& mesh, std::vector<int> numbers);
  /// These, and the numbers of the vertices behind them, which lie on the boundary.
  std::vector<int> of_added(int chart, const SplitMesh& mesh, std::vector<int> numbers);

 private:
  int number(int chart, const Support& support, bool on_boundary);
  int* at(int chart, const Support& support, bool on_boundary);

  const std::vector<std::vector<int>>& space_points_;
  std::vector<SurfacePoint>& points_;
  std::set<SpaceEdge> borders_;
  std::map<SpaceEdge, std::vector<std::pair<double, int>>> on_edges_;
};

}  // namespace atlas_refine
