// One chart after the other: distances from each trail, a shortest path, and the parts that all paths leave.
#include "layout/edge_paths.h"

#include <limits>
#include <queue>

#include "cut/open_to_disk.h"
#include "layout/edge_parts.h"
#include "support/parallel.h"

namespace atlas_refine {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Length counts double at this distance from the trail: a share of the trail's length, and mean edges of the chart.
constexpr double kCorridor = 0.1;
constexpr double kCorridorEdges = 1;
// What a path costs for each length that its ends are away from the trail's.
constexpr double kMissed = 3;
// The same where a path starts or ends with an edge where a seam is wanted; its distance costs nothing else. A whole path of
// such edges beside the trail is taken as far away as nearly half the trail's length.
constexpr double kMissedForWanted = 1;
// Paths are sought as far from the trail as it is long and so many mean edges further; one that costs as much as missing both
// ends by that together leads elsewhere.
constexpr double kReachEdges = 2;

using Queue = std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>>;

/// The vertices of a mesh and what edges lead where, with lengths in the input's UVs.
struct EdgeGraph {
  struct Edge {
    int to;
    double length;
    Side side;
  };
  std::vector<int> first;  // edges of vertex v: first[v] .. first[v + 1] - 1
  std::vector<Edge> edges;
  double mean_length = 0;

  EdgeGraph(const SplitMesh& mesh, const std::vector<Vec2>& uvs) : first(mesh.vertex_count() + 1, 0) {
    for (const Triangle& t : mesh.triangles) {
      for (int v : t) ++first[v + 1];
    }
    // A boundary edge has one side only: it is entered at both of its ends.
    for_each_other_end(mesh, [&](int v, const Side&, int) { ++first[v + 1]; });
    for (int v = 0; v < mesh.vertex_count(); ++v) first[v + 1] += first[v];
    edges.resize(first.back());
    std::vector<int> next(first.begin(), first.end() - 1);
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      for (int k = 0; k < 3; ++k) add(mesh.from({t, k}), mesh.to({t, k}), {t, k}, uvs, next);
    }
    for_each_other_end(mesh, [&](int v, const Side& side, int to) { add(v, to, side, uvs, next); });
    for (const Edge& edge : edges) mean_length += edge.length / static_cast<double>(edges.size());
  }

 private:
  template <class Visit>
  static void for_each_other_end(const SplitMesh& mesh, const Visit& visit) {
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const Side side{t, k};
        if (mesh.is_boundary(side)) visit(mesh.to(side), side, mesh.from(side));
      }
    }
  }
  void add(int from, int to, const Side& side, const std::vector<Vec2>& uvs, std::vector<int>& next) {
    edges[next[from]++] = {to, (uvs[to] - uvs[from]).norm(), side};
  }
};

std::vector<Vec2> uvs_before(const SplitMesh& mesh, const Chart& chart) {
  std::vector<Vec2> out;
  for (const Support& support : mesh.supports) out.push_back(value_at(support, chart.uvs));
  return out;
}

/// Where the vertices of a chart lie from one trail: how far away, infinite beyond its reach, and how far along it from its
/// start.
struct TrailView {
  double length = 0, reach = 0;
  std::vector<double> away, along;
};

/// Distances on the divided chart; `margin` is what the reach exceeds the trail's length by.
TrailView view_of(const std::vector<int>& trail, const EdgeGraph& graph, const std::vector<Vec2>& uvs, double margin) {
  TrailView out{0, 0, std::vector<double>(uvs.size(), kInfinite), std::vector<double>(uvs.size(), 0)};
  Queue queue;
  for (std::size_t k = 0; k < trail.size(); ++k) {
    if (k > 0) out.length += (uvs[trail[k]] - uvs[trail[k - 1]]).norm();
    out.away[trail[k]] = 0;
    out.along[trail[k]] = out.length;
    queue.emplace(0, trail[k]);
  }
  out.reach = out.length + margin;
  while (!queue.empty()) {
    const auto [d, v] = queue.top();
    queue.pop();
    if (d > out.away[v]) continue;
    for (int e = graph.first[v]; e < graph.first[v + 1]; ++e) {
      const EdgeGraph::Edge& edge = graph.edges[e];
      const double through = d + edge.length;
      if (through >= out.away[edge.to] || through > out.reach) continue;
      out.away[edge.to] = through;
      out.along[edge.to] = out.along[v];
      queue.emplace(through, edge.to);
    }
  }
  return out;
}

/// The same for the vertices of the chart: copies of one vertex, where the chart was opened, are one.
TrailView on_chart(const TrailView& view, const SplitMesh& divided, int vertices) {
  TrailView out{view.length, view.reach, std::vector<double>(vertices, kInfinite), std::vector<double>(vertices, 0)};
  for (int v = 0; v < divided.vertex_count(); ++v) {
    if (divided.supports[v].vertices[1] >= 0) continue;
    const int own = divided.supports[v].vertices[0];
    if (view.away[v] >= out.away[own]) continue;
    out.away[own] = view.away[v];
    out.along[own] = view.along[v];
  }
  return out;
}

/// Paths through one chart.
class PathFinder {
 public:
  PathFinder(const SplitMesh& mesh, const SidePrices& prices, EdgeParts& parts)
      : mesh_(mesh), prices_(prices), parts_(parts), graph_(mesh, mesh.uvs), missed_(mesh.vertex_count(), kMissed) {
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      for (int k = 0; k < 3; ++k) {
        if (!mesh.is_boundary({t, k}) && prices[t][k] <= kPreferredSeam)
          missed_[mesh.from({t, k})] = missed_[mesh.to({t, k})] = kMissedForWanted;
      }
    }
  }

  double mean_edge() const { return graph_.mean_length; }

  /// From what lies at the trail's start to what lies at its end, boundary or earlier path; empty where there is none.
  std::vector<Side> find(const TrailView& view) const {
    const double width = kCorridor * view.length + kCorridorEdges * graph_.mean_length;
    std::vector<double> cost(mesh_.vertex_count(), kInfinite);
    std::vector<Side> reached_by(mesh_.vertex_count());
    Queue queue;
    for (int v = 0; v < mesh_.vertex_count(); ++v) {
      if (!parts_.on_border(v) || view.away[v] == kInfinite) continue;
      cost[v] = missed_[v] * view.away[v] + kMissed * view.along[v];
      queue.emplace(cost[v], v);
    }
    double best = kMissed * view.reach;
    Side last;
    while (!queue.empty() && queue.top().first < best) {
      const auto [d, v] = queue.top();
      queue.pop();
      if (d > cost[v]) continue;
      for (int e = graph_.first[v]; e < graph_.first[v + 1]; ++e) {
        const EdgeGraph::Edge& edge = graph_.edges[e];
        const double price = prices_[edge.side.triangle][edge.side.side];
        if (price == kNoSeam || mesh_.is_boundary(edge.side) || view.away[edge.to] == kInfinite) continue;
        const double off = price <= kPreferredSeam ? 0 : 0.5 * (view.away[v] + view.away[edge.to]) / width;
        const double through = d + price * edge.length * (1 + off * off);
        if (parts_.on_border(edge.to)) {
          const double whole = through + missed_[edge.to] * view.away[edge.to] + kMissed * (view.length - view.along[edge.to]);
          if (whole >= best) continue;
          best = whole;
          last = edge.side;
        } else if (through < cost[edge.to]) {
          cost[edge.to] = through;
          reached_by[edge.to] = edge.side;
          queue.emplace(through, edge.to);
        }
      }
    }
    std::vector<Side> path;
    for (Side walk = last; walk.triangle >= 0; walk = reached_by[mesh_.from(walk)]) path.push_back(walk);
    return path;
  }

 private:
  const SplitMesh& mesh_;
  const SidePrices& prices_;
  const EdgeParts& parts_;
  EdgeGraph graph_;
  std::vector<double> missed_;  // of each vertex: what a path costs for each length that it starts or ends away from the trail's
};

/// The sides that are cut to make a disk of the chart.
std::vector<Side> opened_sides(const SplitMesh& mesh, const SidePrices& prices) {
  SplitMesh opened = mesh;
  open_to_disk(opened, prices);
  std::vector<Side> out;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      if (opened.is_boundary({t, k}) && !mesh.is_boundary({t, k})) out.push_back({t, k});
    }
  }
  return out;
}

std::vector<Side> seams_of(const Chart& chart, const SplitMesh& divided, const std::vector<const SurfacePath*>& trails,
                           const SidePrices& prices) {
  const SplitMesh mesh(chart);
  EdgeParts parts(mesh, chart);
  parts.cut(opened_sides(mesh, prices));
  const PathFinder finder(mesh, prices, parts);
  const std::vector<Vec2> uvs = uvs_before(divided, chart);
  const EdgeGraph graph(divided, uvs);
  for (const SurfacePath* trail : trails) {
    const TrailView view = view_of(trail->vertices, graph, uvs, kReachEdges * finder.mean_edge());
    parts.cut(finder.find(on_chart(view, divided, mesh.vertex_count())));
  }
  return parts.seams();
}

}  // namespace

std::vector<SurfacePath> edge_paths(const std::vector<AxisAlignedChart>& aligned, const std::vector<Chart>& charts,
                                    const TracedTrails& traced, const std::vector<SidePrices>& prices, int threads) {
  std::vector<std::vector<const SurfacePath*>> trails(charts.size());
  for (const SurfacePath& path : traced.paths) trails[path.piece].push_back(&path);
  std::vector<std::vector<SurfacePath>> found(charts.size());
  parallel_ranges(static_cast<int>(charts.size()), threads, 1, [&](int begin, int end) {
    for (int c = begin; c < end; ++c) {
      if (aligned[c].boundary.empty()) continue;
      for (const Side& s : seams_of(charts[c], traced.meshes[c], trails[c], prices[c])) {
        const Triangle& t = charts[c].triangles[s.triangle];
        found[c].push_back({c, {t[s.side], t[(s.side + 1) % 3]}});
      }
    }
  });
  std::vector<SurfacePath> out;
  for (auto& own : found) out.insert(out.end(), own.begin(), own.end());
  return out;
}

}  // namespace atlas_refine
