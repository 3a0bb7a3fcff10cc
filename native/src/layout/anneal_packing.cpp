// Simulated annealing of a rectangle packing on sequence pairs.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "layout/pack_rectangles.h"
#include "measure/distortion.h"

namespace atlas_refine {
namespace {

constexpr double kHot = 0.02, kCold = 2e-4;  // accepted growth of the box's area, relative, at first and at last
constexpr double kTie = 1e-9;                // of the area: the same packing but for rounding

/// a lies left of b where a comes before b in both sequences, below b where it comes later in the first and earlier in the
/// second.
struct SequencePair {
  std::vector<int> first, second;
  std::vector<char> turned;
};

Vec2 turned_size(const Vec2& size, char turned) { return turned ? Vec2(size.y(), size.x()) : size; }

/// All in an order in which each comes before those `after` it; shorter where these go in circles.
std::vector<int> sorted_topologically(const std::vector<std::vector<int>>& after) {
  std::vector<int> before(after.size(), 0), order;
  for (const std::vector<int>& all : after) {
    for (int b : all) ++before[b];
  }
  for (int r = 0; r < static_cast<int>(after.size()); ++r) {
    if (before[r] == 0) order.push_back(r);
  }
  for (std::size_t k = 0; k < order.size(); ++k) {
    for (int b : after[order[k]]) {
      if (--before[b] == 0) order.push_back(b);
    }
  }
  return order;
}

/// How a and b lie in a packing; rectangles that are apart in both ways count as beside each other.
enum class Relation { None, LeftOf, Below };
Relation relation(const RectanglePacking& packing, const std::vector<Vec2>& sizes, int a, int b) {
  constexpr double kTouch = 1e-9;
  const Vec2 end = packing.positions[a] + turned_size(sizes[a], packing.turned[a]);
  const bool left = end.x() <= packing.positions[b].x() + kTouch * end.x();
  const bool right = packing.positions[b].x() + turned_size(sizes[b], packing.turned[b]).x() <=
                     packing.positions[a].x() * (1 + kTouch) + kTouch * end.x();
  if (left && !(right && b < a)) return Relation::LeftOf;
  const bool below = end.y() <= packing.positions[b].y() + kTouch * end.y();
  return !right && below ? Relation::Below : Relation::None;
}

/// Before in the first sequence: left of or above; in the second: left of or below.
SequencePair pair_of(const RectanglePacking& packing, const std::vector<Vec2>& sizes) {
  const int n = static_cast<int>(sizes.size());
  std::vector<std::vector<int>> after_first(n), after_second(n);
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b < n; ++b) {
      const Relation how = a == b ? Relation::None : relation(packing, sizes, a, b);
      if (how == Relation::None) continue;
      after_second[a].push_back(b);
      if (how == Relation::LeftOf)
        after_first[a].push_back(b);
      else
        after_first[b].push_back(a);
    }
  }
  SequencePair pair{sorted_topologically(after_first), sorted_topologically(after_second), packing.turned};
  if (pair.first.size() != sizes.size() || pair.second.size() != sizes.size()) {
    pair.first.resize(n);
    std::iota(pair.first.begin(), pair.first.end(), 0);
    pair.second = pair.first;
  }
  return pair;
}

void move(std::vector<int>& sequence, int from, int to) {
  if (from < to)
    std::rotate(sequence.begin() + from, sequence.begin() + from + 1, sequence.begin() + to + 1);
  else
    std::rotate(sequence.begin() + to, sequence.begin() + from, sequence.begin() + from + 1);
}

void change(SequencePair& pair, Rng& rng) {
  const int n = static_cast<int>(pair.first.size());
  const int a = rng.below(n), b = rng.below(n);
  const double what = rng.uniform();
  if (what < 0.25) {
    pair.turned[a] = !pair.turned[a];
  } else if (what < 0.5) {
    std::swap(pair.first[a], pair.first[b]);
  } else if (what < 0.75) {
    move(pair.first, a, b);
    if (what < 0.6) move(pair.second, rng.below(n), rng.below(n));
  } else {
    const int p = pair.first[a], q = pair.first[b];
    std::swap(pair.first[a], pair.first[b]);
    std::swap(*std::find(pair.second.begin(), pair.second.end(), p), *std::find(pair.second.begin(), pair.second.end(), q));
  }
}

/// Compacts rectangles to the left and down as a sequence pair has them.
class Compaction {
 public:
  Compaction(const std::vector<Vec2>& sizes, double padding, double box_aspect)
      : positions(sizes.size()), sizes_(sizes), place_(sizes.size()), padding_(padding), box_aspect_(box_aspect) {}

  /// Fills positions and box; returns the box's area.
  double run(const SequencePair& pair) {
    const int n = static_cast<int>(sizes_.size());
    for (int k = 0; k < n; ++k) place_[pair.first[k]] = k;
    Vec2 extent = Vec2::Zero();
    for (int k = 0; k < n; ++k) {
      const int r = pair.second[k];
      Vec2 at = Vec2::Zero();
      for (int j = 0; j < k; ++j) {
        const int other = pair.second[j];
        const Vec2 end = positions[other] + turned_size(sizes_[other], pair.turned[other]);
        if (place_[other] < place_[r])
          at.x() = std::max(at.x(), end.x());
        else
          at.y() = std::max(at.y(), end.y());
      }
      positions[r] = at;
      extent = extent.cwiseMax(at + turned_size(sizes_[r], pair.turned[r]));
    }
    box = box_of_aspect({Vec2::Zero(), extent - Vec2::Constant(padding_)}, box_aspect_).size();
    return box.prod();
  }

  std::vector<Vec2> positions;
  Vec2 box = Vec2::Zero();

 private:
  const std::vector<Vec2>& sizes_;
  std::vector<int> place_;  // in the first sequence
  double padding_, box_aspect_;
};

}  // namespace

RectanglePacking anneal_packing(const std::vector<Vec2>& sizes, double padding, double box_aspect, RectanglePacking start,
                                int iterations, Rng& rng) {
  if (sizes.size() < 2) return start;
  std::vector<Vec2> padded;
  for (const Vec2& s : sizes) padded.push_back(s + Vec2::Constant(padding));
  Compaction compaction(padded, padding, box_aspect);
  SequencePair present = pair_of(start, padded), trial;
  RectanglePacking best = std::move(start);
  double best_area = best.box.prod();
  double area = std::min(compaction.run(present), best_area);
  for (int k = 0; k < iterations; ++k) {
    const double heat = kHot * std::pow(kCold / kHot, static_cast<double>(k) / iterations);
    // The threshold first: what it forbids need not be copied.
    const double limit = area * (1 - heat * std::log(1 - rng.uniform()));
    trial = present;
    change(trial, rng);
    const double trial_area = compaction.run(trial);
    if (trial_area > limit) continue;
    area = trial_area;
    std::swap(present, trial);
    if (area >= best_area * (1 - kTie)) continue;
    best_area = area;
    best = {compaction.positions, present.turned, compaction.box};
  }
  return best;
}

}  // namespace atlas_refine
