// Greedy Poisson disk sampling along the mesh, from the boundary inwards.
#include "coarsen/sample_vertices.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "geometry/rest_triangle.h"

namespace atlas_refine {
namespace {

constexpr double kGrowth = 0.7;  // of the distance that samples keep, per length away from the boundary

/// Edges from vertex v: entries [first[v], first[v + 1]), each once. Lengths are those on the surface.
struct VertexGraph {
  std::vector<int> first, neighbours;
  std::vector<double> lengths;

  template <class Visit>
  void visit(int v, Visit&& visit) const {
    for (int k = first[v]; k < first[v + 1]; ++k) visit(neighbours[k], lengths[k]);
  }
};

VertexGraph graph_of(const Chart& chart) {
  VertexGraph out;
  // Triangles on both sides of an edge name it from both ends; those on the boundary have the other end besides.
  std::vector<int> before(chart.vertex_count(), -1);  // in its boundary loop
  out.first.assign(chart.vertex_count() + 1, 0);
  for (const std::vector<int>& loop : chart.boundary_loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      before[loop[(k + 1) % loop.size()]] = loop[k];
      ++out.first[loop[k] + 1];
    }
  }
  for (const Triangle& t : chart.triangles) {
    for (const int v : t) ++out.first[v + 1];
  }
  for (int v = 0; v < chart.vertex_count(); ++v) out.first[v + 1] += out.first[v];
  std::vector<int> next(out.first.begin(), out.first.end() - 1);
  out.neighbours.resize(out.first.back());
  out.lengths.resize(out.first.back());
  for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
    const std::array<double, 3> lengths = side_lengths(chart.surface[t]);
    for (int k = 0; k < 3; ++k) {
      const int a = chart.triangles[t][k], b = chart.triangles[t][(k + 1) % 3];
      const auto add = [&](int from, int to) {
        out.neighbours[next[from]] = to;
        out.lengths[next[from]++] = lengths[k];
      };
      add(a, b);
      if (before[b] == a) add(b, a);
    }
  }
  return out;
}

using Entry = std::pair<double, int>;  // distance, vertex
using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;

/// The distance that a sample at each vertex keeps, and the vertices ordered by it.
struct Spacing {
  std::vector<double> at;
  std::vector<int> order;
};

/// At boundary vertices: the longer of their boundary edges.
std::vector<double> spacing_at_boundary(const Chart& chart, const VertexGraph& graph, double most) {
  std::vector<double> at(chart.vertex_count(), std::numeric_limits<double>::infinity());
  for (const std::vector<int>& loop : chart.boundary_loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int before = loop[(k + loop.size() - 1) % loop.size()], after = loop[(k + 1) % loop.size()];
      double longest = 0;
      graph.visit(loop[k], [&](int u, double length) {
        if (u == before || u == after) longest = std::max(longest, length);
      });
      at[loop[k]] = std::min(longest, most);
    }
  }
  return at;
}

/// Dijkstra from the boundary: a vertex keeps what its nearest boundary edges are long, more away from them. Those that keep
/// `most`, of large charts nearly all, follow in the order in which they are reached.
Spacing grown_spacing(const Chart& chart, const VertexGraph& graph, double most) {
  Spacing out;
  out.at = spacing_at_boundary(chart, graph, most);
  Queue queue;
  std::vector<int> far;
  const auto enter = [&](int v) {
    if (out.at[v] < most)
      queue.emplace(out.at[v], v);
    else
      far.push_back(v);
  };
  for (int v = 0; v < chart.vertex_count(); ++v) {
    if (std::isfinite(out.at[v])) enter(v);
  }
  while (!queue.empty()) {
    const double value = queue.top().first;
    const int v = queue.top().second;
    queue.pop();
    if (value > out.at[v]) continue;
    out.order.push_back(v);
    graph.visit(v, [&](int u, double length) {
      const double grown = std::min(value + kGrowth * length, most);
      if (grown >= out.at[u]) return;
      out.at[u] = grown;
      enter(u);
    });
  }
  for (std::size_t k = 0; k < far.size(); ++k) {
    const int v = far[k];
    if (out.at[v] < most) continue;  // reached on a shorter way later
    out.order.push_back(v);
    graph.visit(v, [&](int u, double) {
      if (!(out.at[u] > most)) return;
      out.at[u] = most;
      far.push_back(u);
    });
  }
  return out;
}

/// Samples taken so far, and the entry of one that is near for every vertex too near to be one itself.
class Sampling {
 public:
  Sampling(const VertexGraph& graph, const std::vector<double>& spacing)
      : graph_(graph), spacing_(spacing), owner_(spacing.size(), -1), taken_(spacing.size(), 0), distance_(spacing.size()) {}

  bool covered(int v) const { return owner_[v] >= 0; }
  bool taken(int v) const { return taken_[v]; }

  void take(int v) {
    int near = owner_[v];
    graph_.visit(v, [&](int u, double) { near = std::max(near, owner_[u]); });
    const int entry = static_cast<int>(sample_.vertices.size());
    sample_.vertices.push_back(v);
    taken_[v] = 1;
    sample_.near.push_back(near);
    cover(v, entry);
  }

  Sample result() && { return std::move(sample_); }

 private:
  /// All vertices around v that are nearer than its spacing, along edges. Few are reached twice: correcting those costs less than
  /// a queue that is in order, and distances end the same.
  void cover(int v, int entry) {
    const auto reach = [&](int u, double distance) {
      if (distance >= spacing_[v] || (owner_[u] == entry && distance >= distance_[u])) return;
      owner_[u] = entry;
      distance_[u] = distance;
      reached_.emplace_back(distance, u);
    };
    reached_.clear();
    reach(v, 0);
    for (std::size_t k = 0; k < reached_.size(); ++k) {
      const double distance = reached_[k].first;
      const int at = reached_[k].second;
      if (distance > distance_[at]) continue;
      graph_.visit(at, [&](int u, double length) { reach(u, distance + length); });
    }
  }

  const VertexGraph& graph_;
  const std::vector<double>& spacing_;
  std::vector<int> owner_;
  std::vector<char> taken_;
  std::vector<double> distance_;  ///< from the owner
  std::vector<Entry> reached_;
  Sample sample_;
};

}  // namespace

Sample sample_vertices(const Chart& chart, const std::vector<char>& held, double spacing) {
  const VertexGraph graph = graph_of(chart);
  const Spacing wanted = grown_spacing(chart, graph, spacing);
  Sampling sampling(graph, wanted.at);
  for (const std::vector<int>& loop : chart.boundary_loops) {
    for (const int v : loop) sampling.take(v);
  }
  for (int v = 0; v < chart.vertex_count(); ++v) {
    if (held[v] && !sampling.taken(v)) sampling.take(v);
  }
  for (const int v : wanted.order) {
    if (!sampling.covered(v)) sampling.take(v);
  }
  return std::move(sampling).result();
}

}  // namespace atlas_refine
