// Choosing trails and driving them.
#include "layout/motorcycles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "support/disjoint_sets.h"

namespace atlas_refine {
namespace {

constexpr double kSpareTrail = 0.06;  // how often a random corner drives a trail that it does not need

/// Every corner's rule: of two consecutive trails at least one is driven.
void choose(const QuadMesh& quads, int corner, MotorcycleGraph& graph, Rng& rng) {
  const std::vector<int>& trails = quads.corners[corner];
  for (int t : trails) graph.driven[t] = 0;
  if (quads.optional_corner[corner]) {
    graph.driven[trails[0]] = rng.uniform() < 0.5;
    return;
  }
  // Two trails: the first or the second. Three: the middle one, or both others.
  for (std::size_t k = rng.below(2); k < trails.size(); k += 2) graph.driven[trails[k]] = 1;
  for (int t : trails) {
    if (rng.uniform() < kSpareTrail) graph.driven[t] = 1;
  }
}

}  // namespace

MotorcycleGraph shortest_graph(const QuadMesh& quads) {
  MotorcycleGraph graph{std::vector<char>(quads.trails.size(), 0), {}};
  for (const auto& trail : quads.trails) graph.rank.push_back(trail.length);
  for (std::size_t c = 0; c < quads.corners.size(); ++c) {
    const std::vector<int>& trails = quads.corners[c];
    if (quads.optional_corner[c]) continue;
    double sums[2] = {0, 0};
    for (std::size_t k = 0; k < trails.size(); ++k) sums[k % 2] += quads.trails[trails[k]].length;
    const std::size_t first = trails.size() > 1 && sums[1] < sums[0] ? 1 : 0;
    for (std::size_t k = first; k < trails.size(); k += 2) graph.driven[trails[k]] = 1;
  }
  return graph;
}

MotorcycleGraph graph_across(const QuadMesh& quads) {
  MotorcycleGraph graph = shortest_graph(quads);
  const double side = std::sqrt(std::accumulate(quads.face_areas.begin(), quads.face_areas.end(), 0.0));
  for (std::size_t c = 0; c < quads.corners.size(); ++c) {
    const int trail = quads.corners[c].front();
    if (quads.optional_corner[c] && quads.trails[trail].length < side) graph.driven[trail] = 1;
  }
  return graph;
}

MotorcycleGraph random_graph(const QuadMesh& quads, Rng& rng) {
  MotorcycleGraph graph{std::vector<char>(quads.trails.size(), 0), {}};
  for (const auto& trail : quads.trails) graph.rank.push_back(trail.length * rng.uniform(0.2, 1));
  for (int c = 0; c < static_cast<int>(quads.corners.size()); ++c) choose(quads, c, graph, rng);
  return graph;
}

void mutate(const QuadMesh& quads, MotorcycleGraph& graph, Rng& rng) {
  const int corner = rng.below(static_cast<int>(quads.corners.size()));
  if (rng.uniform() < 0.6) {
    choose(quads, corner, graph, rng);
    return;
  }
  const std::vector<int>& trails = quads.corners[corner];
  const int trail = trails[rng.below(static_cast<int>(trails.size()))];
  graph.rank[trail] = quads.trails[trail].length * rng.uniform(0.1, 2);
}

Decomposition drive(const QuadMesh& quads, const MotorcycleGraph& graph) {
  Decomposition out;
  std::vector<int> order;
  for (int t = 0; t < static_cast<int>(quads.trails.size()); ++t) {
    if (graph.driven[t]) order.push_back(t);
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return graph.rank[a] < graph.rank[b]; });
  std::vector<char> passed(quads.node_count, 0), cut(quads.segments.size(), 0);
  for (int t : order) {
    const QuadMesh::Trail& trail = quads.trails[t];
    if (trail.segments.empty() || cut[trail.segments.front()]) continue;
    out.trails.push_back(trail.start);
    for (std::size_t k = 0; k < trail.segments.size(); ++k) {
      cut[trail.segments[k]] = 1;
      out.cut_length += quads.segments[trail.segments[k]].length;
      if (passed[trail.nodes[k + 1]]) break;
    }
    for (std::size_t k = 0; k < trail.segments.size() && cut[trail.segments[k]]; ++k)
      passed[trail.nodes[k]] = passed[trail.nodes[k + 1]] = 1;
  }
  DisjointSets sets(quads.faces.size());
  for (std::size_t s = 0; s < quads.segments.size(); ++s) {
    if (!cut[s]) sets.unite(quads.segments[s].left, quads.segments[s].right);
  }
  std::vector<int> index(quads.faces.size(), -1);
  for (int f = 0; f < static_cast<int>(quads.faces.size()); ++f) {
    const int root = sets.find(f);
    if (index[root] < 0) {
      index[root] = static_cast<int>(out.rectangles.size());
      out.rectangles.push_back(quads.faces[f]);
      out.areas.push_back(0);
    }
    Box& box = out.rectangles[index[root]];
    box.min = box.min.cwiseMin(quads.faces[f].min);
    box.max = box.max.cwiseMax(quads.faces[f].max);
    out.areas[index[root]] += quads.face_areas[f];
  }
  return out;
}

}  // namespace atlas_refine
