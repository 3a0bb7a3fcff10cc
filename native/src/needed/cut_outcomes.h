// What a search for cuts has found so far, and what of it is best.
#pragma once

#include <deque>
#include <vector>

#include "needed/cut_trials.h"

namespace atlas_refine {

inline constexpr double kShortest = 0.02;  ///< growth added to each cut's where rates are compared: else the shortest always win
inline constexpr double kHopeless = 10;    ///< E_d that counts where the bound does not hold
inline constexpr double kSettled = 1e-4;   ///< of E_d: less is no gain

/// E_d, or what counts where the bound does not hold.
double loss(const Trial& trial);

/// What the options ask of cuts.
struct Wish {
  const RefineOptions& options;

  bool has_limit() const { return options.max_distortion.has_value(); }
  bool is_enough(const Trial& trial) const { return has_limit() && trial.distortion <= *options.max_distortion; }
  double cost(const Trial& trial) const { return loss(trial) + options.seam_cost * trial.growth; }

  /// With a limit the least seams that keep it, else the least of distortion and what seams cost.
  bool is_better(const Trial& a, const Trial& b) const;
};

/// All that was found.
struct Outcomes {
  std::deque<SqueezedTrial> squeezed;  ///< the first without cuts
  std::vector<Trial> forecast;         ///< those not squeezed
  std::vector<Trial> failed;           ///< forecast to hold the bound, which they do not
  int tried = 0;

  /// The same cuts may come in another order.
  bool knows(const Trial& trial) const;
  SqueezedTrial& best(const Wish& wish);
  /// Those than which no other has both less boundary and less distortion.
  std::vector<TradeOff> trade_off() const;
  /// Its end where there is none.
  std::vector<Trial>::iterator forecast_on_front();
  SqueezedTrial& point(int number);
  CutReport report(const Trial& chosen) const;
};

}  // namespace atlas_refine
