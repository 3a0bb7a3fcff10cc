// Around the fan of each suspicious corner until its own face is met again.
#include "input/keep_corners_apart.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace atlas_refine {

namespace {

/// An edge, named by its corner, that is crossed from one face of a fan to the next.
struct Crossing {
  int edge;
  bool one_vertex;  ///< both faces have the fan's vertex by the same number
  bool has_length;

  auto cost() const { return std::tuple(one_vertex, has_length); }
};

class Fans {
 public:
  Fans(const Atlas& atlas, EdgeJoins& joins) : atlas_(atlas), joins_(joins) {}

  /// Undoes joins until no fan has both corners of a face.
  void part(int corner, int other) {
    for (const bool outgoing : {false, true}) {
      const std::vector<Crossing> way = way_to(corner, outgoing, other);
      if (way.empty()) continue;
      const auto least =
          std::min_element(way.begin(), way.end(), [](const Crossing& a, const Crossing& b) { return a.cost() < b.cost(); });
      undo(least->edge);
    }
  }

  /// Undoes the join of an edge without length that has one vertex of the mesh at one end and two at the other.
  void part_run_out(int edge) {
    const int partner = joins_.partners[edge];
    if (partner < 0) return;
    const auto vertices = [&](int corner) {
      return std::minmax(atlas_.corner_vertices[corner], atlas_.corner_vertices[joins_.next_corner(atlas_, corner)]);
    };
    const std::pair<int, int> own = vertices(edge), other = vertices(partner);
    const auto has = [](const std::pair<int, int>& ends, int v) { return ends.first == v || ends.second == v; };
    if (has(own, other.first) != has(own, other.second)) undo(edge);
  }

 private:
  void undo(int edge) {
    joins_.partners[joins_.partners[edge]] = -1;
    joins_.partners[edge] = -1;
  }

  int place(int corner) const { return joins_.places[atlas_.corner_vertices[corner]]; }

  int previous(int corner) const {
    const int face = joins_.corner_faces[corner];
    return corner > atlas_.face_offsets[face] ? corner - 1 : atlas_.face_offsets[face + 1] - 1;
  }

  /// What is crossed around the vertex of a corner, beginning with the edge that leaves it or the one that comes to it, until
  /// the fan reaches the other corner; nothing where it does not.
  std::vector<Crossing> way_to(int corner, bool outgoing, int other) const {
    std::vector<Crossing> way;
    int at = corner;
    while (true) {
      const int edge = outgoing ? at : previous(at), partner = joins_.partners[edge];
      if (partner < 0) return {};
      const bool same = joins_.turned_faces[joins_.corner_faces[edge]] == joins_.turned_faces[joins_.corner_faces[partner]];
      const bool leaves = outgoing != same;  // at its other side the edge leaves the vertex
      const int next = leaves ? partner : joins_.next_corner(atlas_, partner);
      way.push_back({edge, atlas_.corner_vertices[at] == atlas_.corner_vertices[next],
                     place(edge) != place(joins_.next_corner(atlas_, edge))});
      if (next == other) return way;
      if (next == corner) return {};
      at = next;
      outgoing = !leaves;
    }
  }

  const Atlas& atlas_;
  EdgeJoins& joins_;
};

}  // namespace

void keep_corners_apart(const Atlas& atlas, EdgeJoins& joins) {
  const auto place = [&](int corner) { return joins.places[atlas.corner_vertices[corner]]; };
  Fans fans(atlas, joins);
  for (int f = 0; f < atlas.face_count(); ++f) {
    const int first = atlas.face_offsets[f], end = atlas.face_offsets[f + 1];
    for (int c = first; c < end; ++c) {
      const int next = joins.next_corner(atlas, c);
      if (place(c) == place(next)) {
        fans.part_run_out(c);
        fans.part(c, next);
      }
      if (end - first == 4 && c + 2 < end && place(c) == place(c + 2)) fans.part(c, c + 2);
    }
  }
}

}  // namespace atlas_refine
