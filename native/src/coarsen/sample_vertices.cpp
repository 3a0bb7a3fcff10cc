// Greedy Poisson disk sampling along the mesh, from the boundary inwards.
#include "coarsen/sample_vertices.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <utility>

namespace atlas_refine {
namespace {

constexpr double kGrowth = 0.7;  // of the distance that samples keep, per length away from the boundary

/// Neighbours of vertex v along edges: entries [first[v], first[v + 1]); those of inner edges come twice.
struct VertexGraph {
  std::vector<int> first, neighbours;

  template <class Visit>
  void visit(int v, Visit&& visit) const {
    for (int k = first[v]; k < first[v + 1]; ++k) visit(neighbours[k]);
  }
};

VertexGraph graph_of(const Chart& chart) {
  VertexGraph out;
  out.first.assign(chart.vertex_count() + 1, 0);
  for (const Triangle& t : chart.triangles) {
    for (const int v : t) out.first[v + 1] += 2;
  }
  for (int v = 0; v < chart.vertex_count(); ++v) out.first[v + 1] += out.first[v];
  std::vector<int> next(out.first.begin(), out.first.end() - 1);
  out.neighbours.resize(out.first.back());
  for (const Triangle& t : chart.triangles) {
    for (int k = 0; k < 3; ++k) {
      out.neighbours[next[t[k]]++] = t[(k + 1) % 3];
      out.neighbours[next[t[k]]++] = t[(k + 2) % 3];
    }
  }
  return out;
}

/// The distance that a sample at each vertex keeps, and the vertices ordered by it.
struct Spacing {
  std::vector<double> at;
  std::vector<int> order;
};

void start_at_boundary(const Chart& chart, std::vector<double>& at) {
  for (const std::vector<int>& loop : chart.boundary_loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int a = loop[k], b = loop[(k + 1) % loop.size()];
      const double length = (chart.uvs[a] - chart.uvs[b]).norm();
      for (const int v : {a, b}) at[v] = std::isfinite(at[v]) ? std::max(at[v], length) : length;
    }
  }
}

/// Dijkstra from the boundary: a vertex keeps what its nearest boundary edges are long, more away from them.
Spacing grown_spacing(const Chart& chart, const VertexGraph& graph, double most) {
  Spacing out;
  out.at.assign(chart.vertex_count(), std::numeric_limits<double>::infinity());
  start_at_boundary(chart, out.at);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (int v = 0; v < chart.vertex_count(); ++v) {
    if (std::isfinite(out.at[v])) queue.emplace(out.at[v], v);
  }
  std::vector<char> done(chart.vertex_count(), 0);
  while (!queue.empty()) {
    const auto [value, v] = queue.top();
    queue.pop();
    if (done[v]) continue;
    done[v] = 1;
    out.order.push_back(v);
    graph.visit(v, [&](int u) {
      const double grown = value + kGrowth * (chart.uvs[u] - chart.uvs[v]).norm();
      if (grown < out.at[u]) queue.emplace(out.at[u] = grown, u);
    });
  }
  for (double& value : out.at) value = std::min(value, most);
  return out;
}

/// Samples taken so far, and the entry of one that is near for every vertex too near to be one itself.
class Sampling {
 public:
  Sampling(const Chart& chart, const VertexGraph& graph, const std::vector<double>& spacing)
      : chart_(chart), graph_(graph), spacing_(spacing), owner_(chart.vertex_count(), -1) {}

  bool covered(int v) const { return owner_[v] >= 0; }

  void take(int v) {
    int near = owner_[v];
    graph_.visit(v, [&](int u) { near = std::max(near, owner_[u]); });
    const int entry = static_cast<int>(sample_.vertices.size());
    sample_.vertices.push_back(v);
    sample_.near.push_back(near);
    cover(v, entry);
  }

  Sample result() && { return std::move(sample_); }

 private:
  /// All vertices around v that are nearer than its spacing, as far as edges between such lead.
  void cover(int v, int entry) {
    owner_[v] = entry;
    stack_.assign(1, v);
    const double square = spacing_[v] * spacing_[v];
    while (!stack_.empty()) {
      const int at = stack_.back();
      stack_.pop_back();
      graph_.visit(at, [&](int u) {
        if (owner_[u] == entry || (chart_.uvs[u] - chart_.uvs[v]).squaredNorm() >= square) return;
        owner_[u] = entry;
        stack_.push_back(u);
      });
    }
  }

  const Chart& chart_;
  const VertexGraph& graph_;
  const std::vector<double>& spacing_;
  std::vector<int> owner_;
  std::vector<int> stack_;
  Sample sample_;
};

}  // namespace

Sample sample_vertices(const Chart& chart, double spacing) {
  const VertexGraph graph = graph_of(chart);
  const Spacing wanted = grown_spacing(chart, graph, spacing);
  Sampling sampling(chart, graph, wanted.at);
  for (const std::vector<int>& loop : chart.boundary_loops) {
    for (const int v : loop) sampling.take(v);
  }
  for (const int v : wanted.order) {
    if (!sampling.covered(v)) sampling.take(v);
  }
  return std::move(sampling).result();
}

}  // namespace atlas_refine
