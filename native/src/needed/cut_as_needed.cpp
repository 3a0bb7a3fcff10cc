// One path of sets of cuts, along growing boundary: how far it is gone, and which of them are squeezed.
#include "needed/cut_as_needed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "needed/cut_outcomes.h"
#include "needed/cut_path.h"
#include "report/wished_edges.h"

namespace atlas_refine {
namespace {

constexpr std::size_t kMostPoints = 24;  // of a trade-off
constexpr int kPackings = 2;             // more of several charts before any is cut, and of pieces that nearly keep a limit
constexpr double kByChance = 5e-4;       // of E_d: so much more or less other packings of a file came to
constexpr double kAnyGrowth = std::numeric_limits<double>::infinity();
constexpr double kFewOfRectangles = 0.4;  // growth: rectangles add less to 5 of the 46 files of one chart in the bench only
// Without a limit rectangles are looked at where the best costs more; of few triangles they take next to nothing:
constexpr double kDear = 0.05;
constexpr double kCheap = 0.005;
// Of the excess above the limit, or of the least cost: what is forecast so near may keep it, or be it.
constexpr double kNear = 0.1;
constexpr double kNearlyKept = 0.2;  // what came so near may keep it in another packing

/// Charts that need not be bent for the bound may still lose what the limit is missed by, or what cuts would save: that takes no
/// seam. Several charts are packed by chance: another packing may keep a limit of E_d that the first nearly kept.
SqueezedTrial without_cuts(CutTrials& trials, const Wish& wish, SqueezedTrial out, const ProgressRange& range) {
  const auto nearly_kept = [&](const Trial& trial) {
    const std::optional<double>& most = wish.options.max_distortion;
    return most && trials.has_several_charts() && !wish.is_enough(trial) && trial.distortion < *most + kByChance;
  };
  const auto part = [&](int k) { return range.part(k / (kPackings + 1.0), (k + 1) / (kPackings + 1.0)); };
  if (!wish.is_enough(out.trial) && out.solution.intervention == Intervention::Moved && trials.relaxes()) {
    SqueezedTrial relaxed = trials.without_cuts(part(0), {.relax = true});
    if (relaxed.trial.distortion < out.trial.distortion) out = std::move(relaxed);
  }
  for (int again = 1; again <= kPackings && nearly_kept(out.trial) && !trials.finishing(); ++again) {
    SqueezedTrial other = trials.without_cuts(part(again), {.again = again, .relax = true});
    if (wish.is_better(other.trial, out.trial)) out = std::move(other);
  }
  return out;
}

bool is_as_good(const Wish& wish, const Trial& trial, const Trial& best) {
  if (wish.has_limit()) return wish.is_enough(best) ? wish.is_enough(trial) : !wish.is_better(best, trial);
  return wish.cost(trial) - 1 < kAsGood * (wish.cost(best) - 1);
}

/// The best, or nearly the same cuts as mirror images of each other where that costs nothing.
SqueezedTrial& symmetric(const CutTrials& trials, const Wish& wish, SqueezedTrial& best, const ProgressRange& range,
                         Outcomes& found) {
  if (trials.finishing()) return best;
  const double most = std::min(wish.options.max_boundary_growth.value_or(kAnyGrowth), kAsGood * best.trial.growth);
  const auto sets = trials.symmetric_sets(best.trial.cuts);
  if (sets.empty()) return best;
  for (const auto& trial : trials.forecasts(sets, &found.squeezed.front(), {most}, range.part(0, 0.3))) {
    if (!trial) continue;
    ++found.tried;
    auto squeezed = trials.squeezed(*trial, range.part(0.3, 1));
    if (squeezed && is_as_good(wish, squeezed->trial, best.trial)) return found.squeezed.emplace_back(std::move(*squeezed));
  }
  return best;
}

/// Packings of one set of cuts differ by as much as smaller sets have left to the limit.
std::optional<SqueezedTrial> kept_in_another_packing(const CutTrials& trials, const Wish& wish, const Trial& forecast,
                                                     const ProgressRange& range, Outcomes& found) {
  for (int again = 1; again <= kPackings && !trials.finishing(); ++again) {
    const auto other = trials.packed_again(forecast, again);
    if (!other || other->foreseen >= forecast.foreseen) continue;
    ++found.tried;
    auto squeezed = trials.squeezed(*other, range);
    if (squeezed && wish.is_enough(squeezed->trial)) return squeezed;
  }
  return std::nullopt;
}

/// A search with what it has found so far.
struct Search {
  CutTrials& trials;
  const RefineOptions& options;
  Wish wish;
  ProgressRange rest;
  Outcomes found = {};

  double most_growth() const { return options.max_boundary_growth.value_or(kAnyGrowth); }

  /// Every step has a part of what is left of the progress: most searches end soon.
  ProgressRange step() {
    const ProgressRange out = rest.part(0, 0.3);
    rest = rest.part(0.3, 1);
    return out;
  }

  CutPath path(bool thorough) { return {trials, options, thorough, step(), found}; }

  double above_limits(const CutPath& path, const CutSet& set) const {
    return wish.above_limits(path.likely_distortion(set), path.likely_stretch(set));
  }
};

/// Those that may be the best, what is likeliest first.
template <class Likely, class Came>
void squeeze_best(Search& search, CutPath& path, const Likely& likely, const Came& came) {
  std::vector<CutSet*> sets = path.front(search.most_growth());
  std::stable_sort(sets.begin(), sets.end(), [&](const CutSet* a, const CutSet* b) { return likely(*a) < likely(*b); });
  for (CutSet* set : sets) {
    if (likely(*set) > (1 + kNear) * came(search.found.best(search.wish).trial) || search.trials.finishing()) return;
    path.squeeze(*set);
  }
}

/// The limit is not kept, or by so many seams that rectangles may need fewer. Else the bound: without them it is not held,
/// charts that are too stiff for it are stretched, or what the best costs leaves them room.
bool may_need_rectangles(Search& search) {
  const Wish& wish = search.wish;
  const Trial& best = search.found.best(wish).trial;
  if (search.trials.finishing()) return false;
  const bool small = search.trials.is_small();
  if (wish.has_limit() && !search.options.trade_off)
    return !wish.is_enough(best) || wish.growth_weight * best.growth > (small ? 0 : kFewOfRectangles);
  if (!std::isfinite(best.distortion) || search.found.squeezed.front().solution.held > 0) return true;
  return !search.options.trade_off && wish.cost(best) - 1 > (small ? kCheap : kDear);
}

void look_at_rectangles(Search& search) {
  if (!may_need_rectangles(search)) return;
  auto rectangles = search.trials.rectangles(search.step());
  if (!rectangles || rectangles->trial.growth > search.most_growth()) return;
  search.found.squeezed.push_back(std::move(*rectangles));
}

/// Of cuts that were added together the last may not be needed.
void spare_cuts(const Search& search, CutPath& path, const CutSet& enough) {
  for (int low = 0, high = enough.together; high - low > 1 && !search.trials.finishing();) {
    const int middle = (low + high) / 2;
    CutSet* fewer = path.with_fewer(enough, enough.together - middle);
    const SqueezedTrial* squeezed = fewer ? path.squeeze(*fewer) : nullptr;
    (squeezed && search.wish.is_enough(squeezed->trial) ? high : low) = middle;
  }
}

/// The first set that keeps the limits costs least; a budget may leave none, and then the nearest is wanted.
void keep_limit_along(Search& search, CutPath path) {
  const Wish& wish = search.wish;
  const double most = search.most_growth();
  bool goes_on = true;
  while (goes_on && path.passed() < most && !search.trials.finishing()) {
    goes_on = path.advance(most);
    for (CutSet* set : path.front(most)) {
      const bool is_known = set->squeezed != nullptr;
      if (!is_known && search.above_limits(path, *set) > kNear) continue;
      const SqueezedTrial* squeezed = path.squeeze(*set);
      if (!squeezed) continue;
      const Trial& came = squeezed->trial;
      if (wish.is_enough(came)) return spare_cuts(search, path, *set);
      if (is_known || wish.above_limits(came.distortion, came.stretch) > kNearlyKept) continue;
      auto other = kept_in_another_packing(search.trials, wish, set->trial, search.step(), search.found);
      if (!other) continue;
      search.found.squeezed.push_back(std::move(*other));
      return;
    }
  }
  squeeze_best(
      search, path, [&](const CutSet& set) { return std::exp(search.above_limits(path, set)); },
      [&](const Trial& trial) { return std::exp(wish.above_limits(trial.distortion, trial.stretch)); });
}

/// Rectangles take less than a thorough search, and may be what holds the limits where that finds nothing.
void keep_limit(Search& search) {
  if (search.wish.is_enough(search.found.squeezed.front().trial)) return;
  const bool thorough = search.options.max_boundary_growth.has_value();
  keep_limit_along(search, search.path(thorough));
  look_at_rectangles(search);
  const bool goes_on = search.trials.is_small() || !search.wish.is_enough(search.found.best(search.wish).trial);
  if (!thorough && goes_on && !search.trials.finishing()) keep_limit_along(search, search.path(true));
}

void look_for_best(Search& search) {
  const Wish& wish = search.wish;
  CutPath path = search.path(true);
  const double weight = search.options.seam_cost * wish.growth_weight, most = search.most_growth();
  const auto likely = [&](const CutSet& set) {
    return std::min(path.likely_distortion(set), kHopeless) + weight * set.trial.growth - 1;
  };
  double least = wish.cost(search.found.squeezed.front().trial) - 1;
  while (path.passed() < most && weight * path.passed() < least && path.advance(most)) {
    for (const CutSet* set : path.front(most)) least = std::min(least, likely(*set));
  }
  squeeze_best(search, path, likely, [&](const Trial& trial) { return wish.cost(trial) - 1; });
  look_at_rectangles(search);
}

void look_for_all(Search& search) {
  CutPath path = search.path(true);
  while (path.passed() < search.most_growth() && path.advance(search.most_growth())) continue;
  for (CutSet* set : path.front(search.most_growth())) {
    if (search.found.squeezed.size() < kMostPoints && !search.trials.finishing()) path.squeeze(*set);
  }
  look_at_rectangles(search);
}

/// Of a trade-off what is listed is what can be picked from it in another run: no more is tried.
SqueezedTrial& choose(Search& search) {
  const RefineOptions& options = search.options;
  if (options.point) return search.found.point(search.wish);
  SqueezedTrial& best = search.found.best(search.wish);
  return options.trade_off ? best : symmetric(search.trials, search.wish, best, search.step(), search.found);
}

SqueezedTrial found_by(Search& search) {
  const RefineOptions& options = search.options;
  SqueezedTrial whole = search.trials.without_cuts(search.step());
  // Where no cut pays charts are bent for the bound only.
  std::optional<SqueezedTrial> moved;
  const bool pays_for_seams = !search.wish.has_limit() && !options.trade_off && options.seam_cost > 0;
  if (pays_for_seams && whole.solution.intervention == Intervention::Moved) moved = whole;
  search.found.squeezed.push_back(without_cuts(search.trials, search.wish, std::move(whole), search.step()));
  if (options.trade_off)
    look_for_all(search);
  else if (search.wish.has_limit())
    keep_limit(search);
  else
    look_for_best(search);
  SqueezedTrial* chosen = &choose(search);
  if (moved && chosen == &search.found.squeezed.front()) chosen = &search.found.squeezed.emplace_back(std::move(*moved));
  chosen->solution.cuts = search.found.report(search.wish, *chosen);
  return std::move(*chosen);
}

}  // namespace

Solution cut_as_needed(const Refinement& run, const ProgressRange& range) {
  RefineOptions unlimited = run.options;
  unlimited.max_distortion.reset();
  unlimited.max_stretch.reset();
  const Refinement free{run.input, unlimited, run.monitor, run.journal, run.threads, run.asked};
  CutTrials trials(free, range.part(0, 0.1));
  Search search{trials, run.options, {run.options, trials.growth_weight()}, range.part(0.1, 1)};
  SqueezedTrial best = found_by(search);
  run.journal.fallbacks.insert(run.journal.fallbacks.end(), best.fallbacks.begin(), best.fallbacks.end());
  run.journal.warnings.insert(run.journal.warnings.end(), best.warnings.begin(), best.warnings.end());
  if (!best.trial.cuts.empty()) warn_of_forbidden_edges(trials.prices(), run.input.set.charts, best.solution.atlas, run.journal);
  best.solution.re_embedded = trials.mended();
  return std::move(best.solution);
}

}  // namespace atlas_refine
