// What a sparse Cholesky factor looks like, from the pattern and an elimination order alone: the tree of relaxed supernodes.
#pragma once

#include <vector>

#include "solve/adjacency.h"

namespace atlas_refine {

/// Consecutive columns that are factored as one dense front, children before their parents. Positions count columns in the order
/// in which they are eliminated after all: one with the same fill as theirs.
struct Supernodes {
  std::vector<int> order;     ///< column at each position
  std::vector<int> position;  ///< of each column
  std::vector<int> first;     ///< position of each supernode's first column; then their number
  std::vector<int> parent;    ///< -1 for roots
  std::vector<int> child_start, children;
  std::vector<int> row_start;      ///< of each supernode in `rows`
  std::vector<int> rows;           ///< positions of the rows below the pivots, ascending
  std::vector<int> row_in_parent;  ///< where each of these lies in the parent's front, its pivots first

  int count() const { return static_cast<int>(parent.size()); }
  int pivots(int s) const { return first[s + 1] - first[s]; }
  int below(int s) const { return row_start[s + 1] - row_start[s]; }
  /// Multiplications of a supernode's front, in blocks.
  double work(int s) const;
};

/// Of a pattern whose columns are eliminated in the order of their numbers.
Supernodes find_supernodes(const Adjacency& graph);

}  // namespace atlas_refine
