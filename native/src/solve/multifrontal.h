// Multifrontal Cholesky factor of 2x2 blocks: every supernode is a dense front, which adds its update to its parent's.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "geometry/chart.h"
#include "solve/dense_front.h"
#include "solve/front_tasks.h"
#include "solve/supernodes.h"

namespace atlas_refine {

/// Values of a symmetric matrix: one block per node, and one per pair of nodes with the smaller node's rows.
struct BlockValues {
  std::span<const Mat2> diagonal;
  std::span<const Mat2> off_diagonal;
};

/// Memory that is written before it is read.
class Buffer {
 public:
  /// At least `size` values; what was there is lost where it has to grow.
  double* reserve(std::size_t size);
  double* data() const { return values_.get(); }

 private:
  std::unique_ptr<double[]> values_;
  std::size_t size_ = 0;
};

/// The factor of one pattern. Children are added to a front in one order, whoever factored them: the bits do not depend on the
/// number of threads.
class Multifrontal {
 public:
  /// The pattern by columns in an order that fills little, `order[k]` the node of column k. `slots` are parallel to graph.nodes:
  /// the block whose rows are the neighbour's, ~slot where it is stored transposed.
  void analyse(const Adjacency& graph, const std::vector<int>& slots, const std::vector<int>& order);

  /// Multiplications of one factorisation, in blocks.
  double work() const { return work_; }

  /// The nodes in the order of their elimination: one with the same fill as that given to `analyse`.
  const std::vector<int>& order() const { return order_; }

  /// False where a pivot is not positive; the factor is then unusable.
  bool factor(const BlockValues& values, int threads);

  /// Solves for one or two right-hand sides in place, 2 values per node, on the threads that factored.
  void solve(std::span<std::vector<Vec2>* const> sides) const;

 private:
  struct Entry {  // a block below the diagonal of a panel
    int slot;     // ~slot where it is transposed
    int target;   // of its first value, in the panel
  };
  /// Memory of one thread: two stacks of updates, by the parity of depth, so that a front's own lies on one while its children's
  /// are on top of the other; and scratch.
  struct Worker {
    std::array<Buffer, 2> memory;
    std::array<std::size_t, 2> size = {};
    std::vector<std::pair<int, const double*>> children;  // of one front, and their updates
    Buffer packed;
  };
  class Run;
  class Sides;

  void find_entries(const Adjacency& graph, const std::vector<int>& slots);
  void measure_stacks();
  Front front(int s) const { return {values_.data() + panel_start_[s], rows(s), 2 * tree_.pivots(s)}; }
  int rows(int s) const { return 2 * (tree_.pivots(s) + tree_.below(s)); }
  std::size_t update_size(int s) const { return 4 * static_cast<std::size_t>(tree_.below(s)) * tree_.below(s); }
  void fill_panel(int s, const BlockValues& values);

  Supernodes tree_;
  std::vector<int> order_;
  double work_ = 0;
  std::vector<char> odd_depth_;           // of supernodes
  std::vector<std::size_t> panel_start_;  // of supernodes, in values_
  std::vector<int> entry_start_;
  std::vector<Entry> entries_;
  Buffer values_;
  std::array<std::size_t, 2> stack_sizes_ = {};
  std::vector<FrontTask> tasks_;
  int threads_ = 1;
  std::vector<Worker> workers_;  // keep their memory for the next factorisation
};

}  // namespace atlas_refine
