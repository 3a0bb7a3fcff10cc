// The schedule's constants and rules.
#include "reduce/schedule.h"

#include <algorithm>
#include <cmath>

namespace atlas_refine {
namespace {

constexpr double kLeastClimb = 0.01;  // log PE gains at most this much in one iteration near the target,
constexpr double kMostClimb = 0.03;   // and this much far below it
constexpr double kNearTarget = 1e-3;  // log PE: from here on the barrier softens
constexpr double kLeastPrice = 1e-3;  // the barrier is never softer than for this price
// Where charts start above the target and relax:
constexpr double kMostFall = 0.01;       // log PE falls so much in one iteration, unless holding it there is dear,
constexpr double kFastFall = 0.03;       // and so much while E_d - 1 is still far from what is enough:
constexpr double kFar = 2;               // that many times as much
constexpr double kMargin = 3;            // they keep off the target by so many times what the PE of a step was wrong by
constexpr double kPressure = 1;          // the barrier is as firm as for this price per unit of E_d - 1,
constexpr double kDearest = 8;           // or for a price up to so much more,
constexpr double kMostRise = 4;          // E_d - 1 beyond so much of the start's: the charts are wedged
constexpr double kFirmness = 0.2;        // stiffness of the barrier per price and range while PE climbs,
constexpr double kSoftFirmness = 0.005;  // and at the end, when charts may come as near as the gap allows
constexpr double kSoftening = 0.5;       // from one to the other, a step per iteration on the target
constexpr double kOpenFirmness = 2;      // without a box: far from the optimum, a soft barrier grinds
constexpr double kLeastSlack = 1e-3;     // a softer start would let charts press themselves against the floor
constexpr double kFirstDamping = 1e-3;
constexpr double kLeastDamping = 1e-6;

/// Where charts start above the bound and relax, they press on each other by the energy that they still have to lose.
double least_price(bool relaxing, double energy) {
  return relaxing ? std::max(kLeastPrice, kPressure * (energy - 1)) : kLeastPrice;
}

}  // namespace

Schedule first_schedule(bool relaxing, const ScheduleView& view, double slack) {
  Schedule out{.relaxing = relaxing,
               .firmness = view.bounded ? kFirmness : kOpenFirmness,
               .margin = relaxing ? kMostMargin : 0,
               .damping = kFirstDamping};
  if (relaxing && view.deficit > -kNearTarget) out.firmness = kSoftFirmness;  // there already
  out.stiffness = out.firmness * least_price(relaxing, view.energy) * view.range;
  if (relaxing) out.stiffness *= std::max(slack, kLeastSlack);
  return out;
}

Schedule warm_schedule(double price, const ScheduleView& view) {
  return {.arrived = true,
          .firmness = kSoftFirmness,
          .stiffness = kSoftFirmness * std::max(price, kLeastPrice) * view.range,
          .damping = kLeastDamping};
}

double largest_climb(double deficit) { return std::clamp(0.2 * deficit, kLeastClimb, kMostClimb); }

double largest_fall(double energy, double enough) { return energy - 1 > kFar * (enough - 1) ? kFastFall : kMostFall; }

double dearest_price(const Schedule& schedule, double energy) { return kDearest * least_price(schedule.relaxing, energy); }

void adapt(Schedule& schedule, const ScheduleView& view, double price, double fraction) {
  if (fraction >= 0.5)
    schedule.damping = std::max(kLeastDamping, 0.5 * schedule.damping);
  else if (fraction < 0.1)
    schedule.damping = std::min(view.bounded ? kMostDamping : kMostDampingAlone, 4 * schedule.damping);
  const bool near = view.deficit < kNearTarget && (!schedule.relaxing || view.deficit > -kNearTarget);
  schedule.arrived = schedule.arrived || (view.bounded && near);
  if (schedule.arrived) schedule.firmness = std::max(kSoftFirmness, kSoftening * schedule.firmness);
  // A relaxing barrier that followed a price of its own making would freeze.
  const double felt = schedule.relaxing ? std::min(price, dearest_price(schedule, view.energy)) : price;
  const double wanted = schedule.firmness * std::max(felt, least_price(schedule.relaxing, view.energy)) * view.range;
  schedule.stiffness = std::clamp(wanted, 0.5 * schedule.stiffness, 2 * schedule.stiffness);
}

void adapt_margin(Schedule& schedule, double error) {
  schedule.margin = std::min(kMostMargin, std::max(0.5 * schedule.margin, kMargin * error));
}

bool settled(const Schedule& schedule, const ScheduleView& view, double price) {
  return !view.bounded || price == 0 || schedule.firmness == kSoftFirmness;
}

bool wedged(const Schedule& schedule, double energy, double first_energy) {
  return schedule.relaxing && energy - 1 > kMostRise * std::max(first_energy - 1, kLeastPrice);
}

double worth_below_target(double pe, double energy, double least) {
  // At 1.05 times the least one per cent of PE may raise the energy by a tenth, at 1.5 times by two per cent.
  const double excess = std::log(energy / least);
  return std::log(pe) - excess * excess;
}

}  // namespace atlas_refine
