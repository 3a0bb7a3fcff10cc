// Block LDL^T: elimination tree, symbolic counts and the numeric up-looking sweep.
#include "solve/block_ldlt.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

namespace atlas_refine {

namespace {

using Lanes = double __attribute__((vector_size(32), aligned(16), may_alias));

/// work[rows[p]] -= blocks[p] * y: nine tenths of a factorisation. Wider registers where the machine has them; without fused
/// multiply-add the bits are the same.
__attribute__((target_clones("avx2", "default"))) void subtract_products(const int* rows, const Mat2* blocks, int count,
                                                                         const Mat2& y, Mat2* work) {
  const Lanes upper = {y(0, 0), y(0, 0), y(0, 1), y(0, 1)};
  const Lanes lower = {y(1, 0), y(1, 0), y(1, 1), y(1, 1)};
  for (int p = 0; p < count; ++p) {
    const double* l = blocks[p].data();
    const Lanes left = {l[0], l[1], l[0], l[1]};
    const Lanes right = {l[2], l[3], l[2], l[3]};
    *reinterpret_cast<Lanes*>(work[rows[p]].data()) -= left * upper + right * lower;
  }
}

}  // namespace

void BlockLdlt::analyse(int node_count, const std::vector<std::pair<int, int>>& edges, int last_node) {
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
  diagonal.assign(node_count, Mat2::Zero());
  off_diagonal.assign(kept, Mat2::Zero());
  order_ = minimum_degree_order(last_node);
  rank_.resize(node_count);
  for (int k = 0; k < node_count; ++k) rank_[order_[k]] = k;
  permute_pattern();
  analyse_elimination_tree();
}

int BlockLdlt::slot(int i, int j) const {
  if (i > j) std::swap(i, j);
  const auto first = row_nodes_.begin() + row_start_[i];
  const auto last = row_nodes_.begin() + row_start_[i + 1];
  const auto found = std::lower_bound(first, last, j);
  return found != last && *found == j ? static_cast<int>(found - row_nodes_.begin()) : -1;
}

void BlockLdlt::add(int i, int j, const Mat2& block) {
  if (i == j)
    diagonal[i] += block;
  else if (i < j)
    off_diagonal[slot(i, j)] += block;
}

void BlockLdlt::set_zero() {
  std::fill(diagonal.begin(), diagonal.end(), Mat2::Zero());
  std::fill(off_diagonal.begin(), off_diagonal.end(), Mat2::Zero());
}

std::vector<int> BlockLdlt::minimum_degree_order(int last_node) const {
  const int n = node_count();
  // One triangle and the diagonal, which the ordering expects, without the last node's couplings, as compressed columns.
  std::vector<int> starts(n + 1, 0), rows;
  rows.reserve(row_nodes_.size() + n);
  for (int i = 0; i < n; ++i) {
    rows.push_back(i);
    for (int k = row_start_[i]; i != last_node && k < row_start_[i + 1]; ++k) {
      if (row_nodes_[k] != last_node) rows.push_back(row_nodes_[k]);
    }
    starts[i + 1] = static_cast<int>(rows.size());
  }
  const std::vector<char> ones(rows.size(), 1);
  const Eigen::SparseMatrix<char> graph = Eigen::Map<const Eigen::SparseMatrix<char>>(
      n, n, static_cast<Eigen::Index>(rows.size()), starts.data(), rows.data(), ones.data());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Lower>(), permutation);
  std::vector<int> order(permutation.indices().data(), permutation.indices().data() + n);
  if (last_node >= 0) {
    order.erase(std::find(order.begin(), order.end(), last_node));
    order.push_back(last_node);
  }
  return order;
}

void BlockLdlt::permute_pattern() {
  const int n = node_count();
  column_start_.assign(n + 1, 0);
  for (int i = 0; i < n; ++i) {
    for (int k = row_start_[i]; k < row_start_[i + 1]; ++k) ++column_start_[std::max(rank_[i], rank_[row_nodes_[k]]) + 1];
  }
  for (int i = 0; i < n; ++i) column_start_[i + 1] += column_start_[i];
  entries_.resize(row_nodes_.size());
  std::vector<int> next(column_start_.begin(), column_start_.end() - 1);
  for (int i = 0; i < n; ++i) {
    for (int k = row_start_[i]; k < row_start_[i + 1]; ++k) {
      const int a = rank_[i];
      const int b = rank_[row_nodes_[k]];
      entries_[next[std::max(a, b)]++] = {std::min(a, b), k, a > b};
    }
  }
}

void BlockLdlt::analyse_elimination_tree() {
  const int n = node_count();
  parent_.assign(n, -1);
  flag_.assign(n, -1);
  std::vector<int> counts(n, 0);
  for (int k = 0; k < n; ++k) {
    flag_[k] = k;
    for (int e = column_start_[k]; e < column_start_[k + 1]; ++e) {
      for (int i = entries_[e].row; flag_[i] != k; i = parent_[i]) {
        if (parent_[i] < 0) parent_[i] = k;
        ++counts[i];
        flag_[i] = k;
      }
    }
  }
  factor_start_.assign(n + 1, 0);
  for (int k = 0; k < n; ++k) factor_start_[k + 1] = factor_start_[k] + counts[k];
  factor_rows_.resize(factor_start_[n]);
  factor_values_.resize(factor_start_[n]);
  inverse_pivots_.resize(n);
  factor_fill_.resize(n);
  work_.assign(n, Mat2::Zero());
  reach_.resize(n);
}

bool BlockLdlt::factor() {
  const int n = node_count();
  std::fill(flag_.begin(), flag_.end(), -1);
  std::copy(factor_start_.begin(), factor_start_.end() - 1, factor_fill_.begin());
  for (int k = 0; k < n; ++k) {
    // Scatter column k and find the columns that reach it, in an order that respects the tree.
    int top = n;
    flag_[k] = k;
    for (int e = column_start_[k]; e < column_start_[k + 1]; ++e) {
      const Entry& entry = entries_[e];
      const Mat2& value = off_diagonal[entry.slot];
      if (entry.transposed)
        work_[entry.row] += value.transpose();
      else
        work_[entry.row] += value;
      int length = 0;
      for (int i = entry.row; flag_[i] != k; i = parent_[i]) {
        reach_[length++] = i;
        flag_[i] = k;
      }
      while (length > 0) reach_[--top] = reach_[--length];
    }
    Mat2 pivot = diagonal[order_[k]];
    for (; top < n; ++top) {
      const int i = reach_[top];
      const Mat2 y = work_[i];
      work_[i].setZero();
      const int end = factor_fill_[i];
      const int begin = factor_start_[i];
      subtract_products(factor_rows_.data() + begin, factor_values_.data() + begin, end - begin, y, work_.data());
      const Mat2 l = y.transpose().lazyProduct(inverse_pivots_[i]);
      pivot.noalias() -= l.lazyProduct(y);
      factor_rows_[end] = k;
      factor_values_[end] = l;
      factor_fill_[i] = end + 1;
    }
    const double determinant = pivot(0, 0) * pivot(1, 1) - pivot(0, 1) * pivot(1, 0);
    if (!(pivot(0, 0) > 0) || !(determinant > 0) || !std::isfinite(determinant)) {
      std::fill(work_.begin(), work_.end(), Mat2::Zero());
      return false;
    }
    const double off = -0.5 * (pivot(0, 1) + pivot(1, 0));
    inverse_pivots_[k] << pivot(1, 1), off, off, pivot(0, 0);
    inverse_pivots_[k] /= determinant;
  }
  return true;
}

void BlockLdlt::solve(std::vector<Vec2>& values) const {
  const int n = node_count();
  std::vector<Vec2> x(n);
  for (int k = 0; k < n; ++k) x[k] = values[order_[k]];
  for (int k = 0; k < n; ++k) {
    const Vec2 xk = x[k];
    for (int p = factor_start_[k]; p < factor_start_[k + 1]; ++p) x[factor_rows_[p]].noalias() -= factor_values_[p] * xk;
  }
  for (int k = n - 1; k >= 0; --k) {
    Vec2 xk = inverse_pivots_[k] * x[k];
    for (int p = factor_start_[k]; p < factor_start_[k + 1]; ++p)
      xk.noalias() -= factor_values_[p].transpose() * x[factor_rows_[p]];
    x[k] = xk;
  }
  for (int k = 0; k < n; ++k) values[order_[k]] = x[k];
}

}  // namespace atlas_refine
