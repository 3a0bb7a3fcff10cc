// Stretch by stretch along the outlines.
#include "pack/near_vertices.h"

#include <algorithm>
#include <tuple>

namespace atlas_refine {
namespace {

/// A farther edge in much the same direction is left to the next, shorter step. Where steps only shift these are the last, and a
/// few are taken.
bool is_new(const Vec2& normal, const std::vector<Vec2>& normals, bool few) {
  constexpr double kAlike = 0.9, kEqual = 1 - 1e-9;
  constexpr std::size_t kFew = 3;
  if (few && normals.size() >= kFew) return false;
  const double most = few ? kEqual : kAlike;
  return std::none_of(normals.begin(), normals.end(), [&](const Vec2& n) { return n.dot(normal) > most; });
}

/// Of one stretch, those that count; `near` is empty after it.
void add_new(const Scene& scene, bool few, std::vector<NearVertex>& near, std::vector<NearVertex>& out) {
  const auto chart_of = [&](const NearVertex& v) { return scene.edges[v.edge].chart; };
  std::sort(near.begin(), near.end(), [&](const NearVertex& p, const NearVertex& q) {
    const int a = chart_of(p), b = chart_of(q);
    return std::tie(a, p.distance, p.vertex, p.edge) < std::tie(b, q.distance, q.vertex, q.edge);
  });
  std::vector<Vec2> normals;
  int faced = -1;
  for (const NearVertex& vertex : near) {
    if (chart_of(vertex) != faced) normals.clear();
    faced = chart_of(vertex);
    const Vec2 normal = vertex.normal(scene);
    if (!is_new(normal, normals, few)) continue;
    normals.push_back(normal);
    out.push_back(vertex);
  }
  near.clear();
}

}  // namespace

std::vector<NearVertex> near_vertices(const Scene& scene, const BoxTree& tree, double reach, double stretch, bool few,
                                      const std::function<void()>& poll) {
  std::vector<NearVertex> out, near;
  double length = 0;  // of the present stretch
  for (int k = 0; k < static_cast<int>(scene.edges.size()); ++k) {
    const PlacedEdge& edge = scene.edges[k];
    if (k == scene.first_edges[edge.chart]) poll();
    tree.visit_within({edge.a, edge.a}, reach, edge.chart, [&](int other) {
      const Vec2 foot = nearest_point(edge.a, scene.edges[other]);
      const double distance = (edge.a - foot).norm();
      if (distance > 0 && distance <= reach) near.push_back({k, other, foot, distance});
      return true;
    });
    length += (edge.b - edge.a).norm();
    const bool last = k + 1 == scene.first_edges[edge.chart + 1] || scene.edges[k + 1].a != edge.b;  // of its loop
    if (!last && length <= stretch) continue;
    add_new(scene, few, near, out);
    length = 0;
  }
  return out;
}

}  // namespace atlas_refine
