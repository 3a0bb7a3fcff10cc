// The best of trials, and those that no other dominates.
#include "needed/cut_outcomes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace atlas_refine {

double loss(const Trial& trial) { return std::min(trial.distortion, kHopeless); }

double excess(double distortion) { return std::log(std::clamp(distortion - 1, kLeastExcess, kHopeless - 1)); }

double excess_of_stretch(double stretch) { return 2 * std::log(std::clamp(stretch - 1, kLeastExcess, kHopeless - 1)); }

double Wish::above_limits(double distortion, double stretch) const {
  const double none = -std::numeric_limits<double>::infinity();
  return std::max(options.max_distortion ? excess(distortion) - excess(*options.max_distortion) : none,
                  options.max_stretch ? excess_of_stretch(stretch) - excess_of_stretch(*options.max_stretch) : none);
}

bool Wish::is_better(const Trial& a, const Trial& b) const {
  if (!has_limit()) return cost(a) < cost(b) - kSettled;
  if (is_enough(a) != is_enough(b)) return is_enough(a);
  if (is_enough(a)) return kAsGood * a.growth < b.growth;
  const auto rank = [&](const Trial& t) { return std::pair(above_limits(t.distortion, t.stretch), t.distortion); };
  return rank(a) < rank(b);
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
  for (const auto& [trial, solution, fallbacks, warnings] : squeezed)
    all.push_back({trial.growth, trial.distortion, trial.cut_count()});
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
