// What a search for cuts has found so far, and what of it is best.
#pragma once

#include <deque>
#include <vector>

#include "needed/cut_trials.h"
#include "placing.h"

namespace atlas_refine {

inline constexpr double kShortest = 0.02;  ///< growth added to each cut's where rates are compared: else the shortest always win
inline constexpr double kHopeless = 10;    ///< E_d that counts where the bound does not hold
inline constexpr double kLeastExcess = 1e-6;  ///< of E_d above 1
inline constexpr double kAsGood = 1.02;       ///< times the boundary: what was found first, chosen or symmetric may have more
inline constexpr double kSettled = 1e-4;      ///< of E_d: less is no gain

/// E_d, or what counts where the bound does not hold.
double loss(const Trial& trial);

/// Cuts save a part of what is lost, not a number of it: they are compared by its logarithm.
double excess(double distortion);
/// The same of stretch: E_d - 1 goes with its square.
double excess_of_stretch(double stretch);

/// What the options ask of cuts.
struct Wish {
  const RefineOptions& options;
  double growth_weight;  ///< CutTrials::growth_weight()

  bool has_limit() const { return options.max_distortion || options.max_stretch; }
  bool is_enough(const Trial& trial) const {
    return has_limit() && limits_of(options).used(trial.distortion, trial.stretch) <= 1;
  }
  /// By how much these exceed the limits, as excess(); negative where they are below them.
  double above_limits(double distortion, double stretch) const;
  double cost(const Trial& trial) const { return loss(trial) + options.seam_cost * growth_weight * trial.growth; }

  /// With a limit the least seams that keep it, else the least of distortion and what seams cost.
  bool is_better(const Trial& a, const Trial& b) const;
};

/// All that was found.
struct Outcomes {
  std::deque<SqueezedTrial> squeezed;  ///< the first without cuts
  int tried = 0;

  SqueezedTrial& best(const Wish& wish);
  /// The point of the trade-off that the options name, numbered as where that is listed.
  SqueezedTrial& point(const Wish& wish);
  /// `chosen`: what is written, one of `squeezed`.
  CutReport report(const Wish& wish, const SqueezedTrial& chosen);

 private:
  std::vector<SqueezedTrial*> front(const SqueezedTrial& chosen);
};

}  // namespace atlas_refine
