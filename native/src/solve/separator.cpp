// From coarse to fine: where a smaller graph of the same form is parted a large one is, too, nearly.
#include "solve/separator.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace atlas_refine {
namespace {

constexpr int kFew = 500;        // nodes of a graph that is parted as it is
constexpr double kMiddle = 0.4;  // of these nodes: where its smallest separator is looked for
constexpr int kRings = 2;        // of stars on either side of a separator, where the next finer one is looked for

/// Numbers of edges from one node, and the nodes in the order of these.
struct Distances {
  std::vector<int> to;
  std::vector<int> nodes;
};

Distances distances_from(const Adjacency& graph, int node) {
  Distances out{.to = std::vector<int>(graph.size(), -1), .nodes = {node}};
  out.to[node] = 0;
  for (std::size_t k = 0; k < out.nodes.size(); ++k) {
    const int v = out.nodes[k];
    for (int e = graph.start[v]; e < graph.start[v + 1]; ++e) {
      const int w = graph.nodes[e];
      if (out.to[w] >= 0) continue;
      out.to[w] = out.to[v] + 1;
      out.nodes.push_back(w);
    }
  }
  return out;
}

/// What lies in the middle between two ends far from each other: by how much nearer nodes are to the one.
std::vector<GraphSide> middle_of(const Adjacency& graph) {
  const int one = distances_from(graph, 0).nodes.back();
  const Distances from_one = distances_from(graph, one);
  const Distances from_other = distances_from(graph, from_one.nodes.back());
  std::vector<int> order = from_one.nodes;
  const auto nearer = [&](int v) { return from_one.to[v] - from_other.to[v]; };
  std::stable_sort(order.begin(), order.end(), [&](int v, int w) { return nearer(v) < nearer(w); });
  const int left = static_cast<int>(0.5 * (1 - kMiddle) * graph.size());
  std::vector<GraphSide> sides(graph.size(), GraphSide::Middle);
  for (int k = 0; k < left; ++k) {
    sides[order[k]] = GraphSide::Left;
    sides[order[graph.size() - 1 - k]] = GraphSide::Right;
  }
  return sides;
}

/// All nodes in an order that scatters them: steps of the golden section, as far as these meet every node.
std::vector<int> scattered(int count) {
  long long step = std::max(1LL, std::llround(0.6180339887 * count));
  while (std::gcd(step, static_cast<long long>(count)) != 1) ++step;
  std::vector<int> nodes;
  nodes.reserve(count);
  for (int k = 0; k < count; ++k) nodes.push_back(static_cast<int>(k * step % count));
  return nodes;
}

/// A node with those of its neighbours that no star had before is one: each node has its star. Taken in the order of their
/// numbers, which often run row by row, stars would be longish.
std::vector<int> stars_of(const Adjacency& graph) {
  std::vector<int> star(graph.size(), -1);
  int count = 0;
  for (const int v : scattered(graph.size())) {
    if (star[v] >= 0) continue;
    star[v] = count;
    for (int e = graph.start[v]; e < graph.start[v + 1]; ++e) {
      if (star[graph.nodes[e]] < 0) star[graph.nodes[e]] = count;
    }
    ++count;
  }
  return star;
}

Adjacency graph_of_stars(const Adjacency& graph, const std::vector<int>& star) {
  const int count = 1 + *std::max_element(star.begin(), star.end());
  std::vector<int> start(count + 1, 0), members(graph.size());
  for (const int s : star) ++start[s + 1];
  for (int s = 0; s < count; ++s) start[s + 1] += start[s];
  std::vector<int> next(start.begin(), start.end() - 1);
  for (int v = 0; v < graph.size(); ++v) members[next[star[v]]++] = v;
  Adjacency out{.start = {0}, .nodes = {}};
  std::vector<int> last_joined(count, -1);
  for (int s = 0; s < count; ++s) {
    last_joined[s] = s;
    for (int m = start[s]; m < start[s + 1]; ++m) {
      for (int e = graph.start[members[m]]; e < graph.start[members[m] + 1]; ++e) {
        const int other = star[graph.nodes[e]];
        if (last_joined[other] == s) continue;
        last_joined[other] = s;
        out.nodes.push_back(other);
      }
    }
    out.start.push_back(static_cast<int>(out.nodes.size()));
  }
  return out;
}

void widen_middle(const Adjacency& graph, std::vector<GraphSide>& sides) {
  const std::vector<GraphSide> before = sides;
  for (int v = 0; v < graph.size(); ++v) {
    if (before[v] != GraphSide::Middle) continue;
    for (int e = graph.start[v]; e < graph.start[v + 1]; ++e) sides[graph.nodes[e]] = GraphSide::Middle;
  }
}

/// What lies around where the graph of stars is parted.
std::vector<GraphSide> middle_by_stars(const Adjacency& graph, const std::vector<int>& star, const Adjacency& stars) {
  std::vector<GraphSide> coarse = separate(stars), out;
  for (int ring = 0; ring < kRings; ++ring) widen_middle(stars, coarse);
  out.reserve(graph.size());
  for (const int s : star) out.push_back(coarse[s]);
  return out;
}

std::vector<GraphSide> wide_middle(const Adjacency& graph) {
  if (graph.size() <= kFew) return middle_of(graph);
  const std::vector<int> star = stars_of(graph);
  return middle_by_stars(graph, star, graph_of_stars(graph, star));
}

}  // namespace

std::vector<GraphSide> separate(const Adjacency& graph) {
  std::vector<GraphSide> sides = wide_middle(graph);
  narrow_to_cut(graph, sides);
  // Where the middle is thin, edges lead past it.
  for (int v = 0; v < graph.size(); ++v) {
    if (sides[v] != GraphSide::Left) continue;
    const auto first = graph.nodes.begin() + graph.start[v], last = graph.nodes.begin() + graph.start[v + 1];
    if (std::any_of(first, last, [&](int w) { return sides[w] == GraphSide::Right; })) sides[v] = GraphSide::Middle;
  }
  return sides;
}

}  // namespace atlas_refine
