// Guided local search on overlaps: each pair's overlap has a weight that grows
// while it lasts.
#include "pack/separation.h"

#include <algorithm>
#include <cmath>

#include "pack/budget.h"

namespace atlas_refine {
namespace {

/// Passes over the overlapping charts without progress before a separation
/// gives up.
constexpr int kPatience = 60;

struct Pose {
  int turn;
  Cell place;
  double cost;
};

class Separation {
 public:
  Separation(const std::vector<GridChart>& charts, std::int64_t most_work, Rng rng, Watch& watch)
      : charts_(charts),
        n_(static_cast<int>(charts.size())),
        most_work_(budget(most_work)),
        rng_(rng),
        watch_(watch),
        loss_(n_ * n_),
        weights_(n_ * n_) {}

  bool exhausted() const { return work_ >= most_work_; }

  /// Moves and turns the charts until no two overlap inside width x height
  /// cells; false where it gives up.
  bool run(GridLayout& layout, int width, int height);

 private:
  double& loss(int a, int b) { return loss_[a * n_ + b]; }
  Cell clamped(const Raster& raster, const Cell& place) const {
    return {std::clamp(place.x, 0, width_ - raster.width), std::clamp(place.y, 0, height_ - raster.height)};
  }
  bool fits(const Raster& raster) const { return raster.width <= width_ && raster.height <= height_; }
  bool overlaps(int chart) const {
    return std::any_of(loss_.begin() + chart * n_, loss_.begin() + (chart + 1) * n_, [](double l) { return l > 0; });
  }
  bool move_inside();
  double pair_loss(int a, int b, int turn, const Cell& place);
  double cost_at(int chart, int turn, const Cell& place, double bound);
  bool random_pose(int chart, bool near, Pose& pose);
  Pose descend(int chart, Pose pose, int step);
  Pose best_pose(int chart);
  void move(int chart, const Pose& pose);
  void separate_once();
  double total_loss() const;
  void update_weights();

  const std::vector<GridChart>& charts_;
  int n_;
  std::int64_t most_work_;
  Rng rng_;
  Watch& watch_;
  std::vector<double> loss_;     ///< n x n, symmetric
  std::vector<double> weights_;  ///< n x n, symmetric
  GridLayout* layout_ = nullptr;
  int width_ = 0;
  int height_ = 0;
  std::int64_t work_ = 0;
};

/// Root of the overlap's area: a depth, so that a thin overlap counts about as
/// much as its removal costs.
double Separation::pair_loss(int a, int b, int turn, const Cell& place) {
  const Raster& one = charts_[a].rasters[turn];
  const Raster& two = charts_[b].rasters[layout_->turns[b]];
  const Cell& other = layout_->places[b];
  const int rows = std::min(place.y + one.height, other.y + two.height) - std::max(place.y, other.y);
  const int columns = std::min(place.x + one.width, other.x + two.width) - std::max(place.x, other.x);
  if (rows <= 0 || columns <= 0) return 0;
  work_ += rows * (1 + columns / 64) + 4;
  return std::sqrt(static_cast<double>(shared_cells(one, place, two, other)));
}

/// Weighted overlap of a chart in a pose, or any value >= bound once it is
/// clear that it is no less.
double Separation::cost_at(int chart, int turn, const Cell& place, double bound) {
  work_ += n_ / 4 + 1;
  double cost = 0;
  for (int other = 0; other < n_ && cost < bound; ++other) {
    if (other != chart) cost += weights_[chart * n_ + other] * pair_loss(chart, other, turn, place);
  }
  return cost;
}

/// Anywhere in the box, or near the present place; false where the turn drawn
/// does not fit.
bool Separation::random_pose(int chart, bool near, Pose& pose) {
  const auto& rasters = charts_[chart].rasters;
  pose.turn = rng_.below(static_cast<int>(rasters.size()));
  const Raster& raster = rasters[pose.turn];
  if (!fits(raster)) return false;
  if (!near) {
    pose.place.x = rng_.below(width_ - raster.width + 1);
    pose.place.y = rng_.below(height_ - raster.height + 1);
    return true;
  }
  const Raster& present = rasters[layout_->turns[chart]];
  const auto shifted = [&](int place, int old_size, int size) {
    const int reach = std::max(2, size / 3);
    return place + (old_size - size) / 2 + rng_.below(2 * reach + 1) - reach;
  };
  pose.place.x = shifted(layout_->places[chart].x, present.width, raster.width);
  pose.place.y = shifted(layout_->places[chart].y, present.height, raster.height);
  pose.place = clamped(raster, pose.place);
  return true;
}

Pose Separation::descend(int chart, Pose pose, int step) {
  static constexpr int kDx[] = {1, -1, 0, 0, 1, -1, 1, -1}, kDy[] = {0, 0, 1, -1, 1, -1, -1, 1};
  const Raster& raster = charts_[chart].rasters[pose.turn];
  while (step >= 1 && pose.cost > 0) {
    const int start = rng_.below(8);
    bool moved = false;
    for (int k = start; k < start + 8 && !moved; ++k) {
      const Cell place = clamped(raster, {pose.place.x + step * kDx[k % 8], pose.place.y + step * kDy[k % 8]});
      if (place.x == pose.place.x && place.y == pose.place.y) continue;
      const double cost = cost_at(chart, pose.turn, place, pose.cost);
      moved = cost < pose.cost;
      if (moved) pose = {pose.turn, place, cost};
    }
    if (!moved) step /= 2;
  }
  return pose;
}

/// Samples poses, and descends from the best few of them and from the present
/// one.
Pose Separation::best_pose(int chart) {
  constexpr int kAnywhere = 40, kNear = 10;
  constexpr size_t kKept = 3;
  std::vector<Pose> kept;
  for (int k = 0; k < kAnywhere + kNear; ++k) {
    Pose pose;
    if (!random_pose(chart, k >= kAnywhere, pose)) continue;
    const double bound = kept.size() < kKept ? INFINITY : kept.back().cost;
    pose.cost = cost_at(chart, pose.turn, pose.place, bound);
    if (pose.cost >= bound) continue;
    if (kept.size() == kKept) kept.pop_back();
    kept.insert(std::upper_bound(kept.begin(), kept.end(), pose, [](const Pose& a, const Pose& b) { return a.cost < b.cost; }),
                pose);
  }
  const int turn = layout_->turns[chart];
  const Cell place = layout_->places[chart];
  Pose best = descend(chart, {turn, place, cost_at(chart, turn, place, INFINITY)}, 4);
  for (const Pose& pose : kept) {
    const Raster& raster = charts_[chart].rasters[pose.turn];
    const Pose refined = descend(chart, pose, std::max(1, std::min(raster.width, raster.height) / 8));
    if (refined.cost < best.cost) best = refined;
  }
  return best;
}

void Separation::move(int chart, const Pose& pose) {
  layout_->turns[chart] = pose.turn;
  layout_->places[chart] = pose.place;
  for (int other = 0; other < n_; ++other) {
    if (other != chart) loss(chart, other) = loss(other, chart) = pair_loss(chart, other, pose.turn, pose.place);
  }
}

/// One pass over the charts that overlap, in random order.
void Separation::separate_once() {
  std::vector<int> order;
  for (int chart = 0; chart < n_; ++chart) {
    if (overlaps(chart)) order.push_back(chart);
  }
  for (int k = static_cast<int>(order.size()) - 1; k > 0; --k) std::swap(order[k], order[rng_.below(k + 1)]);
  for (const int chart : order) {
    watch_.poll(static_cast<double>(work_) / most_work_);
    if (overlaps(chart)) move(chart, best_pose(chart));
  }
}

double Separation::total_loss() const {
  double total = 0;
  for (const double l : loss_) total += l;
  return total;
}

void Separation::update_weights() {
  const double largest = *std::max_element(loss_.begin(), loss_.end());
  for (size_t k = 0; k < loss_.size(); ++k) {
    weights_[k] = loss_[k] > 0 ? weights_[k] * (1.2 + 0.8 * loss_[k] / largest) : std::max(1.0, weights_[k] * 0.95);
  }
}

/// False where a chart is too large for the box in all its turns.
bool Separation::move_inside() {
  for (int chart = 0; chart < n_; ++chart) {
    const auto& rasters = charts_[chart].rasters;
    int& turn = layout_->turns[chart];
    if (!fits(rasters[turn])) {
      const auto fitting = std::find_if(rasters.begin(), rasters.end(), [&](const Raster& raster) { return fits(raster); });
      if (fitting == rasters.end()) return false;
      turn = static_cast<int>(fitting - rasters.begin());
    }
    layout_->places[chart] = clamped(rasters[turn], layout_->places[chart]);
  }
  return true;
}

bool Separation::run(GridLayout& layout, int width, int height) {
  layout_ = &layout;
  width_ = width;
  height_ = height;
  work_ += 10000;  // so that boxes too small for a chart come to an end, too
  if (!move_inside()) return false;
  std::fill(loss_.begin(), loss_.end(), 0.0);
  std::fill(weights_.begin(), weights_.end(), 1.0);
  for (int chart = 0; chart < n_; ++chart) move(chart, {layout.turns[chart], layout.places[chart], 0});
  double least = total_loss();
  for (int stalled = 0; least > 0 && stalled < kPatience && !exhausted(); ++stalled) {
    separate_once();
    const double total = total_loss();
    if (total < 0.98 * least) stalled = 0;
    least = std::min(least, total);
    update_weights();
  }
  return least == 0;
}

void measure_box(const std::vector<GridChart>& charts, GridLayout& layout) {
  layout.width = layout.height = 0;
  for (size_t i = 0; i < charts.size(); ++i) {
    const Raster& raster = charts[i].rasters[layout.turns[i]];
    layout.width = std::max(layout.width, layout.places[i].x + raster.width);
    layout.height = std::max(layout.height, layout.places[i].y + raster.height);
  }
}

/// A box smaller by the fraction `shrink`: of the aspect, or narrower on one
/// side.
Cell smaller_box(const GridLayout& layout, double aspect, double shrink, Rng& rng) {
  if (aspect > 0) {
    const Vec2 size = (1 - 0.5 * shrink) * box_of_aspect({Vec2::Zero(), Vec2(layout.width, layout.height)}, aspect).size();
    return {static_cast<int>(std::ceil(size.x())) - 1, static_cast<int>(std::ceil(size.y())) - 1};
  }
  Cell box{layout.width, layout.height};
  int& side = rng.below(2) ? box.x : box.y;
  side -= std::max(1, static_cast<int>(std::lround(shrink * side)));
  return box;
}

}  // namespace

GridLayout shrink_box(const std::vector<GridChart>& charts, const GridLayout& start, const BoxGoal& goal, std::int64_t most_work,
                      std::uint64_t seed, Watch& watch) {
  constexpr int kTries = 3;
  const int n = static_cast<int>(charts.size());
  Separation separation(charts, most_work, Rng(seed, 1), watch);
  GridLayout best = start;
  double shrink = 0.01;
  int failures = 0;
  for (int round = 0; !separation.exhausted() && box_area(best.width, best.height, goal.aspect) > goal.enough; ++round) {
    Rng rng(seed, 2, round);
    GridLayout trial = best;
    const Cell box = smaller_box(best, goal.aspect, shrink, rng);
    if (failures > 0) {
      for (int swaps = 1 + rng.below(2); swaps > 0; --swaps) std::swap(trial.places[rng.below(n)], trial.places[rng.below(n)]);
    }
    if (box.x > 0 && box.y > 0 && separation.run(trial, box.x, box.y)) {
      measure_box(charts, trial);
      best = std::move(trial);
      failures = 0;
    } else if (++failures > kTries) {
      shrink = std::max(0.001, 0.5 * shrink);
      failures = 1;
    }
  }
  return best;
}

}  // namespace atlas_refine
