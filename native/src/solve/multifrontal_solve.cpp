// Solves with the factor: up the tree, where each front passes on what it takes off the rows below it, and down again.
#include <algorithm>

#include "solve/multifrontal.h"

namespace atlas_refine {
namespace {

std::vector<double> gathered(const std::vector<Vec2>& values, const std::vector<int>& order) {
  std::vector<double> out;
  out.reserve(2 * order.size());
  for (const int node : order) out.insert(out.end(), {values[node].x(), values[node].y()});
  return out;
}

void scatter(const std::vector<double>& from, const std::vector<int>& order, std::vector<Vec2>& values) {
  for (std::size_t k = 0; k < order.size(); ++k) values[order[k]] = {from[2 * k], from[2 * k + 1]};
}

}  // namespace

/// Right-hand sides in the order of elimination, and what each front holds at its rows below.
class Multifrontal::Sides {
 public:
  Sides(const Multifrontal& factor, std::span<std::vector<Vec2>* const> sides) : factor_(factor), tree_(factor.tree_) {
    for (const std::vector<Vec2>* side : sides) {
      x_.push_back(gathered(*side, factor.order_));
      below_.emplace_back(2 * tree_.rows.size());
    }
  }

  void forward(int s) {
    for (std::size_t k = 0; k < x_.size(); ++k) {
      for (int c = tree_.child_start[s]; c < tree_.child_start[s + 1]; ++c) add_child(tree_.children[c], s, x_[k], below_[k]);
    }
    std::array<FrontSide, 2> parts;
    best_kernels().solve_forward(factor_.front(s), parts_of(s, parts));
  }

  void backward(int s) {
    for (std::size_t k = 0; k < x_.size(); ++k) {
      for (int e = tree_.row_start[s]; e < tree_.row_start[s + 1]; ++e) {
        below_[k][2 * e] = x_[k][2 * tree_.rows[e]];
        below_[k][2 * e + 1] = x_[k][2 * tree_.rows[e] + 1];
      }
    }
    std::array<FrontSide, 2> parts;
    best_kernels().solve_backward(factor_.front(s), parts_of(s, parts));
  }

  const std::vector<double>& solution(std::size_t side) const { return x_[side]; }

 private:
  void add_child(int child, int s, std::vector<double>& x, std::vector<double>& below) const {
    const int pivots = tree_.pivots(s);
    for (int e = tree_.row_start[child]; e < tree_.row_start[child + 1]; ++e) {
      const int place = tree_.row_in_parent[e];
      double* to = place < pivots ? &x[2 * (tree_.first[s] + place)] : &below[2 * (tree_.row_start[s] + place - pivots)];
      to[0] += below[2 * e];
      to[1] += below[2 * e + 1];
    }
  }

  std::span<const FrontSide> parts_of(int s, std::array<FrontSide, 2>& parts) {
    for (std::size_t k = 0; k < x_.size(); ++k)
      parts[k] = {x_[k].data() + 2 * tree_.first[s], below_[k].data() + 2 * tree_.row_start[s]};
    return std::span(parts).first(x_.size());
  }

  const Multifrontal& factor_;
  const Supernodes& tree_;
  std::vector<std::vector<double>> x_, below_;
};

void Multifrontal::solve(std::span<std::vector<Vec2>* const> sides) const {
  Sides parts(*this, sides);
  run_tasks_up(tasks_, threads_, [&](int task, int) {
    for (int s = tasks_[task].begin; s < tasks_[task].end; ++s) parts.forward(s);
    return true;
  });
  run_tasks_down(tasks_, threads_, [&](int task, int) {
    for (int s = tasks_[task].end - 1; s >= tasks_[task].begin; --s) parts.backward(s);
    return true;
  });
  for (std::size_t k = 0; k < sides.size(); ++k) scatter(parts.solution(k), order_, *sides[k]);
}

}  // namespace atlas_refine
