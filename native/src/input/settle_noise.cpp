// Vertex by vertex, neighbours as they have been settled before.
#include "input/settle_noise.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "geometry/predicates.h"
#include "input/uv_noise.h"

namespace atlas_refine {

namespace {

constexpr std::size_t kTried = 16;  // corners of one vertex whose values are tried, vertices at one point that are compared

using Points = std::vector<std::vector<int>>;
using Marks = std::vector<std::vector<bool>>;  // of every vertex of every chart

struct VertexUvs {
  const Atlas& atlas;
  const std::vector<CornerRef>& corners;
  std::vector<std::vector<Vec2>>& uvs;

  Vec2& value(int corner) const { return uvs[corners[corner].chart][corners[corner].vertex]; }
  const Vec2& given(int corner) const { return atlas.corner_uvs[corner]; }

  /// The corner of the same face so many steps on.
  int around(int corner, int steps) const {
    const auto end = std::upper_bound(atlas.face_offsets.begin(), atlas.face_offsets.end(), corner);
    const int begin = *(end - 1), size = *end - begin;
    return begin + (corner - begin + steps + size) % size;
  }

  /// How many of the corners at a vertex and beside it turn otherwise than they do with the UVs that were given.
  int turned(const std::vector<int>& own) const {
    int count = 0;
    for (int c : own) {
      const int reach = around(c, 3) == c ? 0 : 1;  // a triangle turns at all of its corners alike
      for (int middle = -reach; middle <= reach; ++middle) {
        const int before = around(c, middle - 1), at = around(c, middle), after = around(c, middle + 1);
        const int sign = orientation(given(before), given(at), given(after));
        if (sign != 0 && orientation(value(before), value(at), value(after)) != sign) ++count;
      }
    }
    return count;
  }

  double shortest_edge(const std::vector<int>& own) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (int c : own) {
      for (const int step : {-1, 1}) shortest = std::min(shortest, (given(around(c, step)) - given(c)).norm());
    }
    return shortest;
  }
};

Marks no_marks(const VertexUvs& in) {
  Marks out;
  for (const auto& of_chart : in.uvs) out.emplace_back(of_chart.size(), false);
  return out;
}

Marks noisy_vertices(const VertexUvs& in) {
  Marks out = no_marks(in);
  for (int c = 0; c < in.atlas.corner_count(); ++c) {
    if (in.value(c) != in.given(c)) out[in.corners[c].chart][in.corners[c].vertex] = true;
  }
  return out;
}

/// Vertices that are one point in space with another of their chart.
Marks vertices_at_shared_points(const VertexUvs& in, const Points& points) {
  Marks out = no_marks(in);
  std::vector<int> first(in.atlas.positions.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (std::size_t v = points[k].size(); v-- > 0;) first[points[k][v]] = static_cast<int>(v);
    for (std::size_t v = 0; v < points[k].size(); ++v) {
      const int other = first[points[k][v]];
      if (other != static_cast<int>(v)) out[k][v] = out[k][other] = true;
    }
  }
  return out;
}

/// Calls body with the corners of every marked vertex.
template <class Body>
void for_each_vertex(const VertexUvs& in, const Marks& marks, Body body) {
  const auto key = [&](int c) { return std::tie(in.corners[c].chart, in.corners[c].vertex); };
  std::vector<int> corners;
  for (int c = 0; c < in.atlas.corner_count(); ++c) {
    if (marks[in.corners[c].chart][in.corners[c].vertex]) corners.push_back(c);
  }
  std::stable_sort(corners.begin(), corners.end(), [&](int a, int b) { return key(a) < key(b); });
  for (std::size_t begin = 0, end = 0; begin < corners.size(); begin = end) {
    while (end < corners.size() && key(corners[begin]) == key(corners[end])) ++end;
    body(std::vector<int>(corners.begin() + begin, corners.begin() + end));
  }
}

/// The value of the first corner where it turns no face, else the one that turns the fewest.
void settle_vertex(const VertexUvs& in, const std::vector<int>& own) {
  std::vector<Vec2> tried;
  Vec2 mean = Vec2::Zero();
  for (int c : own) {
    mean += in.given(c) / static_cast<double>(own.size());
    if (tried.size() < kTried) tried.push_back(in.given(c));
  }
  tried.push_back(mean);
  Vec2& vertex = in.value(own[0]);
  Vec2 best = tried[0];
  int fewest = in.turned(own);
  for (std::size_t k = 1; k < tried.size() && fewest > 0; ++k) {
    vertex = tried[k];
    const int count = in.turned(own);
    if (count >= fewest) continue;
    fewest = count;
    best = tried[k];
  }
  vertex = best;
}

void move_onto(const VertexUvs& in, const std::vector<int>& own, const Vec2& where) {
  const int before = in.turned(own);
  Vec2& vertex = in.value(own[0]);
  const Vec2 was = std::exchange(vertex, where);
  if (in.turned(own) > before) vertex = was;
}

void settle_pinches(const VertexUvs& in, const Points& points) {
  const double noise = uv_noise(in.atlas);
  std::map<std::pair<int, int>, std::vector<std::vector<int>>> settled;  // by chart and point: vertices, as their corners
  for_each_vertex(in, vertices_at_shared_points(in, points), [&](const std::vector<int>& own) {
    const CornerRef& vertex = in.corners[own[0]];
    auto& others = settled[{vertex.chart, points[vertex.chart][vertex.vertex]}];
    for (const std::vector<int>& other : others) {
      const double apart = (in.value(own[0]) - in.value(other[0])).norm();
      const double edge = std::min(in.shortest_edge(own), in.shortest_edge(other));
      if (apart == 0 || apart > std::min(noise, kNoiseOfEdge * edge)) continue;
      move_onto(in, own, in.value(other[0]));
      break;
    }
    if (others.size() < kTried) others.push_back(own);
  });
}

}  // namespace

void settle_noise(const Atlas& atlas, const std::vector<CornerRef>& corners, const std::vector<std::vector<int>>& points,
                  std::vector<std::vector<Vec2>>& uvs) {
  const VertexUvs vertices{atlas, corners, uvs};
  for_each_vertex(vertices, noisy_vertices(vertices), [&](const std::vector<int>& own) { settle_vertex(vertices, own); });
  settle_pinches(vertices, points);
}

}  // namespace atlas_refine
