// The best of trials, and those that no other dominates.
#include "needed/cut_outcomes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
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

/// By growing boundary those than which no other has both less boundary and less distortion, and what is chosen: a limit may
/// part it from one with less boundary that has hardly more distortion.
std::vector<SqueezedTrial*> Outcomes::front(const SqueezedTrial& chosen) {
  std::vector<SqueezedTrial*> all, out;
  for (SqueezedTrial& outcome : squeezed) all.push_back(&outcome);
  std::stable_sort(all.begin(), all.end(), [](const SqueezedTrial* a, const SqueezedTrial* b) {
    return std::pair(a->trial.growth, a->trial.distortion) < std::pair(b->trial.growth, b->trial.distortion);
  });
  double least = std::numeric_limits<double>::infinity();
  for (SqueezedTrial* outcome : all) {
    const auto& [distortion, growth] = std::tie(outcome->trial.distortion, outcome->trial.growth);
    const bool is_less = distortion < least - kSettled;
    if (!is_less && (outcome != &chosen || !std::isfinite(distortion))) continue;
    const bool is_instead = !is_less && growth <= kAsGood * out.back()->trial.growth && distortion <= least + kSettled;
    if (is_instead) out.pop_back();
    out.push_back(outcome);
    if (is_less) least = distortion;
  }
  return out;
}

SqueezedTrial& Outcomes::point(const Wish& wish) {
  const std::vector<SqueezedTrial*> front = this->front(best(wish));
  return *front[std::min<std::size_t>(*wish.options.point, front.size() - 1)];
}

CutReport Outcomes::report(const Wish& wish, const SqueezedTrial& chosen) {
  CutReport out{.cuts = chosen.trial.cut_count(), .tried = tried};
  for (const SqueezedTrial* outcome : front(wish.options.point ? best(wish) : chosen)) {
    if (outcome == &chosen) out.chosen = static_cast<int>(out.trade_off.size());
    out.trade_off.push_back({outcome->trial.growth, outcome->trial.distortion, outcome->trial.cut_count()});
  }
  return out;
}

}  // namespace atlas_refine
