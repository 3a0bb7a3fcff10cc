// LDL^T of a sparse symmetric positive definite matrix of 2x2 blocks, one block row per UV vertex.
#pragma once

#include <utility>
#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

/// Fill-reducing order by approximate minimum degree on the vertex graph, then an up-looking factorisation on blocks.
/// Analyse once per pattern; assign `diagonal` and `off_diagonal`, factor and solve as often as values change.
class BlockLdlt {
 public:
  /// `edges` are pairs of distinct nodes in any order, duplicates allowed. `last_node` (or -1) is eliminated last: a node that is
  /// coupled to a large part of the others would only disturb the ordering.
  void analyse(int node_count, const std::vector<std::pair<int, int>>& edges, int last_node = -1);

  /// Index into `off_diagonal` of the block (min(i, j), max(i, j)), -1 where the pattern has none.
  int slot(int i, int j) const;

  int node_count() const { return static_cast<int>(diagonal.size()); }

  std::vector<Mat2> diagonal;      ///< one per node
  std::vector<Mat2> off_diagonal;  ///< one per slot: rows of the smaller node, columns of the larger

  /// Adds a block of row i and column j; of the two mirrored blocks of a symmetric matrix only the one with i <= j counts.
  void add(int i, int j, const Mat2& block);

  void set_zero();

  /// False where a pivot is not positive definite; the factor is then unusable.
  bool factor();

  /// Solves in place, 2 values per node.
  void solve(std::vector<Vec2>& values) const;

 private:
  struct Entry {  // a block of the permuted upper triangle, in column order
    int row;
    int slot;
    bool transposed;
  };
  std::vector<int> minimum_degree_order(int last_node) const;
  void permute_pattern();
  void analyse_elimination_tree();

  // Pattern of the matrix, rows of smaller nodes.
  std::vector<int> row_start_;
  std::vector<int> row_nodes_;
  // Permutation: order_[k] is the node eliminated as k-th; rank_ is its inverse.
  std::vector<int> order_;
  std::vector<int> rank_;
  std::vector<int> column_start_;
  std::vector<Entry> entries_;
  std::vector<int> parent_;
  // Factor: unit lower triangle by columns.
  std::vector<int> factor_start_;
  std::vector<int> factor_rows_;
  std::vector<Mat2> factor_values_;
  std::vector<Mat2> inverse_pivots_;
  std::vector<int> factor_fill_;
  std::vector<Mat2> work_;
  std::vector<int> flag_;
  std::vector<int> reach_;
};

}  // namespace atlas_refine
