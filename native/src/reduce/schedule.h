// The engine's schedule: how fast PE may change, how firm the barrier is, how much steps are damped. Pure functions of the state.
#pragma once

namespace atlas_refine {

/// What the schedule carries from one iteration to the next.
struct Schedule {
  bool relaxing = false;  ///< the start lies above the PE target and loses distortion on the way down to it
  bool arrived = false;   ///< the target was reached: the barrier softens from then on, though that may make PE dip
  double firmness = 0;    ///< stiffness of the barrier per price and range
  double stiffness = 0;   ///< of the barrier
  double margin = 0;      ///< relative, that is kept above the target while relaxing
  double damping = 0;
};

/// What the schedule looks at. Deficit is log(target / PE), positive while the bound does not hold.
struct ScheduleView {
  bool bounded;  ///< there is a box
  double deficit;
  double energy;
  double range;
};

inline constexpr double kTargetSlack = 2e-5;  ///< aim so much above the bound, relative, that rounding cannot lose it
inline constexpr double kMostDamping = 1e8;
/// Without a box, where needles may need more; in one it would crush charts that jam.
inline constexpr double kMostDampingAlone = 1e16;
inline constexpr double kMostMargin = 0.006;  ///< the margin a relaxing start begins with

/// `slack` is the smallest slack of any contact, read while relaxing only.
Schedule first_schedule(bool relaxing, const ScheduleView& view, double slack);

/// Of a start that is at its target, where the barrier was soft at this price.
Schedule warm_schedule(double price, const ScheduleView& view);

/// log PE may gain at most this much in one iteration below the target.
double largest_climb(double deficit);
/// log PE may fall at most this much while relaxing; faster as long as E_d - 1 is far from `enough` - 1.
double largest_fall(double energy, double enough);
/// The most that holding PE against that fall may cost.
double dearest_price(const Schedule& schedule, double energy);

/// After a step of which `fraction` was taken at this price: damping follows the steps that succeed, the barrier softens at the
/// target and its stiffness follows the price.
void adapt(Schedule& schedule, const ScheduleView& view, double price, double fraction);
/// After a step whose PE was foreseen wrongly by `error` in log PE.
void adapt_margin(Schedule& schedule, double error);

/// The barrier has reached its final softness, or nothing presses on it.
bool settled(const Schedule& schedule, const ScheduleView& view, double price);
/// Distortion has grown so much while relaxing that the pieces must be wedged.
bool wedged(const Schedule& schedule, double energy, double first_energy);

/// What a state below the target is worth to who takes it all the same: log PE less what distortion beyond `least`, the least on
/// the way, costs. The first per cent are nearly free; charts that jam are not to be crushed for the last ones of PE.
double worth_below_target(double pe, double energy, double least);

}  // namespace atlas_refine
