// Guided local search: charts that overlap in a box that is a little too small are moved until none does.
#pragma once

#include <cstdint>

#include "pack/layout.h"
#include "support/rng.h"

namespace atlas_refine {

/// Moves and turns charts of `layout` until no two overlap inside width x height cells. False where `work` (row words
/// compared) is used up or the search is stuck; layout is then the state of least overlap.
class Separation {
 public:
  Separation(const std::vector<GridChart>& charts, Rng rng) : charts_(charts), rng_(rng) {}

  bool run(Layout& layout, int width, int height);
  std::int64_t work() const { return work_; }
  std::int64_t budget = INT64_MAX;

 private:
  struct Pose {
    int turn;
    Cell place;
    double cost;
  };
  double pair_loss(int a, int b, int turn, const Cell& place);
  double cost_at(int chart, int turn, const Cell& place, double bound);
  Pose descend(int chart, Pose pose, int step);
  Pose best_pose(int chart);
  void move(int chart, const Pose& pose);
  double total_loss() const;
  void update_weights();
  Cell clamped(const Raster& raster, Cell place) const;

  const std::vector<GridChart>& charts_;
  Rng rng_;
  Layout* layout_ = nullptr;
  int width_ = 0;
  int height_ = 0;
  std::int64_t work_ = 0;
  std::vector<double> loss_;     ///< n x n, symmetric
  std::vector<double> weights_;  ///< n x n, symmetric
};

}  // namespace atlas_refine
