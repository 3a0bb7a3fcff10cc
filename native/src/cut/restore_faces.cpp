// The reverse of dividing an edge, one vertex at a time.
#include "cut/restore_faces.h"

#include <algorithm>
#include <cmath>

#include "geometry/guards.h"
#include "geometry/predicates.h"
#include "solve/symmetric_dirichlet.h"

namespace atlas_refine {
namespace {

constexpr double kMostDistorted = 3;  // energy up to which a restored triangle is accepted

/// True where v lies between a and b on the chart.
bool lies_between(const Support& v, const Support& a, const Support& b) {
  for (int k = 0; k < 3; ++k) {
    if (v.vertices[k] < 0) continue;
    // The share of b, from a vertex of the chart where a and b differ.
    const auto weight = [&](const Support& s) {
      for (int j = 0; j < 3; ++j) {
        if (s.vertices[j] == v.vertices[k]) return s.weights[j];
      }
      return 0.0;
    };
    const double from = weight(a), to = weight(b);
    if (from == to) continue;
    const double along = (weight(v) - from) / (to - from);
    if (!(along > 0 && along < 1)) return false;
    const Support there = between(a, b, along);
    constexpr double kSame = 1e-9;
    for (int j = 0; j < 3; ++j) {
      if (there.vertices[j] != v.vertices[j] || std::abs(there.weights[j] - v.weights[j]) > kSame) return false;
    }
    return true;
  }
  return false;
}

/// Takes vertices out of the piece; the new number of each old one, -1 where it went.
template <class Kept>
std::vector<int> keep_vertices(Piece& piece, Kept&& kept) {
  std::vector<int> number(piece.mesh.vertex_count(), -1);
  int count = 0;
  for (int v = 0; v < piece.mesh.vertex_count(); ++v) {
    if (!kept(v)) continue;
    number[v] = count;
    piece.mesh.uvs[count] = piece.mesh.uvs[v];
    piece.vertices[count] = piece.vertices[v];
    piece.points[count] = piece.points[v];
    piece.supports[count++] = piece.supports[v];
  }
  piece.mesh.uvs.resize(count);
  piece.vertices.resize(count);
  piece.points.resize(count);
  piece.supports.resize(count);
  for (auto& loop : piece.mesh.boundary_loops) {
    for (int& v : loop) v = number[v];
  }
  return number;
}

/// Takes out the triangles that are gone (vertices -1) and numbers the vertices of the others anew.
void keep_triangles(Piece& piece, const std::vector<int>& number, std::vector<RestTriangle>& shapes) {
  Chart& mesh = piece.mesh;
  int count = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.triangles[t][0] < 0) continue;
    for (int k = 0; k < 3; ++k) mesh.triangles[count][k] = number[mesh.triangles[t][k]];
    shapes[count] = shapes[t];
    mesh.triangle_faces[count] = mesh.triangle_faces[t];
    piece.sources[count++] = piece.sources[t];
  }
  mesh.triangles.resize(count);
  shapes.resize(count);
  mesh.triangle_faces.resize(count);
  piece.sources.resize(count);
  mesh.surface = Surface(std::move(shapes));
}

class Restorer {
 public:
  Restorer(Piece& piece, const Chart& source, double scale)
      : piece_(piece),
        source_(source),
        scale_(scale),
        shapes_(piece.mesh.surface.begin(), piece.mesh.surface.end()),
        around_(piece.mesh.vertex_count()) {
    for (int t = 0; t < static_cast<int>(piece.mesh.triangles.size()); ++t) {
      for (int v : piece.mesh.triangles[t]) around_[v].push_back(t);
    }
  }

  int run(const std::vector<bool>& border_points) {
    std::vector<char> outer(piece_.mesh.vertex_count(), 0);
    for (const auto& loop : piece_.mesh.boundary_loops) {
      for (int v : loop) outer[v] = 1;
    }
    int removed = 0;
    // The last vertex made is the first to go.
    for (int v = piece_.mesh.vertex_count() - 1; v >= 0; --v) {
      const int point = piece_.points[v];
      const bool border = outer[v] || (point >= 0 && !border_points.empty() && border_points[point]);
      if (point >= 0 && !border && remove(v)) ++removed;
    }
    if (removed > 0) {
      const auto numbers = keep_vertices(piece_, [&](int v) { return !around_[v].empty(); });
      keep_triangles(piece_, numbers, shapes_);
    }
    return removed;
  }

 private:
  /// The four triangles around the vertex as two, where it divides an edge.
  bool remove(int v) {
    if (around_[v].size() != 4) return false;
    std::array<int, 4> ring{}, fan{};
    int next = -1;
    for (int k = 0; k < 4; ++k) {
      const auto found = std::find_if(around_[v].begin(), around_[v].end(), [&](int t) { return k == 0 || after(t, v) == next; });
      if (found == around_[v].end()) return false;
      fan[k] = *found;
      ring[k] = after(*found, v);
      next = after(*found, ring[k]);
    }
    for (int k = 0; k < 2; ++k) {
      if (!lies_between(piece_.supports[v], piece_.supports[ring[k]], piece_.supports[ring[(k + 2) % 4]])) continue;
      // ring[k], [k + 1], [k + 2] on one side of the edge, [k + 2], [k + 3], [k] on the other.
      return join(v, ring[k], ring[k + 1], ring[k + 2], {fan[k], fan[k + 1]}, ring[(k + 3) % 4], {fan[k + 2], fan[(k + 3) % 4]});
    }
    return false;
  }

  bool join(int v, int a, int c, int b, std::array<int, 2> one, int d, std::array<int, 2> other) {
    if (piece_.sources[one[0]] != piece_.sources[one[1]] || piece_.sources[other[0]] != piece_.sources[other[1]]) return false;
    const Triangle first = {a, c, b}, second = {b, d, a};
    RestTriangle first_rest, second_rest;
    if (!good(first, one, first_rest) || !good(second, other, second_rest)) return false;
    set(one[0], first, first_rest);
    set(other[0], second, second_rest);
    for (int gone : {one[1], other[1]}) {
      for (int w : piece_.mesh.triangles[gone]) std::erase(around_[w], gone);
      piece_.mesh.triangles[gone] = {-1, -1, -1};
    }
    around_[v].clear();
    return true;
  }

  bool good(const Triangle& t, std::array<int, 2> parts, RestTriangle& rest) const {
    const auto& uvs = piece_.mesh.uvs;
    if (orientation(uvs[t[0]], uvs[t[1]], uvs[t[2]]) <= 0) return false;
    rest = rest_of_part(source_, piece_.sources[parts[0]], {piece_.supports[t[0]], piece_.supports[t[1]], piece_.supports[t[2]]});
    return symmetric_dirichlet(scale_ * jacobian(rest.inverse_edges, uvs[t[0]], uvs[t[1]], uvs[t[2]])) < kMostDistorted;
  }

  int after(int t, int v) const {
    const Triangle& triangle = piece_.mesh.triangles[t];
    for (int k = 0; k < 3; ++k) {
      if (triangle[k] == v) return triangle[(k + 1) % 3];
    }
    return -1;
  }
  void set(int t, const Triangle& triangle, const RestTriangle& rest) {
    for (int w : piece_.mesh.triangles[t]) std::erase(around_[w], t);
    piece_.mesh.triangles[t] = triangle;
    shapes_[t] = rest;
    for (int w : triangle) around_[w].push_back(t);
  }

  Piece& piece_;
  const Chart& source_;
  double scale_;
  std::vector<RestTriangle> shapes_;
  std::vector<std::vector<int>> around_;
};

}  // namespace

int restore_faces(Piece& piece, const Chart& source, double scale, const std::vector<bool>& border_points) {
  const int removed = Restorer(piece, source, scale).run(border_points);
  piece.mesh.guards = guards_of_whole_faces(source, piece.mesh.triangles, piece.sources, piece.supports);
  drop_broken_guards(piece.mesh);
  return removed;
}

std::vector<bool> points_on_borders(const CutAtlas& atlas) {
  std::vector<bool> out(atlas.points.size(), false);
  for (const Piece& piece : atlas.pieces) {
    for (const auto& loop : piece.mesh.boundary_loops) {
      for (int v : loop) {
        if (piece.points[v] >= 0) out[piece.points[v]] = true;
      }
    }
  }
  return out;
}

}  // namespace atlas_refine
