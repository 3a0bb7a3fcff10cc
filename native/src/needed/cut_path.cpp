// The set that saves most for the boundary that it adds to what was passed comes next. What sets save is foreseen from the
// outlines that they leave, or from what is near a way to a point inside, so that many are looked at and only few forecast.
#include "needed/cut_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "needed/symmetric_cuts.h"

namespace atlas_refine {
namespace {

// No step is much longer than the boundary so far: there is something to be had for every budget, and none is passed over.
constexpr double kStep = 1.2;         // times the boundary that was passed
constexpr double kLeastStep = 0.015;  // more than that, as growth
constexpr double kRemoved = 0.2;      // of what a cut saved when it was added is lost without it, where that pays
// Of the excess: what promises to be no worse than that may be better where the path is thorough.
constexpr double kSurprise = 0.05;
constexpr int kMostRisks = 16;      // forecasts of such where the path is not, but nothing else is left
constexpr double kStretch = 0.7;    // the part of stretch in what the path goes by, where that is limited
constexpr std::size_t kPruned = 3;  // cuts: of fewer none is left out

/// How far the path goes.
struct Budget {
  int first_places;  ///< cuts across charts that are looked at
  int places, tips;  ///< the same from a set of cuts, and cuts to points of high curvature
  int first;         ///< forecast at once
  int forecasts;
  int a_step;  ///< the least a step, where the path is thorough
};

Budget budget_of(Effort effort) {
  switch (effort) {
    case Effort::Fast:
      return {20, 8, 2, 3, 40, 2};
    case Effort::Normal:
      return {30, 24, 4, 4, 96, 3};
    case Effort::Best:
      return {60, 40, 8, 8, 320, 6};
  }
  return {};
}

constexpr double kEverywhere = std::numeric_limits<double>::infinity();

}  // namespace

CutPath::CutPath(const CutTrials& trials, const RefineOptions& options, bool thorough, const ProgressRange& range,
                 Outcomes& found)
    : trials_(trials), options_(options), is_thorough_(thorough), rest_(range), found_(found), tried_before_(found.tried) {
  const SqueezedTrial& whole = found.squeezed.front();
  bias_.learn(whole);
  best_ = measured(whole.trial);
  expand(whole.trial, 1, best_, &whole);
}

bool CutPath::advance(double most_growth) {
  double reach = std::max({kStep * passed_, passed_ + kLeastStep, passed_ + together_});
  while (!trials_.finishing()) {
    if (CutSet* set = next(reach)) {
      if (set->trial.growth > most_growth) break;
      pass(*set);
      return true;
    }
    double least = kEverywhere;
    for (const CutSet* set : ahead(kEverywhere)) {
      if (set->trial.growth > reach) least = std::min(least, set->trial.growth);
    }
    if (!std::isfinite(least) && !std::exchange(is_stuck_, true) && takes_risks()) continue;
    if (!std::isfinite(least) || least > most_growth) break;
    reach = std::max(reach, kStep * least);
  }
  passed_ = kEverywhere;
  return false;
}

std::vector<CutSet*> CutPath::front(double most_growth) {
  std::vector<CutSet*> known, out;
  for (CutSet& set : sets_) {
    if (set.is_forecast && set.trial.growth <= std::min(most_growth, passed_)) known.push_back(&set);
  }
  std::stable_sort(known.begin(), known.end(), [](const CutSet* a, const CutSet* b) { return a->cost() < b->cost(); });
  for (CutSet* set : known) {
    if (set->excess < (out.empty() ? measured(found_.squeezed.front().trial) : out.back()->excess)) out.push_back(set);
  }
  return out;
}

const SqueezedTrial* CutPath::squeeze(CutSet& set) {
  if (set.squeezed || set.fails) return set.squeezed;
  auto squeezed = trials_.squeezed(set.trial, step());
  set.fails = !squeezed;
  if (squeezed) set.squeezed = &found_.squeezed.emplace_back(std::move(*squeezed));
  return set.squeezed;
}

/// What the path goes by: where stretch is limited, that for the most part, but E_d too, as where stretch is local the first cuts
/// hardly change it.
double CutPath::measured(const Trial& trial) const {
  const double own = excess(bias_.distortion_of(trial));
  if (!options_.max_stretch) return own;
  return kStretch * excess_of_stretch(bias_.stretch_of(trial)) + (1 - kStretch) * own;
}

double CutPath::foreseen(const CutSet& set) const {
  if (set.is_forecast) return set.excess;
  return set.before - (set.gain > 0 ? savings_.faith() : 1) * set.gain;
}

double CutPath::rate_of(const CutSet& set) const {
  return (best_ - foreseen(set)) / (set.price * (set.trial.growth - passed_) + kShortest);
}

/// Those that may be next, what saves most for its length first.
std::vector<CutSet*> CutPath::ahead(double reach) {
  std::vector<CutSet*> out;
  const bool may_forecast = this->may_forecast();
  for (CutSet& set : sets_) {
    if (set.is_out || set.trial.growth <= passed_ || set.trial.growth > reach || (!set.is_forecast && !may_forecast)) continue;
    const double least_gain = set.is_forecast || !takes_risks() ? kLeastGain : -kSurprise;
    if (foreseen(set) < best_ - least_gain) out.push_back(&set);
  }
  std::stable_sort(out.begin(), out.end(), [&](const CutSet* a, const CutSet* b) { return rate_of(*a) > rate_of(*b); });
  return out;
}

bool CutPath::may_forecast() const { return found_.tried - tried_before_ < budget_of(options_.effort).forecasts; }

bool CutPath::takes_risks() const { return is_thorough_ || (is_stuck_ && risks_ < kMostRisks); }

CutSet* CutPath::next(double reach) {
  const Budget budget = budget_of(options_.effort);
  const int enough = found_.tried + (is_thorough_ ? budget.a_step : 0);
  while (!trials_.finishing()) {
    std::vector<CutSet*> sets = ahead(reach);
    if (sets.empty()) return nullptr;
    CutSet* first = sets.front();
    sets.erase(std::remove_if(sets.begin(), sets.end(), [](const CutSet* set) { return set->is_forecast; }), sets.end());
    if (first->is_forecast && (sets.empty() || found_.tried >= enough)) {
      if (trials_.places_anew() && add_with_one_less(*first)) continue;
      return first;
    }
    if (is_thorough_ && found_.tried >= enough && foreseen(*sets.front()) >= best_ - kLeastGain) return nullptr;
    sets.resize(std::min<std::size_t>(sets.size(), found_.tried == tried_before_ ? budget.first : 1));
    forecast(sets);
  }
  return nullptr;
}

/// Side by side those that are found from the same set.
void CutPath::forecast(const std::vector<CutSet*>& sets) {
  std::vector<std::vector<CutPlace>> cuts;
  for (const CutSet* set : sets) cuts.push_back(set->trial.cuts);
  const auto trials = trials_.forecasts(cuts, sets.front()->present, {kEverywhere, bias_}, step());
  for (std::size_t k = 0; k < sets.size(); ++k) {
    CutSet& set = *sets[k];
    ++found_.tried;
    risks_ += is_stuck_;
    set.is_out = !trials[k] || trials[k]->growth <= passed_;
    if (set.is_out) continue;
    set.trial = *trials[k];
    set.excess = measured(set.trial);
    set.is_forecast = true;
    if (set.gain > 0 && set.together == 1)
      savings_.learn(set.trial.cuts.back(), set.before, set.less_strain, set.gain, set.before - set.excess);
  }
}

/// Among many charts pieces are left where they lie, which only the squeeze tells.
void CutPath::pass(CutSet& set) {
  passed_ = set.trial.growth;
  const SqueezedTrial* squeezed = trials_.places_anew() ? nullptr : squeeze(set);
  if (squeezed) {
    bias_.learn(*squeezed);
    set.excess = measured(squeezed->trial);
  }
  best_ = std::min(best_, set.excess);
  is_stuck_ = false;
  if (!may_forecast()) return;
  if (squeezed) return expand(squeezed->trial, set.price, set.excess, squeezed);
  if (trials_.places_anew()) expand(set.trial, set.price, set.excess, nullptr);
}

/// One cut more, at the best places and at those that have saved something before.
void CutPath::expand(const Trial& present, double own_price, double before, const SqueezedTrial* squeezed) {
  const Budget budget = budget_of(options_.effort);
  std::vector<CutPlace> places = trials_.places(present, present.cuts.empty() ? budget.first_places : budget.places, budget.tips);
  savings_.add_useful(places);
  const Previews previews = trials_.previews(present, places);
  const std::size_t first = sets_.size();
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto& [growth, strain, price] = previews.with[k];
    if (has(present.cuts, places[k]) || !std::isfinite(growth)) continue;
    CutSet set{.trial = {.cuts = present.cuts, .growth = present.growth + growth}, .before = before, .present = squeezed};
    set.trial.cuts.push_back(places[k]);
    set.less_strain = strain ? previews.strain - *strain : 0;
    set.gain = savings_.foresee(places[k], set.less_strain, before);
    if (set.trial.growth > 0) set.price = (own_price * present.growth + price * growth) / set.trial.growth;
    add(std::move(set));
  }
  if (!trials_.places_anew()) add_together(present, first);
}

CutSet* CutPath::with_fewer(const CutSet& set, int less) {
  CutSet out{
      .trial = set.trial, .before = set.before, .present = set.present, .price = set.price, .together = set.together - less};
  out.trial.cuts.resize(set.trial.cuts.size() - less);
  if (!add(std::move(out))) return nullptr;
  CutSet& added = sets_.back();
  const double passed = std::exchange(passed_, 0);  // back behind what was passed
  forecast({&added});
  passed_ = passed;
  return added.is_forecast ? &added : nullptr;
}

/// Among many charts the best cut of each of those that lose most, where several promise as much: else every one of a hundred
/// charts takes a step of its own. They stay in the layout, so that what they save adds up.
void CutPath::add_together(const Trial& present, std::size_t first) {
  constexpr double kAlike = 0.5;  // of the best rate
  std::map<int, const CutSet*> best;
  for (std::size_t k = first; k < sets_.size(); ++k) {
    const CutSet*& own = best[sets_[k].trial.cuts.back().chart];
    if (!own || rate_of(sets_[k]) > rate_of(*own)) own = &sets_[k];
  }
  double least = 0;
  for (const auto& [chart, set] : best) least = std::max(least, kAlike * rate_of(*set));
  std::vector<const CutSet*> good;
  for (const auto& [chart, set] : best) {
    if (rate_of(*set) >= least && set->gain >= kLeastGain) good.push_back(set);
  }
  std::stable_sort(good.begin(), good.end(), [&](const CutSet* a, const CutSet* b) { return rate_of(*a) > rate_of(*b); });
  CutSet out{.trial = {.cuts = present.cuts, .growth = present.growth}};
  double cost = 0;
  for (const CutSet* set : good) {
    out.trial.cuts.push_back(set->trial.cuts.back());
    out.trial.growth += set->trial.growth - present.growth;
    out.gain += set->gain;
    cost += set->cost();
    out.before = set->before;
    out.present = set->present;
  }
  const std::size_t more = out.trial.cuts.size() - present.cuts.size();
  if (more < 2) return;
  out.together = static_cast<int>(more);
  if (out.trial.growth > 0) out.price = cost / (out.trial.growth + (static_cast<double>(more) - 1) * present.growth);
  together_ = out.trial.growth - present.growth;
  add(std::move(out));
}

/// Once for each set; whether anything was added.
bool CutPath::add_with_one_less(const CutSet& set) {
  const std::vector<CutPlace> cuts = set.trial.cuts;
  if (cuts.size() < kPruned || has_any(pruned_, cuts)) return false;
  pruned_.push_back(cuts);
  bool out = false;
  const double before = set.excess, growth = set.trial.growth;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    CutSet less{.trial = {.cuts = cuts, .growth = growth - trials_.growth_of(cuts[k])}, .before = before, .price = set.price};
    less.trial.cuts.erase(less.trial.cuts.begin() + static_cast<std::ptrdiff_t>(k));
    less.gain = -kRemoved * std::max(kLeastGain, savings_.foresee(cuts[k], 0, before));
    out |= add(std::move(less));
  }
  return out;
}

bool CutPath::add(CutSet set) {
  const bool is_new =
      std::none_of(sets_.begin(), sets_.end(), [&](const CutSet& s) { return same(s.trial.cuts, set.trial.cuts); });
  if (is_new) sets_.push_back(std::move(set));
  return is_new;
}

ProgressRange CutPath::step() {
  const ProgressRange out = rest_.part(0, 0.1);
  rest_ = rest_.part(0.1, 1);
  return out;
}

}  // namespace atlas_refine
