// Which edges of the faces are joined in the UV map, and which are seams.
#include "input/join_edges.h"

#include <algorithm>
#include <span>
#include <tuple>

#include "geometry/plane.h"
#include "input/places.h"

namespace atlas_refine {

namespace {

/// One edge of one face. Its ends are sorted by place, so that both faces of an edge describe it alike.
struct EdgeUse {
  int low_place, high_place;
  int low_vertex, high_vertex;
  int corner;
  int low_corner, high_corner;

  bool runs_up() const { return corner == low_corner; }
  auto place_key() const { return std::tie(low_place, high_place); }
  auto vertex_key() const { return std::tie(low_vertex, high_vertex); }
  auto sort_key() const { return std::tie(low_place, high_place, low_vertex, high_vertex, corner); }
  auto uv_key(const Atlas& atlas) const {
    const Vec2 &low = atlas.corner_uvs[low_corner], &high = atlas.corner_uvs[high_corner];
    return std::tie(low.x(), low.y(), high.x(), high.y());
  }
};

using EdgeUses = std::span<const EdgeUse>;

std::vector<int> faces_of_corners(const Atlas& atlas) {
  std::vector<int> faces(atlas.corner_count());
  for (int f = 0; f < atlas.face_count(); ++f) {
    std::fill(faces.begin() + atlas.face_offsets[f], faces.begin() + atlas.face_offsets[f + 1], f);
  }
  return faces;
}

/// All edges of all faces, those of one edge in space next to each other.
std::vector<EdgeUse> collect_uses(const Atlas& atlas, const EdgeJoins& joins) {
  const std::vector<int> place = places(atlas.positions);
  std::vector<EdgeUse> uses;
  uses.reserve(atlas.corner_count());
  for (int c = 0; c < atlas.corner_count(); ++c) {
    int low = c, high = joins.next_corner(atlas, c);
    const auto vertex = [&](int corner) { return atlas.corner_vertices[corner]; };
    if (place[vertex(low)] == place[vertex(high)]) continue;  // an edge without length has no other side
    if (place[vertex(low)] > place[vertex(high)]) std::swap(low, high);
    uses.push_back({place[vertex(low)], place[vertex(high)], vertex(low), vertex(high), c, low, high});
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) { return a.sort_key() < b.sort_key(); });
  return uses;
}

/// Calls body(range) for every range of uses that `same` finds alike with its first one.
template <class Same, class Body>
void for_each_range(EdgeUses uses, Same same, Body body) {
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    while (end < uses.size() && same(uses[end], uses[begin])) ++end;
    body(uses.subspan(begin, end - begin));
  }
}

template <class Body>
void for_each_edge(EdgeUses uses, Body body) {
  for_each_range(
      uses, [](const EdgeUse& a, const EdgeUse& b) { return a.place_key() == b.place_key(); }, body);
}

/// Faces on the same side of their common UV edge. Where they do not even share vertices they are the two sides of a sheet.
bool back_to_back(const Atlas& atlas, const EdgeJoins& joins, const EdgeUse& a, const EdgeUse& b) {
  const double area_a = doubled_uv_area(atlas, joins.corner_faces[a.corner]);
  const double area_b = doubled_uv_area(atlas, joins.corner_faces[b.corner]);
  return a.runs_up() == b.runs_up() ? area_a * area_b > 0 : area_a * area_b < 0;
}

/// Joins where exactly two uses have equal UVs; returns those that are alone with theirs.
std::vector<EdgeUse> join_equal_uvs(const Atlas& atlas, std::vector<EdgeUse> group, bool share_vertices, EdgeJoins& joins) {
  std::sort(group.begin(), group.end(), [&](const EdgeUse& a, const EdgeUse& b) {
    const auto ka = a.uv_key(atlas), kb = b.uv_key(atlas);
    return ka != kb ? ka < kb : a.sort_key() < b.sort_key();
  });
  std::vector<EdgeUse> single;
  const auto same = [&](const EdgeUse& a, const EdgeUse& b) { return a.uv_key(atlas) == b.uv_key(atlas); };
  for_each_range(group, same, [&](EdgeUses range) {
    if (range.size() == 1) single.push_back(range[0]);
    if (range.size() != 2) return;
    const EdgeUse &a = range[0], &b = range[1];
    if (joins.corner_faces[a.corner] == joins.corner_faces[b.corner]) return;
    if (!share_vertices && back_to_back(atlas, joins, a, b)) return;
    joins.partners[a.corner] = b.corner;
    joins.partners[b.corner] = a.corner;
  });
  return single;
}

/// Joins the uses of one edge in space: first those that share vertices, then what is left.
void join_edge(const Atlas& atlas, EdgeUses uses, EdgeJoins& joins) {
  if (uses.size() < 2) return;
  std::vector<EdgeUse> rest;
  const auto same_vertices = [](const EdgeUse& a, const EdgeUse& b) { return a.vertex_key() == b.vertex_key(); };
  for_each_range(uses, same_vertices, [&](EdgeUses range) {
    const std::vector<EdgeUse> single = join_equal_uvs(atlas, {range.begin(), range.end()}, true, joins);
    rest.insert(rest.end(), single.begin(), single.end());
  });
  join_equal_uvs(atlas, std::move(rest), false, joins);
}

/// Winds the faces of each chart alike, and undoes joins that would make it one-sided.
void orient_faces(const Atlas& atlas, EdgeUses uses, EdgeJoins& joins) {
  std::vector<bool> runs_up(atlas.corner_count(), false);  // the corner's edge runs from the low place to the high one
  for (const EdgeUse& use : uses) runs_up[use.corner] = use.runs_up();
  std::vector<bool> visited(atlas.face_count(), false);
  std::vector<int> queue;
  const auto cross_edge = [&](int corner) {
    const int partner = joins.partners[corner];
    if (partner < 0) return;
    const int other = joins.corner_faces[partner];
    // Two faces are wound alike where they run along their common edge in opposite senses.
    const bool wound_alike = runs_up[corner] != runs_up[partner];
    const bool turned = wound_alike == joins.turned_faces[joins.corner_faces[corner]];
    if (!visited[other]) {
      visited[other] = true;
      joins.turned_faces[other] = turned;
      queue.push_back(other);
    } else if (joins.turned_faces[other] != turned) {
      joins.partners[corner] = joins.partners[partner] = -1;
    }
  };
  for (int seed = 0; seed < atlas.face_count(); ++seed) {
    if (visited[seed]) continue;
    visited[seed] = true;
    queue.assign(1, seed);
    for (std::size_t at = 0; at < queue.size(); ++at) {
      for (int c = atlas.face_offsets[queue[at]]; c < atlas.face_offsets[queue[at] + 1]; ++c) cross_edge(c);
    }
  }
}

void count_seam(const Atlas& atlas, EdgeUses uses, EdgeJoins& joins) {
  const auto joined = [&](const EdgeUse& use) { return joins.partners[use.corner] >= 0; };
  if (uses.size() < 2 || std::all_of(uses.begin(), uses.end(), joined)) return;
  ++joins.seam_edges;
  joins.seam_length += (atlas.positions[uses[0].low_vertex] - atlas.positions[uses[0].high_vertex]).norm();
}

}  // namespace

double doubled_uv_area(const Atlas& atlas, int face) {
  const int first = atlas.face_offsets[face];
  double sum = 0;
  for (int c = first + 2; c < atlas.face_offsets[face + 1]; ++c) {
    sum += doubled_area(atlas.corner_uvs[first], atlas.corner_uvs[c - 1], atlas.corner_uvs[c]);
  }
  return sum;
}

EdgeJoins join_edges(const Atlas& atlas) {
  EdgeJoins joins;
  joins.corner_faces = faces_of_corners(atlas);
  joins.partners.assign(atlas.corner_count(), -1);
  joins.turned_faces.assign(atlas.face_count(), false);
  const std::vector<EdgeUse> uses = collect_uses(atlas, joins);
  for_each_edge(uses, [&](EdgeUses edge) { join_edge(atlas, edge, joins); });
  orient_faces(atlas, uses, joins);
  for_each_edge(uses, [&](EdgeUses edge) { count_seam(atlas, edge, joins); });
  return joins;
}

}  // namespace atlas_refine
