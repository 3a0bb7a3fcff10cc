// Shortest paths along edges of faces, and the cotree.
#include "cut/open_closed.h"

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <map>
#include <queue>
#include <set>

#include "geometry/half_edge_mesh.h"
#include "support/disjoint_sets.h"

namespace atlas_refine {
namespace {

constexpr int kMostTips = 6;         // of the tree that opens a chart
constexpr double kNearEnough = 0.4;  // of the longest distance in the chart: no vertex is to be further from the cuts
constexpr int kRoots = 8;            // tried for the loops around handles
constexpr double kFar = std::numeric_limits<double>::infinity();

/// An edge between two faces, or at the boundary.
struct Edge {
  std::array<int, 2> ends;
  std::array<int, 2> triangles{-1, -1};
  double length = 0;
  bool diagonal = false;  ///< both its triangles belong to one face

  bool may_open() const { return triangles[1] >= 0 && !diagonal; }
};

struct Graph {
  std::vector<Edge> edges;
  std::vector<std::vector<int>> around;  ///< per vertex: edges that a cut may run along
};

Graph graph_of(const Chart& chart) {
  std::map<std::pair<int, int>, int> known;
  Graph out;
  for (int t = 0; t < static_cast<int>(chart.triangles.size()); ++t) {
    const Mat2 flat = chart.surface[t].inverse_edges.inverse();
    const std::array<double, 3> lengths = {flat.col(0).norm(), (flat.col(1) - flat.col(0)).norm(), flat.col(1).norm()};
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(chart.triangles[t][k], chart.triangles[t][(k + 1) % 3]);
      const auto [entry, is_new] = known.try_emplace({low, high}, static_cast<int>(out.edges.size()));
      if (is_new) out.edges.push_back({.ends = {low, high}, .length = lengths[k]});
      Edge& edge = out.edges[entry->second];
      edge.triangles[is_new ? 0 : 1] = t;
      if (!is_new) edge.diagonal = chart.triangle_faces[t] == chart.triangle_faces[edge.triangles[0]];
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
    } else if (edge.diagonal) {
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
    if (best.empty() || length_of(graph, loops) < length_of(graph, best)) best = std::move(loops);
    roots.push_back(distances_from(graph, roots).farthest());
  }
  return best;
}

}  // namespace

ChartShape shape_of(const Chart& chart) {
  const MeshTopology topology = mesh_topology(chart.vertex_count(), chart.triangles);
  const int loops = static_cast<int>(topology.boundary_loops.size());
  return {loops, (2 - loops - topology.euler_characteristic) / 2};
}

std::vector<std::array<int, 2>> opening_edges(const Chart& chart) {
  const Graph graph = graph_of(chart);
  const ChartShape shape = shape_of(chart);
  const int one_end = distances_from(graph, {graph.edges.front().ends[0]}).farthest();
  const Distances from_end = distances_from(graph, {one_end});
  const int other_end = from_end.farthest();
  std::set<int> cuts;
  if (shape.handles > 0)
    cuts = shortest_handle_loops(chart, graph, one_end);
  else if (shape.loops == 0)
    add_path(graph, from_end, other_end, cuts);
  for (int tips = 2; tips < kMostTips && !cuts.empty(); ++tips) {
    std::vector<int> sources = ends_of(graph, cuts);
    for (const auto& loop : chart.boundary_loops) sources.insert(sources.end(), loop.begin(), loop.end());
    const Distances from_cuts = distances_from(graph, sources);
    const int tip = from_cuts.farthest();
    // A single edge would leave a hole of two sides, which is none.
    if (cuts.size() > 1 && from_cuts.distance[tip] < kNearEnough * from_end.distance[other_end]) break;
    add_path(graph, from_cuts, tip, cuts);
  }
  std::vector<std::array<int, 2>> out;
  for (const int e : cuts) out.push_back(graph.edges[e].ends);
  return out;
}

}  // namespace atlas_refine
