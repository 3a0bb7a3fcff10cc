// The best of trials, and those that no other dominates.
#include "needed/cut_outcomes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace atlas_refine {
namespace {

bool same(const Trial& a, const Trial& b) { return a.growth == b.growth && a.distortion == b.distortion; }

/// The same of stretch: E_d - 1 goes with its square.
double excess_of_stretch(double stretch) { return 2 * std::log(std::clamp(stretch - 1, kLeastExcess, kHopeless - 1)); }

}  // namespace

double loss(const Trial& trial) { return std::min(trial.distortion, kHopeless); }

double excess(double distortion) { return std::log(std::clamp(distortion - 1, kLeastExcess, kHopeless - 1)); }

double Wish::above_limits(double distortion, double stretch) const {
  const double none = -std::numeric_limits<double>::infinity();
  return std::max(options.max_distortion ? excess(distortion) - excess(*options.max_distortion) : none,
                  options.max_stretch ? excess_of_stretch(stretch) - excess_of_stretch(*options.max_stretch) : none);
}

double Wish::aim(const Trial& whole) const {
  double out = std::numeric_limits<double>::infinity();
  if (options.max_distortion) out = excess(*options.max_distortion);
  if (options.max_stretch)
    out = std::min(out, excess(whole.distortion) + excess_of_stretch(*options.max_stretch) - excess_of_stretch(whole.stretch));
  return out;
}

bool Wish::is_better(const Trial& a, const Trial& b) const {
  if (!has_limit()) return cost(a) < cost(b) - kSettled;
  if (is_enough(a) != is_enough(b)) return is_enough(a);
  if (is_enough(a)) return a.growth < b.growth;
  const auto rank = [&](const Trial& t) { return std::pair(above_limits(t.distortion, t.stretch), t.distortion); };
  return rank(a) < rank(b);
}

bool Outcomes::knows(const Trial& trial) const {
  const auto is_same = [&](const Trial& other) { return same(other, trial); };
  return std::any_of(forecast.begin(), forecast.end(), is_same) || std::any_of(failed.begin(), failed.end(), is_same);
}

SqueezedTrial& Outcomes::best(const Wish& wish) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < squeezed.size(); ++k) {
    if (wish.is_better(squeezed[k].trial, squeezed[best].trial)) best = k;
  }
  return squeezed[best];
}

std::vector<TradeOff> Outcomes::trade_off() const {
  std::vector<TradeOff> all;
  const auto add = [&](const Trial& t, bool is_squeezed) { all.push_back({t.growth, t.distortion, t.cut_count(), is_squeezed}); };
  for (const Trial& trial : forecast) add(trial, false);
  for (const SqueezedTrial& s : squeezed) add(s.trial, true);
  std::stable_sort(all.begin(), all.end(), [](const TradeOff& a, const TradeOff& b) {
    return std::pair(a.boundary_growth, a.distortion) < std::pair(b.boundary_growth, b.distortion);
  });
  std::vector<TradeOff> out;
  for (const TradeOff& outcome : all) {
    if (std::isfinite(outcome.distortion) && (out.empty() || outcome.distortion < out.back().distortion - kSettled))
      out.push_back(outcome);
  }
  return out;
}

std::vector<Trial>::iterator Outcomes::forecast_on_front() {
  const std::vector<TradeOff> front = trade_off();
  return std::find_if(forecast.begin(), forecast.end(), [&](const Trial& trial) {
    return std::any_of(front.begin(), front.end(), [&](const TradeOff& f) {
      return !f.squeezed && f.boundary_growth == trial.growth && f.distortion == trial.distortion;
    });
  });
}

SqueezedTrial& Outcomes::point(int number) {
  const std::vector<TradeOff> front = trade_off();
  const TradeOff& wanted = front[std::min<std::size_t>(number, front.size() - 1)];
  return *std::find_if(squeezed.begin(), squeezed.end(), [&](const SqueezedTrial& s) {
    return s.trial.growth == wanted.boundary_growth && s.trial.distortion == wanted.distortion;
  });
}

CutReport Outcomes::report(const Trial& chosen) const {
  CutReport out{chosen.cut_count(), tried, trade_off()};
  for (const TradeOff& outcome : out.trade_off) out.chosen += outcome.boundary_growth <= chosen.growth;
  return out;
}

}  // namespace atlas_refine
