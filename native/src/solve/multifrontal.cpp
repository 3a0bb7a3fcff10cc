// Analysis and factorisation.
#include "solve/multifrontal.h"

#include <algorithm>
#include <numeric>

#include "support/gathered.h"
#include "support/parallel.h"

namespace atlas_refine {
namespace {

/// A square or its first columns, by columns.
struct Columns {
  double* values;
  int stride;
};

/// Two values in one register.
void add(const double* from, double* to) { Eigen::Map<Vec2>(to) += Eigen::Map<const Vec2>(from); }

/// Adds those columns of a child's update that lie in columns [begin, end) of its parent's front, all in nodes, to columns from
/// `begin` on; rows count from there too.
void add_update(const double* update, std::span<const int> places, int begin, int end, const Columns& to) {
  const int count = static_cast<int>(places.size());
  const std::size_t height = 2 * static_cast<std::size_t>(count);
  const auto first = std::lower_bound(places.begin(), places.end(), begin);
  for (int j = static_cast<int>(first - places.begin()); j < count && places[j] < end; ++j) {
    const double* left = update + 2 * j * height;
    const double* right = left + height;
    double* to_left = to.values + 2 * (places[j] - begin) * static_cast<std::size_t>(to.stride);
    double* to_right = to_left + to.stride;
    for (int i = j; i < count; ++i) {
      const int row = 2 * (places[i] - begin);
      add(left + 2 * i, to_left + row);
      add(right + 2 * i, to_right + row);
    }
  }
}

}  // namespace

double* Buffer::reserve(std::size_t size) {
  if (size > size_) {
    values_.reset();  // before the new ones are there
    // Patterns grow by a little again and again; memory that is not written costs nothing.
    size_ = size + size / 4;
    values_ = std::make_unique_for_overwrite<double[]>(size_);
  }
  return values_.get();
}

void Multifrontal::analyse(const Adjacency& graph, const std::vector<int>& slots, const std::vector<int>& order) {
  tree_ = find_supernodes(graph);
  order_.clear();
  for (const int column : tree_.order) order_.push_back(order[column]);
  work_ = 0;
  for (int s = 0; s < tree_.count(); ++s) work_ += tree_.work(s);
  panel_start_.assign(1, 0);
  for (int s = 0; s < tree_.count(); ++s)
    panel_start_.push_back(panel_start_.back() + 2 * static_cast<std::size_t>(rows(s)) * tree_.pivots(s));
  find_entries(graph, slots);
  measure_stacks();
}

void Multifrontal::find_entries(const Adjacency& graph, const std::vector<int>& slots) {
  constexpr int kGrain = 1024;  // supernodes
  entry_start_.assign(tree_.count() + 1, 0);
  entries_ = gathered<Entry>(tree_.count(), kGrain, [&](int first, int last, std::vector<Entry>& out) {
    std::vector<int> row_of(graph.size());  // in the front, by position
    for (int s = first; s < last; ++s) {
      const std::size_t before = out.size();
      const int begin = tree_.first[s], end = tree_.first[s + 1];
      for (int k = begin; k < end; ++k) row_of[k] = k - begin;
      for (int e = tree_.row_start[s]; e < tree_.row_start[s + 1]; ++e)
        row_of[tree_.rows[e]] = end - begin + e - tree_.row_start[s];
      for (int k = begin; k < end; ++k) {
        const int column = tree_.order[k];
        for (int e = graph.start[column]; e < graph.start[column + 1]; ++e) {
          const int row = tree_.position[graph.nodes[e]];
          if (row > k) out.push_back({slots[e], 2 * row_of[row] + 2 * (k - begin) * rows(s)});
        }
      }
      entry_start_[s + 1] = static_cast<int>(out.size() - before);
    }
  });
  std::partial_sum(entry_start_.begin(), entry_start_.end(), entry_start_.begin());
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
    const Mat2& block = values.diagonal[order_[tree_.first[s] + k]];
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
  Run(Multifrontal& factor, const BlockValues& values)
      : factor_(factor), tree_(factor.tree_), values_(values), outputs_(factor.tasks_.size()) {}

  /// Factors a task's supernodes with the memory of one thread.
  bool operator()(int task, Worker& worker) {
    worker.size = {};
    const FrontTask& part = factor_.tasks_[task];
    for (int s = part.begin; s < part.end; ++s) {
      double* update = s + 1 < part.end ? push(s, worker) : outputs_[task].reserve(factor_.update_size(s));
      if (!factor_one(s, part.begin, update, worker)) return false;
    }
    return true;
  }

 private:
  double* push(int s, Worker& worker) const {
    const int parity = factor_.odd_depth_[s];
    double* memory = worker.memory[parity].reserve(factor_.stack_sizes_[parity]) + worker.size[parity];
    worker.size[parity] += factor_.update_size(s);
    return memory;
  }

  /// Where the children's updates lie: those of the task on top of its stack, which they leave, others by themselves.
  void find_updates(int s, int task_begin, Worker& worker) const {
    const int parity = !factor_.odd_depth_[s];
    worker.children.clear();
    for (int c = tree_.child_start[s + 1] - 1; c >= tree_.child_start[s]; --c) {
      const int child = tree_.children[c];
      if (child < task_begin) {
        worker.children.push_back({child, outputs_[task_of(child)].data()});
      } else {
        worker.size[parity] -= factor_.update_size(child);
        worker.children.push_back({child, worker.memory[parity].data() + worker.size[parity]});
      }
    }
    std::reverse(worker.children.begin(), worker.children.end());
  }

  bool factor_one(int s, int task_begin, double* update, Worker& worker) {
    const int pivots = tree_.pivots(s);
    const Front front = factor_.front(s);
    find_updates(s, task_begin, worker);
    factor_.fill_panel(s, values_);
    add_updates(worker, 0, pivots, {front.panel, front.rows});
    if (!best_kernels().factor(front, {update, worker.packed.reserve(packed_size(front)), factor_.threads_})) return false;
    add_updates(worker, pivots, pivots + tree_.below(s), {update, front.below()});
    for (const auto& child : worker.children) {
      if (child.first < task_begin) outputs_[task_of(child.first)] = Buffer();
    }
    return true;
  }

  /// Adds what the children have for columns [begin, end) of a front, whose columns are sums of their own.
  void add_updates(const Worker& worker, int begin, int end, const Columns& to) const {
    constexpr int kGrain = 64;  // columns of a front that may be divided, in nodes
    const auto add_to = [&](int first, int last) {
      const std::ptrdiff_t before = (2 * static_cast<std::ptrdiff_t>(to.stride) + 2) * (first - begin);
      for (const auto& [child, from] : worker.children) {
        const std::span places(tree_.row_in_parent.data() + tree_.row_start[child], tree_.below(child));
        add_update(from, places, first, last, {to.values + before, to.stride});
      }
    };
    if (factor_.threads_ == 1 || end - begin < 2 * kGrain) return add_to(begin, end);
    parallel_ranges(end - begin, factor_.threads_, kGrain, [&](int first, int last) { add_to(begin + first, begin + last); });
  }

  /// The task that ends with a supernode.
  int task_of(int s) const {
    const auto after = [](int k, const FrontTask& task) { return k < task.end; };
    return static_cast<int>(std::upper_bound(factor_.tasks_.begin(), factor_.tasks_.end(), s, after) - factor_.tasks_.begin());
  }

  Multifrontal& factor_;
  const Supernodes& tree_;
  const BlockValues& values_;
  std::vector<Buffer> outputs_;  // the update of each task's last front
};

bool Multifrontal::factor(const BlockValues& values, int threads) {
  values_.reserve(panel_start_.back());
  tasks_ = divide_fronts(tree_, threads);
  threads_ = tasks_.size() > 1 ? threads : 1;
  workers_.resize(std::max<std::size_t>(workers_.size(), threads_));
  Run run(*this, values);
  return run_tasks_up(tasks_, threads_, [&](int task, int worker) { return run(task, workers_[worker]); });
}

}  // namespace atlas_refine
