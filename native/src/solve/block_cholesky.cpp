// The pattern, its order, and when to look for a new one.
#include "solve/block_cholesky.h"

#include <algorithm>
#include <array>
#include <utility>

#include "solve/elimination_order.h"
#include "support/parallel.h"
#include "support/profile.h"
#include "support/thread_pool.h"

namespace atlas_refine {
namespace {

constexpr int kGrain = 16384;  // blocks that are set to zero

/// Both triangles of a pattern with its nodes renumbered, and where the blocks lie: as Multifrontal::analyse takes them.
struct Renumbered {
  Adjacency graph;
  std::vector<int> slots;
};

Renumbered renumber(const std::vector<int>& row_start, const std::vector<int>& row_nodes, const std::vector<int>& order) {
  const int n = static_cast<int>(order.size());
  std::vector<int> column(n);
  for (int k = 0; k < n; ++k) column[order[k]] = k;
  Renumbered out;
  std::vector<int>& start = out.graph.start;
  start.assign(n + 1, 0);
  for (int i = 0; i < n; ++i) {
    start[column[i] + 1] += row_start[i + 1] - row_start[i];
    for (int k = row_start[i]; k < row_start[i + 1]; ++k) ++start[column[row_nodes[k]] + 1];
  }
  for (int i = 0; i < n; ++i) start[i + 1] += start[i];
  out.graph.nodes.resize(start[n]);
  out.slots.resize(start[n]);
  std::vector<int> next(start.begin(), start.end() - 1);
  const auto add = [&](int i, int j, int slot) {
    out.slots[next[i]] = slot;
    out.graph.nodes[next[i]++] = j;
  };
  for (int i = 0; i < n; ++i) {
    for (int k = row_start[i]; k < row_start[i + 1]; ++k) {
      add(column[i], column[row_nodes[k]], ~k);
      add(column[row_nodes[k]], column[i], k);
    }
  }
  return out;
}

}  // namespace

void BlockCholesky::analyse(int node_count, std::vector<std::pair<int, int>> edges, int last_node) {
  set_pattern(node_count, std::move(edges), last_node);
  analyse_pattern();
  set_zero();
}

void BlockCholesky::set_pattern(int node_count, std::vector<std::pair<int, int>> edges, int last_node) {
  const PhaseScope scope(Phase::Order);
  diagonal = {};  // whose memory the analysis may have
  off_diagonal = {};
  list_rows(node_count, edges);
  same_nodes_ = static_cast<int>(order_.size()) == node_count && last_node_ == last_node;
  last_node_ = last_node;
}

/// In the present order where the nodes are the same and it still is good enough, else in a new one.
void BlockCholesky::analyse_pattern() {
  const PhaseScope scope(Phase::Order);
  if (same_nodes_) {
    analyse_factor();
    lost_work_ += factor_.work() - work_when_found_;
    if (lost_work_ <= order_work_) return;
  }
  factor_ = {};  // whose memory the search for an order may have
  find_order();
  analyse_factor();
  work_when_found_ = factor_.work();
  lost_work_ = 0;
}

void BlockCholesky::analyse_factor() {
  const auto [graph, slots] = renumber(row_start_, row_nodes_, order_);
  factor_.analyse(graph, slots, order_);
  order_ = factor_.order();  // what is near in the tree is then near in memory
}

void BlockCholesky::list_rows(int node_count, const std::vector<std::pair<int, int>>& edges) {
  // Bucket by the smaller node, then sort and thin out each short row.
  std::vector<int> start(node_count + 1, 0);
  for (const auto& [i, j] : edges) ++start[std::min(i, j) + 1];
  for (int i = 0; i < node_count; ++i) start[i + 1] += start[i];
  std::vector<int> fill(start.begin(), start.end() - 1);
  row_nodes_.resize(edges.size());
  for (const auto& [i, j] : edges) row_nodes_[fill[std::min(i, j)]++] = std::max(i, j);
  row_start_.assign(node_count + 1, 0);
  int kept = 0;
  for (int i = 0; i < node_count; ++i) {
    const auto first = row_nodes_.begin() + start[i], last = row_nodes_.begin() + start[i + 1];
    std::sort(first, last);
    for (auto it = first; it != last; ++it) {
      if (it == first || *it != *(it - 1)) row_nodes_[kept++] = *it;
    }
    row_start_[i + 1] = kept;
  }
  row_nodes_.resize(kept);
}

int BlockCholesky::slot(int i, int j) const {
  if (i > j) std::swap(i, j);
  const auto first = row_nodes_.begin() + row_start_[i];
  const auto last = row_nodes_.begin() + row_start_[i + 1];
  const auto found = std::lower_bound(first, last, j);
  return found != last && *found == j ? static_cast<int>(found - row_nodes_.begin()) : -1;
}

void BlockCholesky::add(int i, int j, const Mat2& block) {
  if (i == j)
    diagonal[i] += block;
  else if (i < j)
    off_diagonal[slot(i, j)] += block;
}

void BlockCholesky::set_zero() {
  diagonal.resize(row_start_.size() - 1);
  off_diagonal.resize(row_nodes_.size());
  for (std::vector<Mat2>* blocks : {&diagonal, &off_diagonal}) {
    parallel_ranges(static_cast<int>(blocks->size()), present_threads(), kGrain,
                    [&](int begin, int end) { std::fill(blocks->begin() + begin, blocks->begin() + end, Mat2::Zero()); });
  }
}

void BlockCholesky::find_order() {
  // Without the last node's couplings, which would only disturb it.
  const int n = static_cast<int>(row_start_.size()) - 1;
  Adjacency graph{.start = std::vector<int>(n + 1, 0), .nodes = {}};
  const auto for_each_edge = [&](auto&& body) {
    for (int i = 0; i < n; ++i) {
      for (int k = row_start_[i]; i != last_node_ && k < row_start_[i + 1]; ++k) {
        if (row_nodes_[k] != last_node_) body(i, row_nodes_[k]);
      }
    }
  };
  for_each_edge([&](int i, int j) {
    ++graph.start[i + 1];
    ++graph.start[j + 1];
  });
  for (int i = 0; i < n; ++i) graph.start[i + 1] += graph.start[i];
  graph.nodes.resize(graph.start[n]);
  std::vector<int> next(graph.start.begin(), graph.start.end() - 1);
  for_each_edge([&](int i, int j) {
    graph.nodes[next[i]++] = j;
    graph.nodes[next[j]++] = i;
  });
  EliminationOrder found = elimination_order(graph);
  order_ = std::move(found.nodes);
  order_work_ = found.work;
  if (last_node_ < 0) return;
  order_.erase(std::find(order_.begin(), order_.end(), last_node_));
  order_.push_back(last_node_);
}

bool BlockCholesky::factor(int threads) {
  const PhaseScope scope(Phase::Factor);
  return factor_.factor({diagonal, off_diagonal}, threads);
}

void BlockCholesky::solve(std::vector<Vec2>& values) const {
  const PhaseScope scope(Phase::Solve);
  factor_.solve(std::array{&values});
}

void BlockCholesky::solve(std::vector<Vec2>& first, std::vector<Vec2>& second) const {
  const PhaseScope scope(Phase::Solve);
  factor_.solve(std::array{&first, &second});
}

}  // namespace atlas_refine
