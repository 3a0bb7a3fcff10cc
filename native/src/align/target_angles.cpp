// The cyclic shortest path over labels.
#include "align/target_angles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace atlas_refine {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr int kReach = 3;  // labels on either side of an edge's own angle
constexpr int kLabels = 2 * kReach + 1;

/// Walks once round the boundary from one edge, whose label is given, and back to it.
class LabelPath {
 public:
  LabelPath(const TargetProblem& problem, int start)
      : problem_(problem), count_(static_cast<int>(problem.lengths.size())), start_(start) {
    for (int k = 0; k <= count_; ++k) {
      angle_.push_back(angle_at(k));
      base_.push_back(static_cast<int>(std::lround(angle_.back() / kQuarter)) - kReach);
    }
    find_short_segments();
  }

  /// Cost of the best labels that begin with `label` and end with label + 4; infinite where there are none.
  double solve(int label) {
    cost_.assign(count_ + 1, {});
    from_.assign(count_ + 1, {});
    for (auto& costs : cost_) costs.fill(kInfinite);
    for (auto& steps : from_) steps.fill({-1, 0});
    if (slot(0, label) < 0 || slot(count_, label + 4) < 0) return kInfinite;
    cost_[0][slot(0, label)] = edge_cost(0, label);
    for (int k = 1; k <= count_; ++k) {
      for (int s = 0; s < kLabels; ++s) relax(k, base_[k] + s, s);
    }
    return cost_[count_][slot(count_, label + 4)];
  }

  /// Labels of the edges after solve(label).
  std::vector<int> labels(int label) const {
    std::vector<int> out(count_);
    int k = count_, present = label + 4;
    while (k > 0) {
      const Step step = from_[k][slot(k, present)];
      for (int e = k; e > step.edge; --e) set_label(out, e, present);
      present = step.label;
      k = step.edge;
    }
    set_label(out, 0, present);
    return out;
  }

 private:
  struct Step {
    int edge;
    int label;
  };

  /// Step k of the walk is edge start + k; after a whole turn angles are 2 pi larger.
  double angle_at(int k) const {
    const int i = start_ + k;
    return problem_.angle_rad[i % count_] + 2 * std::numbers::pi * (i / count_);
  }
  double length_at(int k) const { return problem_.lengths[(start_ + k) % count_]; }
  void set_label(std::vector<int>& out, int k, int label) const {
    if (k == count_) return;  // the start again
    const int i = start_ + k;
    out[i % count_] = label - 4 * (i / count_);
  }
  int slot(int k, int label) const {
    const int s = label - base_[k];
    return s >= 0 && s < kLabels ? s : -1;
  }
  double edge_cost(int k, int label) const {
    const double off = angle_[k] - kQuarter * label;
    return length_at(k) * off * off;
  }

  /// For each edge the last one before it such that the edges between, this one included, are long enough to be a segment.
  void find_short_segments() {
    segment_start_.assign(count_ + 1, -1);
    double length = 0;
    int first = 0;  // segment (first, k]
    for (int k = 1; k <= count_; ++k) {
      length += length_at(k);
      while (first + 1 < k && length - length_at(first + 1) >= problem_.least_segment) length -= length_at(++first);
      if (length >= problem_.least_segment) segment_start_[k] = first;
    }
  }

  /// Cheapest way to have `label` on edge k: the edge before has it too, or a whole short segment with it ends here.
  void relax(int k, int label, int s) {
    const int same = slot(k - 1, label);
    if (same >= 0) offer(k, s, cost_[k - 1][same] + edge_cost(k, label), {k - 1, label});
    // Segments that become long enough with this very edge; longer ones with the same start go on from them.
    for (int before = segment_start_[k - 1] + 1; before <= segment_start_[k]; ++before) begin_segment(before, k, label, s);
  }
  /// The edges after `before`, up to k, are a segment of their own.
  void begin_segment(int before, int k, int label, int s) {
    double segment = kInfinite;
    for (int turn = -2; turn <= 1; ++turn) {
      if (turn == 0) continue;
      const int other = slot(before, label - turn);
      if (other < 0 || cost_[before][other] == kInfinite) continue;
      if (segment == kInfinite) segment = segment_cost(before, k, label);
      offer(k, s, cost_[before][other] + segment + std::abs(turn) * problem_.corner_cost, {before, label - turn});
    }
  }
  double segment_cost(int before, int k, int label) const {
    double sum = 0;
    for (int e = before + 1; e <= k; ++e) sum += edge_cost(e, label);
    return sum;
  }
  void offer(int k, int s, double cost, const Step& step) {
    if (cost >= cost_[k][s]) return;
    cost_[k][s] = cost;
    from_[k][s] = step;
  }

  const TargetProblem& problem_;
  int count_, start_;
  std::vector<double> angle_;
  std::vector<int> base_;
  std::vector<int> segment_start_;
  std::vector<std::array<double, kLabels>> cost_;
  std::vector<std::array<Step, kLabels>> from_;
};

double misalignment(double angle) { return std::abs(angle - kQuarter * std::round(angle / kQuarter)); }

/// The middle of the longest run of edges that are well aligned: no corner is wanted there.
int calm_edge(const TargetProblem& problem) {
  const int count = static_cast<int>(problem.lengths.size());
  constexpr double kWell = std::numbers::pi / 8;
  int best = 0;
  double best_length = -1;
  for (int i = 0; i < count; ++i) {
    double length = 0;
    for (const int way : {1, -1}) {
      double side = 0;
      for (int k = 0; k < count && side < problem.least_segment; ++k) {
        const int j = ((i + way * k) % count + count) % count;
        if (misalignment(problem.angle_rad[j]) > kWell) break;
        side += problem.lengths[j];
      }
      length += std::min(side, problem.least_segment);
    }
    length -= problem.least_segment * misalignment(problem.angle_rad[i]);
    if (length <= best_length) continue;
    best_length = length;
    best = i;
  }
  return best;
}

}  // namespace

std::vector<int> target_angles(const TargetProblem& problem) {
  const int start = calm_edge(problem);
  LabelPath path(problem, start);
  const int middle = static_cast<int>(std::lround(problem.angle_rad[start] / kQuarter));
  double best = kInfinite;
  std::vector<int> labels;
  for (const int label : {middle, middle - 1, middle + 1}) {
    const double cost = path.solve(label);
    if (cost >= best) continue;
    best = cost;
    labels = path.labels(label);
  }
  return labels;
}

}  // namespace atlas_refine
