// Side k of triangle t, 3 t + k, runs from its corner k to the next.
#include "geometry/manifold_topology.h"

#include <algorithm>
#include <numeric>

namespace atlas_refine {
namespace {

constexpr int kNone = -1;
constexpr int kPaired = -2;

int side_before(int side) { return side % 3 == 0 ? side + 2 : side - 1; }

class Sides {
 public:
  Sides(int vertex_count, const std::vector<Triangle>& triangles)
      : triangles_(triangles), vertex_count_(vertex_count), opposite_(3 * triangles.size(), kNone) {}

  int count() const { return static_cast<int>(opposite_.size()); }
  int from(int side) const { return triangles_[side / 3][side % 3]; }
  int to(int side) const { return triangles_[side / 3][(side + 1) % 3]; }
  bool on_boundary(int side) const { return opposite_[side] == kNone; }

  /// Finds the side that runs the other way along each; false where that is no manifold.
  bool pair() {
    const std::vector<int> start = starts();
    std::vector<int> sides(count()), next(start.begin(), start.end() - 1);  // by their lower ends
    for (int s = 0; s < count(); ++s) sides[next[lower_end(s)]++] = s;
    std::vector<int> waiting(vertex_count_, kNone);  // by upper ends
    for (int v = 0; v < vertex_count_; ++v) {
      for (int k = start[v]; k < start[v + 1]; ++k) {
        if (!pair(sides[k], waiting)) return false;
      }
      for (int k = start[v]; k < start[v + 1]; ++k) waiting[upper_end(sides[k])] = kNone;
    }
    return true;
  }

  /// The boundary side that starts at each vertex; nothing where the corners at a vertex are not one fan.
  std::optional<std::vector<int>> boundary_sides() const {
    std::vector<int> first(vertex_count_, kNone), boundary(vertex_count_, kNone), corners(vertex_count_, 0);
    for (int s = 0; s < count(); ++s) {
      ++corners[from(s)];
      first[from(s)] = s;
      if (!on_boundary(s)) continue;
      if (boundary[from(s)] != kNone) return std::nullopt;
      boundary[from(s)] = s;
    }
    for (int v = 0; v < vertex_count_; ++v) {
      const int start = boundary[v] != kNone ? boundary[v] : first[v];
      if (start != kNone && corners_around(start) != corners[v]) return std::nullopt;
    }
    return boundary;
  }

 private:
  int lower_end(int side) const { return std::min(from(side), to(side)); }
  int upper_end(int side) const { return std::max(from(side), to(side)); }

  std::vector<int> starts() const {
    std::vector<int> start(vertex_count_ + 1, 0);
    for (int s = 0; s < count(); ++s) ++start[lower_end(s) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    return start;
  }

  bool pair(int side, std::vector<int>& waiting) {
    if (from(side) == to(side)) return false;
    int& other = waiting[upper_end(side)];
    if (other == kNone) {
      other = side;
      return true;
    }
    if (other == kPaired || from(other) == from(side)) return false;
    opposite_[side] = other;
    opposite_[other] = side;
    other = kPaired;
    return true;
  }

  /// Corners of the fan that starts with a side, counterclockwise to its end or once around.
  int corners_around(int start) const {
    int count = 0, side = start;
    do {
      ++count;
      side = opposite_[side_before(side)];
    } while (side != kNone && side != start);
    return count;
  }

  const std::vector<Triangle>& triangles_;
  int vertex_count_;
  std::vector<int> opposite_;
};

}  // namespace

std::optional<MeshTopology> manifold_topology(int vertex_count, const std::vector<Triangle>& triangles) {
  Sides sides(vertex_count, triangles);
  if (!sides.pair()) return std::nullopt;
  const auto boundary = sides.boundary_sides();
  if (!boundary) return std::nullopt;
  MeshTopology out;
  std::vector<char> used(vertex_count, 0), visited(vertex_count, 0);
  int on_boundary = 0;
  for (int s = 0; s < sides.count(); ++s) {
    used[sides.from(s)] = 1;
    if (!sides.on_boundary(s)) continue;
    ++on_boundary;
    if (visited[sides.from(s)]) continue;
    std::vector<int>& loop = out.boundary_loops.emplace_back();
    for (int v = sides.from(s); !visited[v]; v = sides.to((*boundary)[v])) {
      visited[v] = 1;
      loop.push_back(v);
    }
  }
  const int edges = (sides.count() + on_boundary) / 2;
  out.euler_characteristic =
      static_cast<int>(std::count(used.begin(), used.end(), 1)) - edges + static_cast<int>(triangles.size());
  return out;
}

}  // namespace atlas_refine
