// Polygons told by their outlines: the sides that only one of their triangles has.
#include "input/leaders_triangles.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "input/surfaces.h"

namespace atlas_refine {
namespace {

using Side = std::pair<int, int>;

/// The triangles of each face, one after the other.
struct FaceRange {
  std::size_t begin, end;
};

std::vector<FaceRange> faces_of(const Chart& chart) {
  std::vector<FaceRange> out;
  for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
    if (t == 0 || chart.triangle_faces[t] != chart.triangle_faces[t - 1]) out.push_back({t, t});
    out.back().end = t + 1;
  }
  return out;
}

/// The sides of a face along its triangles, vertices by their names.
std::vector<Side> outline(const Chart& chart, const FaceRange& face, const std::vector<int>& name) {
  std::vector<Side> sides, out;
  for (std::size_t t = face.begin; t < face.end; ++t) {
    for (int k = 0; k < 3; ++k) sides.emplace_back(name[chart.triangles[t][k]], name[chart.triangles[t][(k + 1) % 3]]);
  }
  for (const auto& [a, b] : sides) {
    if (std::find(sides.begin(), sides.end(), Side(b, a)) == sides.end()) out.emplace_back(a, b);
  }
  return out;
}

/// The same for both senses of winding, with the number of triangles.
std::vector<Side> key(const Chart& chart, const FaceRange& face, const std::vector<int>& name) {
  std::vector<Side> out = outline(chart, face, name);
  for (auto& [a, b] : out) {
    if (a > b) std::swap(a, b);
  }
  std::sort(out.begin(), out.end());
  out.emplace_back(-1, static_cast<int>(face.end - face.begin));
  return out;
}

std::vector<int> own_names(const Chart& chart) {
  std::vector<int> out(chart.vertex_count());
  std::iota(out.begin(), out.end(), 0);
  return out;
}

std::vector<std::vector<Side>> keys(const Chart& chart, const std::vector<int>& name) {
  std::vector<std::vector<Side>> out;
  for (const FaceRange& face : faces_of(chart)) out.push_back(key(chart, face, name));
  std::sort(out.begin(), out.end());
  return out;
}

/// The leader's triangles of one face on the follower's vertices, wound as the follower's are.
std::vector<Triangle> taken_over(const Chart& chart, const FaceRange& face, const Chart& leader, const FaceRange& leaders,
                                 const std::vector<int>& own_vertex) {
  const std::vector<Side> sides = outline(chart, face, own_names(chart)), onto = outline(leader, leaders, own_vertex);
  const bool alike = onto.empty() || std::find(sides.begin(), sides.end(), onto.front()) != sides.end();
  std::vector<Triangle> out;
  for (std::size_t t = leaders.begin; t < leaders.end; ++t) {
    const Triangle& v = leader.triangles[t];
    Triangle& own = out.emplace_back(Triangle{own_vertex[v[0]], own_vertex[v[1]], own_vertex[v[2]]});
    if (!alike) std::swap(own[1], own[2]);
  }
  return out;
}

std::vector<Vec3> positions_of(const Atlas& atlas, const ChartSet& set, int chart) {
  std::vector<Vec3> out(set.charts[chart].vertex_count());
  for (std::size_t c = 0; c < set.corners.size(); ++c) {
    if (set.corners[c].chart == chart) out[set.corners[c].vertex] = atlas.positions[atlas.corner_vertices[c]];
  }
  return out;
}

}  // namespace

bool same_polygons(const Chart& chart, const Chart& onto, const std::vector<int>& vertices) {
  return chart.triangles.size() == onto.triangles.size() && keys(chart, vertices) == keys(onto, own_names(onto));
}

void divide_as_leader(const Atlas& atlas, const Follower& follower, ChartSet& set) {
  const Chart& leader = set.charts[follower.leader];
  std::vector<Chart> divided{set.charts[follower.chart]};
  Chart& own = divided.front();
  std::vector<int> own_vertex(leader.vertex_count());
  for (int v = 0; v < own.vertex_count(); ++v) own_vertex[follower.vertices[v]] = v;
  std::multimap<std::vector<Side>, FaceRange> leaders;
  for (const FaceRange& face : faces_of(leader)) leaders.emplace(key(leader, face, own_vertex), face);
  const std::vector<int> names = own_names(own);
  bool changed = false;
  for (const FaceRange& face : faces_of(own)) {
    const auto found = leaders.find(key(own, face, names));
    for (std::size_t t = face.begin; const Triangle& triangle : taken_over(own, face, leader, found->second, own_vertex)) {
      changed = changed || own.triangles[t] != triangle;
      own.triangles[t++] = triangle;
    }
    leaders.erase(found);
  }
  if (!changed) return;
  set_surfaces(divided, {positions_of(atlas, set, follower.chart)});
  set.charts[follower.chart] = std::move(own);
}

}  // namespace atlas_refine
