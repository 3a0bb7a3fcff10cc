// Orders of grids, whose separators are known.
#include "solve/elimination_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solve/separator.h"
#include "solve/supernodes.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

using Edges = std::vector<std::pair<int, int>>;

Adjacency graph_of(int count, const Edges& edges) {
  std::vector<std::vector<int>> neighbours(count);
  for (const auto& [i, j] : edges) {
    neighbours[i].push_back(j);
    neighbours[j].push_back(i);
  }
  Adjacency out{.start = {0}, .nodes = {}};
  for (std::vector<int>& own : neighbours) {
    std::sort(own.begin(), own.end());
    out.nodes.insert(out.nodes.end(), own.begin(), own.end());
    out.start.push_back(static_cast<int>(out.nodes.size()));
  }
  return out;
}

/// A triangulated rectangle, its nodes numbered row by row.
Edges rectangle_edges(int width, int height) {
  Edges edges;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int v = y * width + x;
      if (x + 1 < width) edges.emplace_back(v, v + 1);
      if (y + 1 < height) edges.emplace_back(v, v + width);
      if (x + 1 < width && y + 1 < height) edges.emplace_back(v, v + width + 1);
    }
  }
  return edges;
}

int count_of(const std::vector<GraphSide>& sides, GraphSide side) {
  return static_cast<int>(std::count(sides.begin(), sides.end(), side));
}

void expect_parted(const Adjacency& graph, const std::vector<GraphSide>& sides) {
  for (int v = 0; v < graph.size(); ++v) {
    for (int e = graph.start[v]; e < graph.start[v + 1]; ++e) {
      EXPECT_FALSE(sides[v] == GraphSide::Left && sides[graph.nodes[e]] == GraphSide::Right) << v << " and " << graph.nodes[e];
    }
  }
}

TEST(VertexCut, FindsTheNeckBetweenTwoRooms) {
  // Two rectangles of 20 x 20 that three nodes join.
  Edges edges = rectangle_edges(20, 20);
  for (const auto& [i, j] : rectangle_edges(20, 20)) edges.emplace_back(400 + i, 400 + j);
  for (int k = 0; k < 3; ++k) {
    edges.emplace_back(20 * (k + 8) + 19, 800 + k);
    edges.emplace_back(800 + k, 400 + 20 * (k + 8));
  }
  const Adjacency graph = graph_of(803, edges);
  std::vector<GraphSide> sides(803, GraphSide::Middle);
  for (int y = 0; y < 20; ++y) {
    sides[20 * y] = GraphSide::Left;
    sides[400 + 20 * y + 19] = GraphSide::Right;
  }
  narrow_to_cut(graph, sides);
  expect_parted(graph, sides);
  EXPECT_EQ(count_of(sides, GraphSide::Middle), 3);
  EXPECT_EQ(count_of(sides, GraphSide::Left) + count_of(sides, GraphSide::Right), 800);
}

TEST(VertexCut, OfRandomGraphsIsAsSmallAsNodesThatPartThemCanBe) {
  Rng rng(3);
  for (int trial = 0; trial < 200; ++trial) {
    const int count = 10;
    Edges edges;
    for (int k = 0; k < 14; ++k) {
      const int i = rng.below(count), j = rng.below(count);
      if (i != j && i + j != 1) edges.emplace_back(i, j);  // 0 is left, 1 right
    }
    const Adjacency graph = graph_of(count, edges);
    const auto parted_by = [&](unsigned removed) {
      std::vector<int> reached = {0};
      unsigned seen = 1;
      for (std::size_t k = 0; k < reached.size(); ++k) {
        for (int e = graph.start[reached[k]]; e < graph.start[reached[k] + 1]; ++e) {
          const int w = graph.nodes[e];
          if (seen >> w & 1U || removed >> w & 1U) continue;
          seen |= 1U << w;
          reached.push_back(w);
        }
      }
      return (seen >> 1 & 1U) == 0;
    };
    int least = count;
    for (unsigned removed = 0; removed < 1U << count; removed += 4) {
      if (parted_by(removed)) least = std::min(least, __builtin_popcount(removed));
    }
    std::vector<GraphSide> sides(count, GraphSide::Middle);
    sides[0] = GraphSide::Left;
    sides[1] = GraphSide::Right;
    narrow_to_cut(graph, sides);
    expect_parted(graph, sides);
    EXPECT_EQ(count_of(sides, GraphSide::Middle), least) << "trial " << trial;
  }
}

TEST(Separator, OfALongRectangleIsAboutItsWidth) {
  const Adjacency graph = graph_of(300 * 40, rectangle_edges(300, 40));
  const std::vector<GraphSide> sides = separate(graph);
  expect_parted(graph, sides);
  EXPECT_LE(count_of(sides, GraphSide::Middle), 44);
  EXPECT_GE(count_of(sides, GraphSide::Left), 0.25 * graph.size());
  EXPECT_GE(count_of(sides, GraphSide::Right), 0.25 * graph.size());
}

TEST(Separator, OfWhatHasNoTwoEndsIsValid) {
  Edges star, complete;
  for (int v = 1; v < 700; ++v) star.emplace_back(0, v);
  for (int v = 0; v < 30; ++v) {
    for (int w = 0; w < v; ++w) complete.emplace_back(v, w);
  }
  for (const Adjacency& graph : {graph_of(700, star), graph_of(30, complete)}) expect_parted(graph, separate(graph));
}

double factor_work(const Adjacency& graph, const std::vector<int>& order) {
  std::vector<int> position(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) position[order[k]] = static_cast<int>(k);
  Adjacency renumbered{.start = {0}, .nodes = {}};
  for (const int v : order) {
    for (int e = graph.start[v]; e < graph.start[v + 1]; ++e) renumbered.nodes.push_back(position[graph.nodes[e]]);
    renumbered.start.push_back(static_cast<int>(renumbered.nodes.size()));
  }
  const Supernodes tree = find_supernodes(renumbered);
  double work = 0;
  for (int s = 0; s < tree.count(); ++s) work += tree.work(s);
  return work;
}

TEST(EliminationOrder, HasEveryNodeOnceAndFillsInLittle) {
  // Two meshes that do not touch, one large enough to be dissected, and a node by itself.
  const int side = 450, small = 50, count = side * side + small * small + 1;
  Edges edges = rectangle_edges(side, side);
  for (const auto& [i, j] : rectangle_edges(small, small)) edges.emplace_back(side * side + i, side * side + j);
  const Adjacency graph = graph_of(count, edges);
  std::vector<int> order = elimination_order(graph).nodes;
  EXPECT_LT(factor_work(graph, order), 2.1e9);  // minimum degree takes 2.5e9
  std::sort(order.begin(), order.end());
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(order, all);
}

}  // namespace
}  // namespace atlas_refine
