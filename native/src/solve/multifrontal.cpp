// Assembly of fronts and the solves.
#include "solve/multifrontal.h"

#include <algorithm>

#include "solve/dense_front.h"
#include "solve/front_tasks.h"

namespace atlas_refine {
namespace {

/// Adds a child's columns [begin, end) of its update, in nodes, to columns that start `offset` nodes into the parent's front.
void add_update(const double* update, std::span<const int> row_in_parent, int begin, int end, double* to, std::size_t stride,
                int offset) {
  const int count = static_cast<int>(row_in_parent.size());
  const std::size_t height = 2 * static_cast<std::size_t>(count);
  for (int j = begin; j < end; ++j) {
    const double* left = update + 2 * j * height;
    const double* right = left + height;
    double* to_left = to + 2 * (row_in_parent[j] - offset) * stride;
    double* to_right = to_left + stride;
    for (int i = j; i < count; ++i) {
      const int row = 2 * (row_in_parent[i] - offset);
      to_left[row] += left[2 * i];
      to_left[row + 1] += left[2 * i + 1];
      to_right[row] += right[2 * i];
      to_right[row + 1] += right[2 * i + 1];
    }
  }
}

}  // namespace

double* Buffer::reserve(std::size_t size) {
  if (size > size_) {
    values_.reset();
    values_ = std::make_unique_for_overwrite<double[]>(size);
    size_ = size;
  }
  return values_.get();
}

void Multifrontal::analyse(const Adjacency& graph, const std::vector<int>& slots, const std::vector<int>& order) {
  tree_ = find_supernodes(graph, order);
  work_ = 0;
  for (int s = 0; s < tree_.count(); ++s) work_ += tree_.work(s);
  panel_start_.assign(1, 0);
  for (int s = 0; s < tree_.count(); ++s)
    panel_start_.push_back(panel_start_.back() + 2 * static_cast<std::size_t>(rows(s)) * tree_.pivots(s));
  find_entries(graph, slots);
  measure_stacks();
}

void Multifrontal::find_entries(const Adjacency& graph, const std::vector<int>& slots) {
  std::vector<int> row_of(graph.size());  // in the front, by position
  entries_.clear();
  entry_start_.assign(1, 0);
  for (int s = 0; s < tree_.count(); ++s) {
    const int begin = tree_.first[s], end = tree_.first[s + 1];
    for (int k = begin; k < end; ++k) row_of[k] = k - begin;
    for (int e = tree_.row_start[s]; e < tree_.row_start[s + 1]; ++e)
      row_of[tree_.rows[e]] = end - begin + e - tree_.row_start[s];
    for (int k = begin; k < end; ++k) {
      const int node = tree_.order[k];
      for (int e = graph.start[node]; e < graph.start[node + 1]; ++e) {
        const int other = graph.nodes[e], row = tree_.position[other];
        if (row < k) continue;
        entries_.push_back({other < node ? slots[e] : ~slots[e], 2 * row_of[row] + 2 * (k - begin) * rows(s)});
      }
    }
    entry_start_.push_back(static_cast<int>(entries_.size()));
  }
}

void Multifrontal::measure_stacks() {
  odd_depth_.assign(tree_.count(), 0);
  for (int s = tree_.count() - 1; s >= 0; --s) {
    if (tree_.parent[s] >= 0) odd_depth_[s] = !odd_depth_[tree_.parent[s]];
  }
  std::array<std::size_t, 2> size = {};
  stack_sizes_ = {};
  for (int s = 0; s < tree_.count(); ++s) {
    const int parity = odd_depth_[s];
    size[parity] += update_size(s);
    stack_sizes_[parity] = std::max(stack_sizes_[parity], size[parity]);
    for (int c = tree_.child_start[s]; c < tree_.child_start[s + 1]; ++c) size[!parity] -= update_size(tree_.children[c]);
  }
}

void Multifrontal::fill_panel(int s, const BlockValues& values) {
  double* panel = values_.data() + panel_start_[s];
  const int stride = rows(s);
  std::fill(panel, values_.data() + panel_start_[s + 1], 0.0);
  for (int k = 0; k < tree_.pivots(s); ++k) {
    const Mat2& block = values.diagonal[tree_.order[tree_.first[s] + k]];
    double* to = panel + 2 * k + 2 * k * static_cast<std::size_t>(stride);
    to[0] = block(0, 0);
    to[1] = 0.5 * (block(0, 1) + block(1, 0));
    to[stride + 1] = block(1, 1);
  }
  for (int e = entry_start_[s]; e < entry_start_[s + 1]; ++e) {
    const auto [slot, target] = entries_[e];
    const Mat2& block = values.off_diagonal[slot < 0 ? ~slot : slot];
    double* to = panel + target;
    to[0] = block(0, 0);
    to[1] = slot < 0 ? block(0, 1) : block(1, 0);
    to[stride] = slot < 0 ? block(1, 0) : block(0, 1);
    to[stride + 1] = block(1, 1);
  }
}

/// One factorisation: what its threads share.
class Multifrontal::Run {
 public:
  Run(Multifrontal& factor, const BlockValues& values, const std::vector<FrontTask>& tasks)
      : factor_(factor), tree_(factor.tree_), values_(values), tasks_(tasks), outputs_(tasks.size()) {}

  /// Factors a task's supernodes with the memory of one thread.
  bool operator()(int task, int worker) {
    Worker& stacks = factor_.workers_[worker];
    stacks.size = {};
    for (int s = tasks_[task].begin; s < tasks_[task].end; ++s) {
      const bool leaves = s + 1 == tasks_[task].end;
      if (!factor_front_of(s, leaves ? outputs_[task].reserve(factor_.update_size(s)) : push(s, stacks), task, worker))
        return false;
    }
    return true;
  }

 private:
  double* push(int s, Worker& stacks) {
    const int parity = factor_.odd_depth_[s];
    double* memory = stacks.memory[parity].reserve(factor_.stack_sizes_[parity]) + stacks.size[parity];
    stacks.size[parity] += factor_.update_size(s);
    return memory;
  }

  bool factor_front_of(int s, double* update, int task, int worker) {
    factor_.fill_panel(s, values_);
    const Front front{factor_.values_.data() + factor_.panel_start_[s], factor_.rows(s), 2 * tree_.pivots(s)};
    Worker& stacks = factor_.workers_[worker];
    const int parity = !factor_.odd_depth_[s], pivots = tree_.pivots(s);
    const int first = tree_.child_start[s], last = tree_.child_start[s + 1];
    std::size_t own = 0;  // of the children's updates, on the stack
    for (int c = first; c < last; ++c) {
      if (tree_.children[c] >= tasks_[task].begin) own += factor_.update_size(tree_.children[c]);
    }
    const std::size_t bottom = stacks.size[parity] - own;
    const auto add_children = [&](bool to_panel) {
      std::size_t at = bottom;
      for (int c = first; c < last; ++c) {
        const int child = tree_.children[c];
        const bool inside = child >= tasks_[task].begin;
        Buffer* output = inside ? nullptr : &outputs_[task_of_root(child)];
        const double* from = inside ? stacks.memory[parity].data() + at : output->data();
        if (inside) at += factor_.update_size(child);
        const std::span<const int> places(tree_.row_in_parent.data() + tree_.row_start[child], tree_.below(child));
        const int split = static_cast<int>(std::lower_bound(places.begin(), places.end(), pivots) - places.begin());
        if (to_panel)
          add_update(from, places, 0, split, front.panel, front.rows, 0);
        else
          add_update(from, places, split, tree_.below(child), update, front.below(), pivots);
        if (!to_panel && !inside) *output = Buffer();
      }
    };
    add_children(true);
    if (!best_kernels().factor(front, update, stacks.packed.reserve(packed_size(front)))) return false;
    add_children(false);
    stacks.size[parity] = bottom;
    return true;
  }

  int task_of_root(int s) const {
    const auto found = std::upper_bound(tasks_.begin(), tasks_.end(), s, [](int k, const FrontTask& t) { return k < t.begin; });
    return static_cast<int>(found - tasks_.begin()) - 1;
  }

  Multifrontal& factor_;
  const Supernodes& tree_;
  const BlockValues& values_;
  const std::vector<FrontTask>& tasks_;
  std::vector<Buffer> outputs_;  // the update of each task's last front
};

bool Multifrontal::factor(const BlockValues& values, int threads) {
  values_.reserve(panel_start_.back());
  const std::vector<FrontTask> tasks = divide_fronts(tree_, threads);
  workers_.resize(std::max<std::size_t>(workers_.size(), threads));
  Run run(*this, values, tasks);
  return run_tasks(tasks, threads, [&](int task, int worker) { return run(task, worker); });
}

void Multifrontal::solve(std::span<std::vector<Vec2>* const> sides) const {
  const int n = static_cast<int>(tree_.order.size()), count = static_cast<int>(sides.size());
  int most = 0;
  for (int s = 0; s < tree_.count(); ++s) most = std::max(most, 2 * tree_.below(s));
  std::vector<std::vector<double>> x(count), below(count);
  for (int k = 0; k < count; ++k) {
    below[k].resize(most);
    for (int p = 0; p < n; ++p) x[k].insert(x[k].end(), {(*sides[k])[tree_.order[p]].x(), (*sides[k])[tree_.order[p]].y()});
  }
  std::vector<FrontSide> parts(count);
  const auto visit = [&](int s, bool forward) {
    const Front front{values_.data() + panel_start_[s], rows(s), 2 * tree_.pivots(s)};
    const int* at = tree_.rows.data() + tree_.row_start[s];
    for (int k = 0; k < count; ++k) {
      parts[k] = {x[k].data() + 2 * tree_.first[s], below[k].data()};
      for (int i = 0; i < tree_.below(s); ++i) {
        below[k][2 * i] = x[k][2 * at[i]];
        below[k][2 * i + 1] = x[k][2 * at[i] + 1];
      }
    }
    if (!forward) return best_kernels().solve_backward(front, parts);
    best_kernels().solve_forward(front, parts);
    for (int k = 0; k < count; ++k) {
      for (int i = 0; i < tree_.below(s); ++i) {
        x[k][2 * at[i]] = below[k][2 * i];
        x[k][2 * at[i] + 1] = below[k][2 * i + 1];
      }
    }
  };
  for (int s = 0; s < tree_.count(); ++s) visit(s, true);
  for (int s = tree_.count() - 1; s >= 0; --s) visit(s, false);
  for (int k = 0; k < count; ++k) {
    for (int p = 0; p < n; ++p) (*sides[k])[tree_.order[p]] = Vec2(x[k][2 * p], x[k][2 * p + 1]);
  }
}

}  // namespace atlas_refine
