// The cyclic shortest path over labels: one walk round the boundary for each label of its first edge.
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
constexpr double kRounding = 1e-9;  // of the least segment length: sums of lengths depend on where they begin

/// One value for each label of an edge.
using Costs = std::array<double, kLabels>;

/// The boundary unrolled: edge k of the walk is boundary edge start + k, and the last is the first again, a whole turn on.
struct Walk {
  int start = 0;
  double corner_cost = 0, least_segment = 0;
  std::vector<double> angle;   // rising by 2 pi from the first edge to the last
  std::vector<double> weight;  // lengths, 0 for the last edge: the first one has paid
  std::vector<double> at;      // where each edge begins along the walk; one more entry for the end
  std::vector<int> lowest;     // label of each edge

  int last() const { return static_cast<int>(angle.size()) - 1; }
  int slot(int k, int label) const {
    const int s = label - lowest[k];
    return s >= 0 && s < kLabels ? s : -1;
  }
  double cost(int k, int label) const {
    const double off = angle[k] - kQuarter * label;
    return slot(k, label) < 0 ? kInfinite : weight[k] * off * off;
  }
};

Walk unrolled(const TargetProblem& problem, int start) {
  const int n = static_cast<int>(problem.lengths.size());
  Walk walk{start, problem.corner_cost, (1 - kRounding) * problem.least_segment, {}, {}, {0}, {}};
  for (int k = 0; k <= n; ++k) {
    const int i = start + k;
    walk.angle.push_back(problem.angle_rad[i % n] + 2 * std::numbers::pi * (i / n));
    walk.weight.push_back(k < n ? problem.lengths[i % n] : 0);
    walk.at.push_back(walk.at.back() + problem.lengths[i % n]);
    walk.lowest.push_back(static_cast<int>(std::lround(problem.angle_rad[i % n] / kQuarter)) + 4 * (i / n) - kReach);
  }
  return walk;
}

/// The shortest segment that begins at an edge.
struct ShortSegment {
  int end = 0;    // its last edge; beyond the walk's where the walk is too short
  Costs costs{};  // of all its edges, for each label of the last
};

/// Of all edges from `begin` to `end`, for each label of the last.
Costs costs_between(const Walk& walk, int begin, int end) {
  Costs costs{};
  int lowest = walk.lowest[end], highest = lowest + kLabels - 1;  // within reach of all
  for (int k = begin; k <= end; ++k) {
    lowest = std::max(lowest, walk.lowest[k]);
    highest = std::min(highest, walk.lowest[k] + kLabels - 1);
    for (int s = 0; s < kLabels; ++s) {
      const double off = walk.angle[k] - kQuarter * (walk.lowest[end] + s);
      costs[s] += walk.weight[k] * off * off;
    }
  }
  for (int s = 0; s < kLabels; ++s) {
    if (walk.lowest[end] + s < lowest || walk.lowest[end] + s > highest) costs[s] = kInfinite;
  }
  return costs;
}

std::vector<ShortSegment> short_segments(const Walk& walk) {
  std::vector<ShortSegment> out(walk.last() + 1);
  for (int begin = 0, end = 0; begin <= walk.last(); ++begin) {
    end = std::max(end, begin);
    while (end <= walk.last() && walk.at[end + 1] - walk.at[begin] < walk.least_segment) ++end;
    out[begin].end = end;
    if (end <= walk.last()) out[begin].costs = costs_between(walk, begin, end);
  }
  return out;
}

/// Where the first edge's segment may begin, seen from the walk's end.
struct Closing {
  int begin;        // its first edge
  int lasts_until;  // the edge at the walk's beginning where it is long enough
};
struct ClosingRange {
  int first, end;
};

/// The first one stands for all segments that are long enough at the first edge already: such a way round needs no closing, its
/// last edge is its first. Then, in order, one for each edge that is too near to the end for that.
std::vector<Closing> closings_of(const Walk& walk) {
  const int n = walk.last();
  int begin = n;
  while (begin > 0 && walk.at[n + 1] - walk.at[begin] < walk.least_segment) --begin;
  std::vector<Closing> out = {{begin, 0}};
  int until = 0;
  for (++begin; begin <= n; ++begin) {
    while (until < n && walk.at[n] - walk.at[begin] + walk.at[until + 1] < walk.least_segment) ++until;
    out.push_back({begin, until});
  }
  return out;
}

/// The cheapest way from the walk's first edge to every edge and label whose segment is long enough by then.
class LabelPaths {
 public:
  explicit LabelPaths(const Walk& walk) : walk_(walk), segments_(short_segments(walk)) {}

  /// Ways whose edges up to `until` have `label`; what costs `limit` or more is left out.
  void find(int label, int until, double limit) {
    cost_.assign(walk_.last() + 1, {});
    for (Costs& costs : cost_) costs.fill(kInfinite);
    from_.resize(cost_.size());
    double cost = 0;
    for (int k = 0; k <= until; ++k) cost += walk_.cost(k, label);
    if (cost < limit) offer(until, label, cost, {-1, label});
    for (int k = until; k < walk_.last(); ++k) {
      for (int s = 0; s < kLabels; ++s) {
        if (cost_[k][s] < limit) go_on(k, walk_.lowest[k] + s, cost_[k][s]);
      }
    }
  }

  /// Of the edges up to k, the last one with `label`.
  double cost(int k, int label) const {
    const int s = walk_.slot(k, label);
    return s < 0 ? kInfinite : cost_[k][s];
  }
  /// Labels of the edges up to k on that way.
  std::vector<int> labels(int k, int label) const {
    std::vector<int> out(k + 1);
    while (k >= 0) {
      const Step step = from_[k][walk_.slot(k, label)];
      for (; k > step.edge; --k) out[k] = label;
      label = step.label;
    }
    return out;
  }

 private:
  struct Step {
    int edge;
    int label;
  };

  /// From edge k: its segment goes on, or the shortest one with another label follows.
  void go_on(int k, int label, double cost) {
    offer(k + 1, label, cost + walk_.cost(k + 1, label), {k, label});
    const ShortSegment& segment = segments_[k + 1];
    if (segment.end > walk_.last()) return;
    for (const int turn : {1, -1, -2}) {
      const int s = walk_.slot(segment.end, label + turn);
      if (s < 0) continue;
      offer(segment.end, label + turn, cost + segment.costs[s] + std::abs(turn) * walk_.corner_cost, {k, label});
    }
  }
  void offer(int k, int label, double cost, const Step& step) {
    const int s = walk_.slot(k, label);
    if (s < 0 || cost >= cost_[k][s]) return;
    cost_[k][s] = cost;
    from_[k][s] = step;
  }

  const Walk& walk_;
  std::vector<ShortSegment> segments_;
  std::vector<Costs> cost_;
  std::vector<std::array<Step, kLabels>> from_;
};

/// A way all round: the paths' way to edge and label, and the closing that completes it.
struct Round {
  double cost = kInfinite;
  int closing = 0, edge = 0, label = 0;
};

/// The cheapest way round, from and back to `label`, by a closing of the range.
Round cheapest_round(const Walk& walk, const std::vector<Closing>& closings, const ClosingRange& range, const LabelPaths& paths,
                     int label) {
  Round best;
  const auto offer = [&](const Round& round) {
    if (round.cost < best.cost) best = round;
  };
  if (range.first == 0) offer({paths.cost(walk.last(), label + 4), 0, walk.last(), label + 4});
  double tail = 0;  // of the edges from the closing's first one on
  for (int c = static_cast<int>(closings.size()) - 1; c >= std::max(range.first, 1) && tail < kInfinite; --c) {
    const int before = closings[c].begin - 1;
    for (const int turn : {1, -1, -2}) {
      const double corner = std::abs(turn) * walk.corner_cost;
      if (c < range.end) offer({paths.cost(before, label + 4 - turn) + corner + tail, c, before, label + 4 - turn});
    }
    tail += walk.cost(before, label + 4);
  }
  return best;
}

/// The best labels so far.
struct Solution {
  double cost = kInfinite;
  std::vector<int> labels;  // of the walk's edges, the last one left out
};

/// All ways round from and back to `label`. Branch and bound over closings: what the first segment must last until is at first
/// taken from the least demanding one; a way whose own closing demands more splits them there.
void search_rounds(const Walk& walk, const std::vector<Closing>& closings, int label, LabelPaths& paths, Solution& best) {
  std::vector<ClosingRange> open = {{0, static_cast<int>(closings.size())}};
  while (!open.empty()) {
    const ClosingRange range = open.back();
    open.pop_back();
    paths.find(label, closings[range.first].lasts_until, best.cost);
    const Round round = cheapest_round(walk, closings, range, paths, label);
    if (round.cost >= best.cost) continue;
    std::vector<int> labels = paths.labels(round.edge, round.label);
    const auto corner = std::find_if(labels.begin(), labels.end(), [&](int other) { return other != label; });
    if (round.closing > range.first && corner - labels.begin() <= closings[round.closing].lasts_until) {
      open.push_back({range.first, round.closing});
      open.push_back({round.closing, range.end});
      continue;
    }
    labels.resize(walk.last(), label + 4);
    best = {round.cost, std::move(labels)};
  }
}

}  // namespace

std::vector<int> target_angles(const TargetProblem& problem) {
  const int n = static_cast<int>(problem.lengths.size());
  // A long first edge leaves few closings.
  const auto start = std::max_element(problem.lengths.begin(), problem.lengths.end()) - problem.lengths.begin();
  const Walk walk = unrolled(problem, static_cast<int>(start));
  const std::vector<Closing> closings = closings_of(walk);
  LabelPaths paths(walk);
  Solution best;
  for (int k = 0; k < kLabels; ++k) {
    // The likely labels first: 0, -1, 1, -2, ... off the edge's own.
    const int off = k % 2 == 0 ? k / 2 : -(k + 1) / 2;
    search_rounds(walk, closings, walk.lowest[0] + kReach + off, paths, best);
  }
  if (best.labels.empty()) return {};
  std::vector<int> labels(n);
  for (int k = 0; k < n; ++k) {
    const int i = walk.start + k;
    labels[i % n] = best.labels[k] - 4 * (i / n);
  }
  return labels;
}

}  // namespace atlas_refine
