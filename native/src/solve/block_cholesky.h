// Cholesky factor of a sparse symmetric positive definite matrix of 2x2 blocks, one block row per UV vertex.
#pragma once

#include <utility>
#include <vector>

#include "geometry/chart.h"
#include "solve/multifrontal.h"

namespace atlas_refine {

/// Analyse once per pattern; assign `diagonal` and `off_diagonal`, factor and solve as often as values change.
class BlockCholesky {
 public:
  /// `edges` are pairs of distinct nodes in any order, duplicates allowed. `last_node` (or -1) is eliminated last: a node that is
  /// coupled to a large part of the others would only disturb the ordering. Analysing a similar pattern anew keeps the order
  /// for as long as that is cheaper than finding a better one.
  void analyse(int node_count, std::vector<std::pair<int, int>> edges, int last_node = -1);

  /// The same in two parts: after the first one slots are known, and values may be set while the second one goes on.
  void set_pattern(int node_count, std::vector<std::pair<int, int>> edges, int last_node);
  void analyse_pattern();

  /// Index into `off_diagonal` of the block (min(i, j), max(i, j)), -1 where the pattern has none.
  int slot(int i, int j) const;

  int node_count() const { return static_cast<int>(diagonal.size()); }

  std::vector<Mat2> diagonal;      ///< one per node
  std::vector<Mat2> off_diagonal;  ///< one per slot: rows of the smaller node, columns of the larger

  /// Adds a block of row i and column j; of the two mirrored blocks of a symmetric matrix only the one with i <= j counts.
  void add(int i, int j, const Mat2& block);

  /// All values of the pattern.
  void set_zero();

  /// False where a pivot is not positive; the factor is then unusable. The bits do not depend on the number of threads.
  bool factor(int threads = 1);

  /// Solves in place, 2 values per node.
  void solve(std::vector<Vec2>& values) const;
  /// For two right-hand sides at once, which takes little longer than for one.
  void solve(std::vector<Vec2>& first, std::vector<Vec2>& second) const;

 private:
  void analyse_factor();
  void list_rows(int node_count, const std::vector<std::pair<int, int>>& edges);
  void find_order();

  // Pattern of the matrix, rows of smaller nodes.
  std::vector<int> row_start_ = {0};
  std::vector<int> row_nodes_;
  // The order that is kept, what finding it cost, the work of a factorisation then, and what it has cost beyond that since.
  std::vector<int> order_;
  bool same_nodes_ = false;  ///< as those that it is of
  int last_node_ = -1;
  double order_work_ = 0;
  double work_when_found_ = 0;
  double lost_work_ = 0;
  Multifrontal factor_;
};

}  // namespace atlas_refine
