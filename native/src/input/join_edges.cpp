// Which edges of the faces are joined in the UV map, and which are seams.
#include "input/join_edges.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "geometry/plane.h"

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
};

/// One number for each distinct position: the smallest index of the vertices that lie there.
std::vector<int> places(const std::vector<Vec3>& positions) {
  const auto key = [&](int v) { return std::tie(positions[v].x(), positions[v].y(), positions[v].z()); };
  std::vector<int> order(positions.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  std::vector<int> place(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    place[order[i]] = same ? place[order[i - 1]] : order[i];
  }
  return place;
}

std::vector<int> faces_of_corners(const Atlas& atlas) {
  std::vector<int> faces(atlas.corner_count());
  for (int f = 0; f < atlas.face_count(); ++f) {
    std::fill(faces.begin() + atlas.face_offsets[f], faces.begin() + atlas.face_offsets[f + 1], f);
  }
  return faces;
}

class Joiner {
 public:
  explicit Joiner(const Atlas& atlas) : atlas_(atlas) {
    joins_.corner_faces = faces_of_corners(atlas);
    joins_.partners.assign(atlas.corner_count(), -1);
    joins_.turned_faces.assign(atlas.face_count(), false);
    collect_uses();
  }

  EdgeJoins run() {
    for_each_edge([this](int begin, int end) { join_edge(begin, end); });
    orient_faces();
    for_each_edge([this](int begin, int end) { count_seam(begin, end); });
    return std::move(joins_);
  }

 private:
  void collect_uses() {
    const std::vector<int> place = places(atlas_.positions);
    uses_.reserve(atlas_.corner_count());
    for (int c = 0; c < atlas_.corner_count(); ++c) {
      int low = c, high = joins_.next_corner(atlas_, c);
      const auto vertex = [&](int corner) { return atlas_.corner_vertices[corner]; };
      if (place[vertex(low)] == place[vertex(high)]) continue;  // an edge without length has no other side
      if (place[vertex(low)] > place[vertex(high)]) std::swap(low, high);
      uses_.push_back({place[vertex(low)], place[vertex(high)], vertex(low), vertex(high), c, low, high});
    }
    std::sort(uses_.begin(), uses_.end(), [](const EdgeUse& a, const EdgeUse& b) { return a.sort_key() < b.sort_key(); });
  }

  /// Calls body(begin, end) for every range of uses of one edge in space.
  template <class Body>
  void for_each_edge(Body body) const {
    const int count = static_cast<int>(uses_.size());
    for (int begin = 0, end = 0; begin < count; begin = end) {
      while (end < count && uses_[end].place_key() == uses_[begin].place_key()) ++end;
      body(begin, end);
    }
  }

  void join_edge(int begin, int end) {
    if (end - begin < 2) return;
    std::vector<int> rest;
    for (int from = begin, to = begin; from < end; from = to) {
      std::vector<int> same_vertices;
      for (; to < end && uses_[to].vertex_key() == uses_[from].vertex_key(); ++to) same_vertices.push_back(to);
      const std::vector<int> single = join_equal_uvs(std::move(same_vertices), true);
      rest.insert(rest.end(), single.begin(), single.end());
    }
    join_equal_uvs(std::move(rest), false);
  }

  auto uv_key(int use) const {
    const Vec2& low = atlas_.corner_uvs[uses_[use].low_corner];
    const Vec2& high = atlas_.corner_uvs[uses_[use].high_corner];
    return std::tie(low.x(), low.y(), high.x(), high.y());
  }

  /// Joins where exactly two uses have equal UVs; returns those that are alone with theirs.
  std::vector<int> join_equal_uvs(std::vector<int> group, bool share_vertices) {
    std::sort(group.begin(), group.end(), [this](int a, int b) {
      const auto ka = uv_key(a), kb = uv_key(b);
      return ka != kb ? ka < kb : a < b;
    });
    std::vector<int> single;
    for (std::size_t begin = 0, end = 0; begin < group.size(); begin = end) {
      while (end < group.size() && uv_key(group[end]) == uv_key(group[begin])) ++end;
      if (end - begin == 1) single.push_back(group[begin]);
      if (end - begin != 2) continue;
      const EdgeUse &a = uses_[group[begin]], &b = uses_[group[begin + 1]];
      if (joins_.corner_faces[a.corner] == joins_.corner_faces[b.corner]) continue;
      if (!share_vertices && back_to_back(a, b)) continue;
      joins_.partners[a.corner] = b.corner;
      joins_.partners[b.corner] = a.corner;
    }
    return single;
  }

  /// Faces on the same side of their common UV edge. Where they do not even share vertices they are the two sides of a sheet.
  bool back_to_back(const EdgeUse& a, const EdgeUse& b) const {
    const double area_a = doubled_uv_area(atlas_, joins_.corner_faces[a.corner]);
    const double area_b = doubled_uv_area(atlas_, joins_.corner_faces[b.corner]);
    return a.runs_up() == b.runs_up() ? area_a * area_b > 0 : area_a * area_b < 0;
  }

  /// Two faces are wound alike where they run along their common edge in opposite senses.
  bool wound_alike(int a, int b) const { return runs_up_[a] != runs_up_[b]; }

  void orient_faces() {
    runs_up_.assign(atlas_.corner_count(), false);
    for (const EdgeUse& use : uses_) runs_up_[use.corner] = use.runs_up();
    std::vector<bool> visited(atlas_.face_count(), false);
    std::vector<int> queue;
    for (int seed = 0; seed < atlas_.face_count(); ++seed) {
      if (visited[seed]) continue;
      visited[seed] = true;
      queue.assign(1, seed);
      for (std::size_t at = 0; at < queue.size(); ++at) visit_face(queue[at], visited, queue);
    }
  }

  void visit_face(int face, std::vector<bool>& visited, std::vector<int>& queue) {
    for (int c = atlas_.face_offsets[face]; c < atlas_.face_offsets[face + 1]; ++c) {
      const int partner = joins_.partners[c];
      if (partner < 0) continue;
      const int other = joins_.corner_faces[partner];
      const bool turned = wound_alike(c, partner) == joins_.turned_faces[face];
      if (!visited[other]) {
        visited[other] = true;
        joins_.turned_faces[other] = turned;
        queue.push_back(other);
      } else if (joins_.turned_faces[other] != turned) {
        joins_.partners[c] = joins_.partners[partner] = -1;
      }
    }
  }

  void count_seam(int begin, int end) {
    if (end - begin < 2) return;
    const bool joined = std::all_of(uses_.begin() + begin, uses_.begin() + end,
                                    [this](const EdgeUse& use) { return joins_.partners[use.corner] >= 0; });
    if (joined) return;
    ++joins_.seam_edges;
    joins_.seam_length += (atlas_.positions[uses_[begin].low_vertex] - atlas_.positions[uses_[begin].high_vertex]).norm();
  }

  const Atlas& atlas_;
  EdgeJoins joins_;
  std::vector<EdgeUse> uses_;
  std::vector<bool> runs_up_;  ///< one per corner: its edge runs from the low place to the high one
};

}  // namespace

double doubled_uv_area(const Atlas& atlas, int face) {
  const int first = atlas.face_offsets[face];
  double sum = 0;
  for (int c = first + 2; c < atlas.face_offsets[face + 1]; ++c) {
    sum += doubled_area(atlas.corner_uvs[first], atlas.corner_uvs[c - 1], atlas.corner_uvs[c]);
  }
  return sum;
}

EdgeJoins join_edges(const Atlas& atlas) { return Joiner(atlas).run(); }

}  // namespace atlas_refine
