// Guided local search on overlaps: each pair's overlap has a weight that grows while it lasts.
#include "pack/separation.h"

#include <algorithm>
#include <cmath>

namespace atlas_refine {

Cell Separation::clamped(const Raster& raster, Cell place) const {
  return {std::clamp(place.x, 0, std::max(0, width_ - raster.width)),
          std::clamp(place.y, 0, std::max(0, height_ - raster.height))};
}

double Separation::pair_loss(int a, int b, int turn, const Cell& place) {
  const Raster& ra = charts_[a].rasters[turn];
  const Raster& rb = charts_[b].rasters[layout_->turns[b]];
  const Cell& pb = layout_->places[b];
  const int rows = std::min(place.y + ra.height, pb.y + rb.height) - std::max(place.y, pb.y);
  const int columns = std::min(place.x + ra.width, pb.x + rb.width) - std::max(place.x, pb.x);
  if (rows <= 0 || columns <= 0) return 0;
  work_ += rows * (1 + columns / 64) + 4;
  const int count = shared_cells(ra, place, rb, pb);
  if (count == 0) return 0;
  return std::sqrt(count);
}

double Separation::cost_at(int chart, int turn, const Cell& place, double bound) {
  const int n = static_cast<int>(charts_.size());
  double cost = 0;
  work_ += n / 4 + 1;
  for (int other = 0; other < n && cost < bound; ++other) {
    if (other != chart) cost += weights_[chart * n + other] * pair_loss(chart, other, turn, place);
  }
  return cost;
}

Separation::Pose Separation::descend(int chart, Pose pose, int step) {
  const Raster& raster = charts_[chart].rasters[pose.turn];
  while (step >= 1 && pose.cost > 0) {
    static constexpr int kDx[] = {1, -1, 0, 0, 1, -1, 1, -1}, kDy[] = {0, 0, 1, -1, 1, -1, -1, 1};
    const int start = rng_.below(8);
    bool moved = false;
    for (int k = 0; k < 8 && !moved; ++k) {
      const int d = (start + k) % 8;
      const Cell place = clamped(raster, {pose.place.x + step * kDx[d], pose.place.y + step * kDy[d]});
      if (place.x == pose.place.x && place.y == pose.place.y) continue;
      const double cost = cost_at(chart, pose.turn, place, pose.cost);
      if (cost < pose.cost) {
        pose.place = place;
        pose.cost = cost;
        moved = true;
      }
    }
    if (!moved) step /= 2;
  }
  return pose;
}

Separation::Pose Separation::best_pose(int chart) {
  const auto& rasters = charts_[chart].rasters;
  const int turns = static_cast<int>(rasters.size());
  std::vector<Pose> kept;
  const size_t keep = 3;
  const int global = 40, local = 10;
  const int here = layout_->turns[chart];
  const Cell centre{layout_->places[chart].x + rasters[here].width / 2, layout_->places[chart].y + rasters[here].height / 2};
  const Pose current{here, layout_->places[chart], cost_at(chart, here, layout_->places[chart], INFINITY)};
  for (int k = 0; k < global + local; ++k) {
    const int turn = rng_.below(turns);
    const Raster& raster = rasters[turn];
    if (raster.width > width_ || raster.height > height_) continue;
    Cell place;
    if (k < global) {
      place = {rng_.below(width_ - raster.width + 1), rng_.below(height_ - raster.height + 1)};
    } else {
      const int reach_x = std::max(2, raster.width / 3), reach_y = std::max(2, raster.height / 3);
      place = clamped(raster, {centre.x - raster.width / 2 + rng_.below(2 * reach_x + 1) - reach_x,
                               centre.y - raster.height / 2 + rng_.below(2 * reach_y + 1) - reach_y});
    }
    const double bound = kept.size() < keep ? INFINITY : kept.back().cost;
    const double cost = cost_at(chart, turn, place, bound);
    if (cost >= bound) continue;
    const Pose pose{turn, place, cost};
    if (kept.size() == keep) kept.pop_back();
    kept.insert(std::upper_bound(kept.begin(), kept.end(), pose, [](const Pose& a, const Pose& b) { return a.cost < b.cost; }),
                pose);
  }
  Pose best = descend(chart, current, 4);
  for (const Pose& pose : kept) {
    const Raster& raster = rasters[pose.turn];
    const Pose refined = descend(chart, pose, std::max(1, std::min(raster.width, raster.height) / 8));
    if (refined.cost < best.cost) best = refined;
  }
  return best;
}

void Separation::move(int chart, const Pose& pose) {
  const int n = static_cast<int>(charts_.size());
  layout_->turns[chart] = pose.turn;
  layout_->places[chart] = pose.place;
  for (int other = 0; other < n; ++other) {
    if (other == chart) continue;
    loss_[chart * n + other] = loss_[other * n + chart] = pair_loss(chart, other, pose.turn, pose.place);
  }
}

double Separation::total_loss() const {
  const int n = static_cast<int>(charts_.size());
  double total = 0;
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b < a; ++b) total += loss_[a * n + b];
  }
  return total;
}

void Separation::update_weights() {
  const double largest = *std::max_element(loss_.begin(), loss_.end());
  for (size_t k = 0; k < loss_.size(); ++k) {
    weights_[k] = loss_[k] > 0 ? weights_[k] * (1.2 + 0.8 * loss_[k] / largest) : std::max(1.0, weights_[k] * 0.95);
  }
}

bool Separation::run(Layout& layout, int width, int height) {
  const int n = static_cast<int>(charts_.size());
  layout_ = &layout;
  work_ += 10000;
  width_ = width;
  height_ = height;
  loss_.assign(static_cast<size_t>(n) * n, 0);
  weights_.assign(static_cast<size_t>(n) * n, 1);
  for (int chart = 0; chart < n; ++chart) {
    if (charts_[chart].rasters[layout.turns[chart]].width > width ||
        charts_[chart].rasters[layout.turns[chart]].height > height) {
      bool fits = false;
      for (size_t t = 0; t < charts_[chart].rasters.size() && !fits; ++t) {
        if (charts_[chart].rasters[t].width <= width && charts_[chart].rasters[t].height <= height)
          layout.turns[chart] = t, fits = true;
      }
      if (!fits) return false;
    }
    layout.places[chart] = clamped(charts_[chart].rasters[layout.turns[chart]], layout.places[chart]);
  }
  for (int chart = 0; chart < n; ++chart) move(chart, {layout.turns[chart], layout.places[chart], 0});
  double least = total_loss();
  const int patience = 60;
  std::vector<int> order;
  for (int stalled = 0; stalled < patience && work_ < budget; ++stalled) {
    if (least == 0) return true;
    order.clear();
    for (int a = 0; a < n; ++a) {
      for (int b = 0; b < n; ++b) {
        if (loss_[a * n + b] > 0) {
          order.push_back(a);
          break;
        }
      }
    }
    for (int k = static_cast<int>(order.size()) - 1; k > 0; --k) std::swap(order[k], order[rng_.below(k + 1)]);
    for (const int chart : order) {
      bool overlaps = false;
      for (int b = 0; b < n && !overlaps; ++b) overlaps = loss_[chart * n + b] > 0;
      if (overlaps) move(chart, best_pose(chart));
    }
    const double total = total_loss();
    if (total < 0.98 * least) stalled = 0;
    least = std::min(least, total);
    update_weights();
  }
  return least == 0;
}

}  // namespace atlas_refine
