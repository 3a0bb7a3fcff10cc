// The predicted shape of a factor against elimination on a dense matrix.
#include "solve/supernodes.h"

#include <gtest/gtest.h>

#include <set>

#include "support/rng.h"

namespace atlas_refine {
namespace {

Adjacency random_graph(int n, int edges, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<std::set<int>> neighbours(n);
  for (int k = 0; k < edges; ++k) {
    const int i = rng.below(n), j = rng.below(n);
    if (i == j) continue;
    neighbours[i].insert(j);
    neighbours[j].insert(i);
  }
  Adjacency graph{{0}, {}};
  for (const std::set<int>& row : neighbours) {
    graph.nodes.insert(graph.nodes.end(), row.begin(), row.end());
    graph.start.push_back(static_cast<int>(graph.nodes.size()));
  }
  return graph;
}

/// Rows below the diagonal of each column of the factor, by elimination, as positions.
std::vector<std::set<int>> eliminate(const Adjacency& graph, const Supernodes& tree) {
  std::vector<std::set<int>> columns(graph.size());
  for (int v = 0; v < graph.size(); ++v) {
    for (int e = graph.start[v]; e < graph.start[v + 1]; ++e) {
      const int a = tree.position[v], b = tree.position[graph.nodes[e]];
      columns[std::min(a, b)].insert(std::max(a, b));
    }
  }
  for (std::set<int>& column : columns) {
    if (column.empty()) continue;
    const int next = *column.begin();
    columns[next].insert(std::next(column.begin()), column.end());
  }
  return columns;
}

TEST(Supernodes, HoldWhatEliminationFills) {
  for (const int n : {1, 2, 30, 200}) {
    for (const int density : {0, 1, 3}) {
      const Adjacency graph = random_graph(n, density * n, n + density);
      const Supernodes tree = find_supernodes(graph);
      const std::vector<std::set<int>> columns = eliminate(graph, tree);
      ASSERT_EQ(tree.first.back(), n);
      for (int s = 0; s < tree.count(); ++s) {
        std::set<int> held(tree.rows.begin() + tree.row_start[s], tree.rows.begin() + tree.row_start[s + 1]);
        for (int k = tree.first[s]; k < tree.first[s + 1]; ++k) held.insert(k);
        for (int k = tree.first[s]; k < tree.first[s + 1]; ++k) {
          for (const int row : columns[k]) EXPECT_TRUE(held.contains(row));
        }
      }
    }
  }
}

TEST(Supernodes, AddFewZeros) {
  constexpr int kSide = 40, n = kSide * kSide;
  Adjacency grid{{0}, {}};
  for (int v = 0; v < n; ++v) {
    if (v >= kSide) grid.nodes.push_back(v - kSide);
    if (v % kSide > 0) grid.nodes.push_back(v - 1);
    if (v % kSide < kSide - 1) grid.nodes.push_back(v + 1);
    if (v < n - kSide) grid.nodes.push_back(v + kSide);
    grid.start.push_back(static_cast<int>(grid.nodes.size()));
  }
  const Supernodes tree = find_supernodes(grid);
  double exact = n, stored = 0;
  for (const std::set<int>& column : eliminate(grid, tree)) exact += static_cast<double>(column.size());
  for (int s = 0; s < tree.count(); ++s) stored += tree.pivots(s) * (0.5 * (tree.pivots(s) + 1) + tree.below(s));
  EXPECT_GE(stored, exact);
  EXPECT_LT(stored, 1.3 * exact);
  EXPECT_LT(tree.count(), n / 3);
}

TEST(Supernodes, ChildrenComeFirstAndTheirRowsLieInTheParent) {
  const Adjacency graph = random_graph(300, 600, 3);
  const Supernodes tree = find_supernodes(graph);
  for (int s = 0; s < tree.count(); ++s) {
    const int p = tree.parent[s];
    if (p < 0) {
      EXPECT_EQ(tree.below(s), 0);
      continue;
    }
    EXPECT_GT(p, s);
    for (int e = tree.row_start[s]; e < tree.row_start[s + 1]; ++e) {
      const int k = tree.row_in_parent[e];
      EXPECT_EQ(tree.rows[e], k < tree.pivots(p) ? tree.first[p] + k : tree.rows[tree.row_start[p] + k - tree.pivots(p)]);
    }
  }
}

}  // namespace
}  // namespace atlas_refine
