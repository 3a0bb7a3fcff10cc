// Minimum degree, and nested dissection down to parts that it does as well.
#include "solve/elimination_order.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <utility>

#include "solve/separator.h"

namespace atlas_refine {
namespace {

constexpr int kMany = 200000;      // nodes: a factor of fewer gains less than separators cost
constexpr int kDissected = 20000;  // of those that hang together
constexpr int kUndivided = 200;    // of parts that are not separated any more
// Multiplications of blocks in the time that an order takes to find, per entry of the pattern.
constexpr double kWork = 500, kWorkOfDissection = 10000;

std::vector<int> minimum_degree_order(const Adjacency& graph) {
  const int n = graph.size();
  // One triangle and the diagonal, which the ordering expects, as compressed columns.
  std::vector<int> starts(n + 1, 0), rows;
  rows.reserve(graph.nodes.size() / 2 + n);
  for (int i = 0; i < n; ++i) {
    rows.push_back(i);
    for (int e = graph.start[i]; e < graph.start[i + 1]; ++e) {
      if (graph.nodes[e] > i) rows.push_back(graph.nodes[e]);
    }
    starts[i + 1] = static_cast<int>(rows.size());
  }
  const std::vector<char> ones(rows.size(), 1);
  const Eigen::SparseMatrix<char> pattern = Eigen::Map<const Eigen::SparseMatrix<char>>(
      n, n, static_cast<Eigen::Index>(rows.size()), starts.data(), rows.data(), ones.data());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(pattern.selfadjointView<Eigen::Lower>(), permutation);
  return {permutation.indices().data(), permutation.indices().data() + n};
}

/// The nodes that hang together, ascending.
std::vector<std::vector<int>> components(const Adjacency& graph) {
  std::vector<int> component(graph.size(), -1), reached;
  reached.reserve(graph.size());
  int count = 0;
  for (int seed = 0; seed < graph.size(); ++seed) {
    if (component[seed] >= 0) continue;
    component[seed] = count;
    reached.assign(1, seed);
    for (std::size_t k = 0; k < reached.size(); ++k) {
      for (int e = graph.start[reached[k]]; e < graph.start[reached[k] + 1]; ++e) {
        const int other = graph.nodes[e];
        if (std::exchange(component[other], count) < 0) reached.push_back(other);
      }
    }
    ++count;
  }
  std::vector<std::vector<int>> out(count);
  for (int v = 0; v < graph.size(); ++v) out[component[v]].push_back(v);
  return out;
}

/// Calls order_of(graph) for each component, and joins the orders.
template <class OrderOf>
std::vector<int> by_components(const Adjacency& graph, OrderOf order_of) {
  auto parts = components(graph);
  if (parts.size() == 1) return order_of(graph);
  std::vector<int> order;
  order.reserve(graph.size());
  for (std::vector<int>& nodes : parts) {
    const Subgraph part = subgraph(graph, std::move(nodes));
    for (const int k : order_of(part.graph)) order.push_back(part.nodes[k]);
  }
  return order;
}

std::vector<int> dissect(const Adjacency& connected) {
  if (connected.size() <= kUndivided) return minimum_degree_order(connected);
  std::array<std::vector<int>, 3> nodes;
  const std::vector<GraphSide> sides = separate(connected);
  for (int v = 0; v < connected.size(); ++v) nodes[static_cast<int>(sides[v])].push_back(v);
  std::vector<int> order;
  order.reserve(connected.size());
  for (const GraphSide side : {GraphSide::Left, GraphSide::Right}) {
    auto& own = nodes[static_cast<int>(side)];
    if (own.size() + 1 >= static_cast<std::size_t>(connected.size())) return minimum_degree_order(connected);  // nothing parts it
    const Subgraph part = subgraph(connected, std::move(own));
    for (const int k : by_components(part.graph, dissect)) order.push_back(part.nodes[k]);
  }
  order.insert(order.end(), nodes[static_cast<int>(GraphSide::Middle)].begin(), nodes[static_cast<int>(GraphSide::Middle)].end());
  return order;
}

}  // namespace

EliminationOrder elimination_order(const Adjacency& graph) {
  const double entries = graph.size() + 0.5 * static_cast<double>(graph.nodes.size());
  if (graph.size() < kMany) return {minimum_degree_order(graph), kWork * entries};
  const auto order_of = [](const Adjacency& part) {
    return part.size() < kDissected ? minimum_degree_order(part) : dissect(part);
  };
  return {by_components(graph, order_of), kWorkOfDissection * entries};
}

}  // namespace atlas_refine
