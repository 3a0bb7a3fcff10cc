// The edges of all faces, those of one edge in space next to each other.
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine {

/// One edge of one face. Its ends are sorted by place, where both lie at one place by their UVs, so that all faces of an edge
/// describe it alike.
struct EdgeUse {
  int low_place, high_place;
  int low_vertex, high_vertex;  ///< without length in space the smaller of them first
  int corner;                   ///< that the face has it start from
  int low_corner, high_corner;

  bool runs_up() const { return corner == low_corner; }
  bool has_length() const { return low_place != high_place; }
  auto place_key() const { return std::tie(low_place, high_place); }
  auto vertex_key() const { return std::tie(low_vertex, high_vertex); }
  auto sort_key() const { return std::tie(low_place, high_place, low_vertex, high_vertex, corner); }
  auto uv_key(const Atlas& atlas) const {
    const Vec2 &low = atlas.corner_uvs[low_corner], &high = atlas.corner_uvs[high_corner];
    return std::tie(low.x(), low.y(), high.x(), high.y());
  }
};

using EdgeUses = std::span<const EdgeUse>;

/// All edges of all faces, sorted by place, then by vertex; `place` is the point in space of each vertex.
std::vector<EdgeUse> edge_uses(const Atlas& atlas, const std::vector<int>& place, int threads = 1);

/// Calls body(range) for every range of uses that `same` finds alike with its first one.
template <class Same, class Body>
void for_each_range(EdgeUses uses, Same same, Body body) {
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    while (end < uses.size() && same(uses[end], uses[begin])) ++end;
    body(uses.subspan(begin, end - begin));
  }
}

/// Calls body(range) for the uses of every edge in space.
template <class Body>
void for_each_edge(EdgeUses uses, Body body) {
  for_each_range(
      uses, [](const EdgeUse& a, const EdgeUse& b) { return a.place_key() == b.place_key(); }, body);
}

}  // namespace atlas_refine
