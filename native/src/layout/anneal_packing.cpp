// Simulated annealing of a rectangle packing on sequence pairs.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "layout/pack_rectangles.h"

namespace atlas_refine {
namespace {

constexpr double kHot = 0.02, kCold = 2e-4;  // accepted growth of the box's area, relative, at first and at last

/// a lies left of b where a comes before b in both sequences, below b where it comes later in the first and earlier in the
/// second.
struct SequencePair {
  std::vector<int> first, second;
  std::vector<char> turned;
};

class Annealer {
 public:
  Annealer(const std::vector<Vec2>& sizes, double padding, double aspect) : padding_(padding), aspect_(aspect) {
    for (const Vec2& s : sizes) sizes_.push_back(s + Vec2::Constant(padding));
    positions_.resize(sizes.size());
    place_.resize(sizes.size());
  }

  RectanglePacking run(const RectanglePacking& start, int iterations, Rng& rng) {
    SequencePair present = pair_of(start);
    double area = std::min(evaluate(present), start.box.prod());
    double best_area = start.box.prod();
    RectanglePacking best = start;
    for (int k = 0; k < iterations; ++k) {
      const double heat = kHot * std::pow(kCold / kHot, static_cast<double>(k) / iterations);
      // The threshold first: what it forbids need not be copied.
      const double limit = area * (1 - heat * std::log(1 - rng.uniform()));
      SequencePair& trial = trial_;
      trial = present;
      change(trial, rng);
      const double trial_area = evaluate(trial);
      if (trial_area > limit) continue;
      area = trial_area;
      std::swap(present, trial);
      if (area >= best_area) continue;
      best_area = area;
      best = {positions_, present.turned, box_};
    }
    return best;
  }

 private:
  Vec2 size(int r, const SequencePair& pair) const { return pair.turned[r] ? Vec2(sizes_[r].y(), sizes_[r].x()) : sizes_[r]; }

  SequencePair pair_of(const RectanglePacking& packing) const {
    const int n = static_cast<int>(sizes_.size());
    SequencePair pair{{}, {}, packing.turned};
    // Before in the first sequence: left of or above; in the second: left of or below.
    const auto sorted = [&](bool above_first) {
      std::vector<std::vector<int>> after(n);
      std::vector<int> before(n, 0), order;
      for (int a = 0; a < n; ++a) {
        for (int b = 0; b < n; ++b) {
          const Vec2 end = packing.positions[a] + size(a, pair);
          constexpr double kTouch = 1e-9;
          const bool left = end.x() <= packing.positions[b].x() + kTouch * end.x();
          const bool right =
              packing.positions[b].x() + size(b, pair).x() <= packing.positions[a].x() * (1 + kTouch) + kTouch * end.x();
          const bool below = end.y() <= packing.positions[b].y() + kTouch * end.y();
          if (a == b) continue;
          if (left && !(right && b < a)) {
            after[a].push_back(b);
            ++before[b];
          } else if (!right && below) {
            after[above_first ? b : a].push_back(above_first ? a : b);
            ++before[above_first ? a : b];
          }
        }
      }
      for (int r = 0; r < n; ++r) {
        if (before[r] == 0) order.push_back(r);
      }
      for (std::size_t k = 0; k < order.size(); ++k) {
        for (int b : after[order[k]]) {
          if (--before[b] == 0) order.push_back(b);
        }
      }
      return order;
    };
    pair.first = sorted(true);
    pair.second = sorted(false);
    if (pair.first.size() != sizes_.size() || pair.second.size() != sizes_.size()) {
      pair.first.resize(n);
      std::iota(pair.first.begin(), pair.first.end(), 0);
      pair.second = pair.first;
    }
    return pair;
  }

  static void change(SequencePair& pair, Rng& rng) {
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
  static void move(std::vector<int>& sequence, int from, int to) {
    if (from < to)
      std::rotate(sequence.begin() + from, sequence.begin() + from + 1, sequence.begin() + to + 1);
    else
      std::rotate(sequence.begin() + to, sequence.begin() + from, sequence.begin() + from + 1);
  }

  /// Compacts to the left and down; fills positions_ and box_, returns its area.
  double evaluate(const SequencePair& pair) {
    const int n = static_cast<int>(sizes_.size());
    for (int k = 0; k < n; ++k) place_[pair.first[k]] = k;
    Vec2 extent = Vec2::Zero();
    for (int k = 0; k < n; ++k) {
      const int r = pair.second[k];
      Vec2 at = Vec2::Zero();
      for (int j = 0; j < k; ++j) {
        const int other = pair.second[j];
        const Vec2 end = positions_[other] + size(other, pair);
        if (place_[other] < place_[r])
          at.x() = std::max(at.x(), end.x());
        else
          at.y() = std::max(at.y(), end.y());
      }
      positions_[r] = at;
      extent = extent.cwiseMax(at + size(r, pair));
    }
    box_ = extent - Vec2::Constant(padding_);
    if (aspect_ > 0) {
      const double height = std::max(box_.y(), box_.x() / aspect_);
      box_ = {aspect_ * height, height};
    }
    return box_.prod();
  }

  double padding_, aspect_;
  std::vector<Vec2> sizes_, positions_;
  std::vector<int> place_;
  SequencePair trial_;
  Vec2 box_ = Vec2::Zero();
};

}  // namespace

RectanglePacking anneal_packing(const std::vector<Vec2>& sizes, double padding, double box_aspect, RectanglePacking start,
                                int iterations, Rng& rng) {
  if (sizes.size() < 2) return start;
  return Annealer(sizes, padding, box_aspect).run(start, iterations, rng);
}

}  // namespace atlas_refine
