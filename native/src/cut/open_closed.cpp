// Shortest paths along edges of faces, the cotree, and seams to where the chart would be scaled most.
#include "cut/open_closed.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <set>

#include "cut/scale_forecast.h"
#include "geometry/half_edge_mesh.h"
#include "geometry/rest_triangle.h"
#include "support/disjoint_sets.h"

namespace atlas_refine {
namespace {

constexpr int kMostTips = 40;       // of the tree that opens a chart
constexpr int kPatience = 4;        // seams added in vain before the search ends
constexpr double kSeamWorth = 0.1;  // of the forecast, that a seam as long as the root of the area must save: of E_d a quarter
constexpr int kRoots = 8;           // tried for the loops around handles
constexpr double kFar = std::numeric_limits<double>::infinity();

/// An edge between two faces, or at the boundary.
struct Edge {
  std::array<int, 2> ends;
  std::array<int, 2> triangles{-1, -1};
  double length = 0;   ///< times the price of a seam there
  bool whole = false;  ///< no cut may run along it: both its triangles belong to one face, or the artist said so

  bool may_open() const { return triangles[1] >= 0 && !whole; }
};

struct Graph {
  std::vector<Edge> edges;
  std::vector<std::vector<int>> around;  ///< per vertex: edges that a cut may run along
};

Graph graph_of(const Chart& chart, const SidePrices& prices) {
  std::map<std::pair<int, int>, int> known;
  Graph out;
  for (int t = 0; t < static_cast<int>(chart.triangles.size()); ++t) {
    const std::array<double, 3> lengths = side_lengths(chart.surface[t]);
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(chart.triangles[t][k], chart.triangles[t][(k + 1) % 3]);
      const auto [entry, is_new] = known.try_emplace({low, high}, static_cast<int>(out.edges.size()));
      const double price = prices.empty() ? 1 : prices[t][k];
      if (is_new) out.edges.push_back({.ends = {low, high}, .length = price * lengths[k], .whole = price == kNoSeam});
      Edge& edge = out.edges[entry->second];
      edge.triangles[is_new ? 0 : 1] = t;
      if (!is_new) edge.whole = edge.whole || chart.triangle_faces[t] == chart.triangle_faces[edge.triangles[0]];
    }
  }
  out.around.resize(chart.vertex_count());
  for (int e = 0; e < static_cast<int>(out.edges.size()); ++e) {
    if (!out.edges[e].may_open()) continue;
    for (const int v : out.edges[e].ends) out.around[v].push_back(e);
  }
  return out;
}

struct Distances {
  std::vector<double> distance;  ///< per vertex, infinite where it cannot be reached
  std::vector<int> edge;         ///< the last one on the way there, -1 at sources

  int farthest() const {
    int out = -1;
    for (int v = 0; v < static_cast<int>(distance.size()); ++v) {
      if (distance[v] < kFar && (out < 0 || distance[v] > distance[out])) out = v;
    }
    return out;
  }
};

Distances distances_from(const Graph& graph, const std::vector<int>& sources) {
  Distances out{std::vector<double>(graph.around.size(), kFar), std::vector<int>(graph.around.size(), -1)};
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const int v : sources) {
    out.distance[v] = 0;
    queue.emplace(0, v);
  }
  while (!queue.empty()) {
    const auto [d, v] = queue.top();
    queue.pop();
    if (d > out.distance[v]) continue;
    for (const int e : graph.around[v]) {
      const Edge& edge = graph.edges[e];
      const int w = edge.ends[0] == v ? edge.ends[1] : edge.ends[0];
      if (d + edge.length >= out.distance[w]) continue;
      out.distance[w] = d + edge.length;
      out.edge[w] = e;
      queue.emplace(out.distance[w], w);
    }
  }
  return out;
}

/// Adds the edges from the vertex back to the sources.
void add_path(const Graph& graph, const Distances& tree, int vertex, std::set<int>& edges) {
  for (int v = vertex; tree.edge[v] >= 0;) {
    const Edge& edge = graph.edges[tree.edge[v]];
    edges.insert(tree.edge[v]);
    v = edge.ends[0] == v ? edge.ends[1] : edge.ends[0];
  }
}

/// Edges of the loops through the tree's root that open every handle: those that neither the tree nor a spanning tree of the
/// faces (holes are faces too) takes, each with its paths to the root.
std::set<int> handle_loops(const Chart& chart, const Graph& graph, const std::vector<int>& hole_of_vertex,
                           const Distances& tree) {
  const std::size_t triangles = chart.triangles.size();
  DisjointSets faces(triangles + chart.boundary_loops.size());
  std::vector<std::pair<double, int>> crossable;
  for (int e = 0; e < static_cast<int>(graph.edges.size()); ++e) {
    const Edge& edge = graph.edges[e];
    if (edge.triangles[1] < 0) {
      faces.unite(edge.triangles[0], static_cast<int>(triangles) + hole_of_vertex[edge.ends[0]]);
    } else if (edge.whole) {
      faces.unite(edge.triangles[0], edge.triangles[1]);
    } else if (tree.edge[edge.ends[0]] != e && tree.edge[edge.ends[1]] != e) {
      crossable.emplace_back(-(tree.distance[edge.ends[0]] + tree.distance[edge.ends[1]] + edge.length), e);
    }
  }
  std::sort(crossable.begin(), crossable.end());
  std::set<int> loops;
  for (const auto& [length, e] : crossable) {
    const Edge& edge = graph.edges[e];
    if (faces.find(edge.triangles[0]) != faces.find(edge.triangles[1])) {
      faces.unite(edge.triangles[0], edge.triangles[1]);
      continue;
    }
    loops.insert(e);
    for (const int v : edge.ends) add_path(graph, tree, v, loops);
  }
  return loops;
}

/// Without the edges that would part pieces from the surface, where loops run from a hole and back to it.
std::set<int> without_partings(const Chart& chart, const Graph& graph, std::set<int> cuts) {
  DisjointSets faces(chart.triangles.size());
  const auto unite_across = [&](int e) {
    const auto [one, other] = graph.edges[e].triangles;
    if (other < 0 || faces.find(one) == faces.find(other)) return false;
    faces.unite(one, other);
    return true;
  };
  for (int e = 0; e < static_cast<int>(graph.edges.size()); ++e) {
    if (!cuts.contains(e)) unite_across(e);
  }
  std::erase_if(cuts, unite_across);
  return cuts;
}

/// Without the ways that end inside the surface: they open nothing.
std::set<int> without_dead_ends(const Graph& graph, const std::vector<int>& hole_of_vertex, std::set<int> cuts) {
  std::vector<std::set<int>> at(graph.around.size());
  for (const int e : cuts) {
    for (const int v : graph.edges[e].ends) at[v].insert(e);
  }
  for (int start = 0; start < static_cast<int>(at.size()); ++start) {
    for (int v = start; at[v].size() == 1 && hole_of_vertex[v] < 0;) {
      const int e = *at[v].begin();
      for (const int end : graph.edges[e].ends) at[end].erase(e);
      cuts.erase(e);
      v = graph.edges[e].ends[0] == v ? graph.edges[e].ends[1] : graph.edges[e].ends[0];
    }
  }
  return cuts;
}

double length_of(const Graph& graph, const std::set<int>& edges) {
  double length = 0;
  for (const int e : edges) length += graph.edges[e].length;
  return length;
}

std::vector<int> ends_of(const Graph& graph, const std::set<int>& edges) {
  std::set<int> vertices;
  for (const int e : edges) vertices.insert(graph.edges[e].ends.begin(), graph.edges[e].ends.end());
  return {vertices.begin(), vertices.end()};
}

/// The shortest loops of those from several roots, each far from the others.
std::set<int> shortest_handle_loops(const Chart& chart, const Graph& graph, int first_root) {
  std::vector<int> hole_of_vertex(chart.vertex_count(), -1);
  for (std::size_t l = 0; l < chart.boundary_loops.size(); ++l) {
    for (const int v : chart.boundary_loops[l]) hole_of_vertex[v] = static_cast<int>(l);
  }
  std::set<int> best;
  std::vector<int> roots = {first_root};
  for (int k = 0; k < kRoots; ++k) {
    std::set<int> loops = handle_loops(chart, graph, hole_of_vertex, distances_from(graph, {roots.back()}));
    loops = without_dead_ends(graph, hole_of_vertex, without_partings(chart, graph, std::move(loops)));
    if (best.empty() || length_of(graph, loops) < length_of(graph, best)) best = std::move(loops);
    roots.push_back(distances_from(graph, roots).farthest());
  }
  return best;
}

/// A vertex of the largest part that cuts can reach; -1 where they cannot run anywhere.
int reachable_vertex(const Graph& graph) {
  DisjointSets parts(graph.around.size());
  for (const Edge& edge : graph.edges) {
    if (edge.may_open()) parts.unite(edge.ends[0], edge.ends[1]);
  }
  std::vector<int> sizes(graph.around.size(), 0);
  for (int v = 0; v < static_cast<int>(sizes.size()); ++v) ++sizes[parts.find(v)];
  const auto largest = std::max_element(sizes.begin(), sizes.end());
  return *largest > 1 ? static_cast<int>(largest - sizes.begin()) : -1;
}

/// Cuts that grow from a first vertex or loops, each time to the vertex that would be scaled most; in the end the first of them,
/// as many as are worth their length.
class GrowingCuts {
 public:
  GrowingCuts(const Chart& chart, const Graph& graph)
      : graph_(graph), forecast_(chart), border_(chart.vertex_count(), 0), unit_(std::sqrt(chart.surface.area())) {
    for (const std::vector<int>& loop : chart.boundary_loops) {
      for (const int v : loop) border_[v] = 1;
    }
  }

  /// Without cuts to start from it starts at what is scaled most if `end` is held, a corner of a box or the tip of a horn.
  std::set<int> grown(std::set<int> cuts, int end) {
    if (cuts.empty()) border_[opposite(end)] = 1;
    for (const int v : ends_of(graph_, cuts)) border_[v] = 1;
    std::set<int> best;
    double least = kFar;
    int in_vain = 0;
    for (int tips = 0; tips < kMostTips && in_vain < kPatience; ++tips) {
      const std::vector<double> scales = forecast_.logarithms(border_);
      const double cost = forecast_.energy(scales) + kSeamWorth * length_of(graph_, cuts) / unit_;
      ++in_vain;
      // A single edge would leave a hole of two sides, which is none.
      if (cuts.size() > 1 && (best.empty() || cost < least)) {
        best = cuts;
        least = cost;
        in_vain = 0;
      }
      if (!grow_to_most_scaled(scales, cuts)) break;
    }
    return best;
  }

 private:
  /// Of the vertices that seams from the border can reach; -1 where there is none.
  int most_scaled(const std::vector<double>& scales, const Distances& from_border) const {
    int tip = -1;
    for (int v = 0; v < static_cast<int>(border_.size()); ++v) {
      if (border_[v] || from_border.distance[v] == kFar) continue;
      if (tip < 0 || std::abs(scales[v]) > std::abs(scales[tip])) tip = v;
    }
    return tip;
  }

  int opposite(int end) {
    border_[end] = 1;
    const int tip = most_scaled(forecast_.logarithms(border_), distances_from(graph_, {end}));
    border_[end] = 0;
    return tip < 0 ? end : tip;
  }

  bool grow_to_most_scaled(const std::vector<double>& scales, std::set<int>& cuts) {
    std::vector<int> sources;
    for (int v = 0; v < static_cast<int>(border_.size()); ++v) {
      if (border_[v]) sources.push_back(v);
    }
    const Distances from_border = distances_from(graph_, sources);
    const int tip = most_scaled(scales, from_border);
    if (tip < 0) return false;
    add_path(graph_, from_border, tip, cuts);
    for (const int v : ends_of(graph_, cuts)) border_[v] = 1;
    return true;
  }

  const Graph& graph_;
  ScaleForecast forecast_;
  std::vector<char> border_;  // per vertex
  double unit_;               // of length
};

}  // namespace

ChartShape shape_of(const Chart& chart) {
  const MeshTopology topology = mesh_topology(chart.vertex_count(), chart.triangles);
  const int loops = static_cast<int>(topology.boundary_loops.size());
  return {loops, (2 - loops - topology.euler_characteristic) / 2};
}

bool fits_plane(const Chart& chart) {
  std::size_t boundary = 0;
  for (const std::vector<int>& loop : chart.boundary_loops) boundary += loop.size();
  const int triangles = static_cast<int>(chart.triangles.size()), loops = static_cast<int>(chart.boundary_loops.size());
  const int edges = (3 * triangles + static_cast<int>(boundary)) / 2;
  return loops > 0 && chart.vertex_count() - edges + triangles == 2 - loops;
}

std::vector<std::array<int, 2>> opening_edges(const Chart& chart, const SidePrices& prices) {
  const Graph graph = graph_of(chart, prices);
  const ChartShape shape = shape_of(chart);
  const int start = reachable_vertex(graph);
  if (shape.fits_plane() || start < 0) return {};
  const int end = distances_from(graph, {start}).farthest();
  std::set<int> cuts;
  if (shape.handles > 0) cuts = shortest_handle_loops(chart, graph, end);
  if (shape.handles > 0 && cuts.empty()) return {};
  cuts = GrowingCuts(chart, graph).grown(std::move(cuts), end);
  std::vector<std::array<int, 2>> out;
  for (const int e : cuts) out.push_back(graph.edges[e].ends);
  return out;
}

}  // namespace atlas_refine
