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
constexpr double kAsGood = 1.02;          // times the boundary, or the cost: what symmetric cuts may have more
constexpr double kFewOfRectangles = 0.4;  // growth: rectangles add less to 5 of the 46 files of one chart in the bench only
// Of the excess above the limit, or of the least cost: what is forecast so near may keep it, or be it.
constexpr double kNear = 0.1;
constexpr double kNearlyKept = 0.2;  // what came so near may keep it in another packing

/// Several charts are packed by chance: another packing may keep a limit of E_d that the first nearly kept.
SqueezedTrial without_cuts(CutTrials& trials, const Wish& wish, const ProgressRange& range) {
  const auto nearly_kept = [&](const Trial& trial) {
    const std::optional<double>& most = wish.options.max_distortion;
    return most && trials.has_several_charts() && !wish.is_enough(trial) && trial.distortion < *most + kByChance;
  };
  const auto part = [&](int k) { return range.part(k / (kPackings + 1.0), (k + 1) / (kPackings + 1.0)); };
  SqueezedTrial out = trials.without_cuts(part(0));
  for (int again = 1; again <= kPackings && nearly_kept(out.trial) && !trials.finishing(); ++again) {
    SqueezedTrial other = trials.without_cuts(part(again), again);
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

class Search {
 public:
  Search(CutTrials& trials, const RefineOptions& options, const ProgressRange& range)
      : trials_(trials), options_(options), rest_(range) {}

  SqueezedTrial run() {
    found_.squeezed.push_back(without_cuts(trials_, wish_, step()));
    if (options_.trade_off)
      look_for_all();
    else if (wish_.has_limit())
      keep_limit();
    else
      look_for_best();
    if (may_need_rectangles()) look_at_rectangles();
    SqueezedTrial& chosen = choose();
    chosen.solution.cuts = found_.report(wish_, chosen);
    return std::move(chosen);
  }

 private:
  /// Of a trade-off what is listed is what can be picked from it in another run: no more is tried.
  SqueezedTrial& choose() {
    if (options_.point) return found_.point(wish_);
    SqueezedTrial& best = found_.best(wish_);
    return options_.trade_off ? best : symmetric(trials_, wish_, best, step(), found_);
  }

  /// Every step has a part of what is left of the progress: most searches end soon.
  ProgressRange step() {
    const ProgressRange out = rest_.part(0, 0.3);
    rest_ = rest_.part(0.3, 1);
    return out;
  }

  /// The first set that keeps the limits has the least boundary; a budget may leave none, and then the nearest is wanted.
  void keep_limit() {
    if (wish_.is_enough(found_.squeezed.front().trial)) return;
    CutPath path(trials_, options_, options_.max_boundary_growth.has_value(), step(), found_);
    bool goes_on = true;
    while (goes_on && path.passed() < most_growth() && !trials_.finishing()) {
      goes_on = path.advance(most_growth());
      for (CutSet* set : path.front(most_growth())) {
        if (set->squeezed || above_limits(path, *set) > kNear) continue;
        const SqueezedTrial* squeezed = path.squeeze(*set);
        if (!squeezed) continue;
        const Trial& came = squeezed->trial;
        if (wish_.is_enough(came)) return;
        if (wish_.above_limits(came.distortion, came.stretch) > kNearlyKept) continue;
        auto other = kept_in_another_packing(trials_, wish_, set->trial, step(), found_);
        if (!other) continue;
        found_.squeezed.push_back(std::move(*other));
        return;
      }
    }
    squeeze_best(
        path, [&](const CutSet& set) { return std::exp(above_limits(path, set)); },
        [&](const Trial& trial) { return std::exp(wish_.above_limits(trial.distortion, trial.stretch)); });
  }

  void look_for_best() {
    CutPath path(trials_, options_, true, step(), found_);
    const double weight = options_.seam_cost * wish_.growth_weight;
    const auto likely = [&](const CutSet& set) {
      return std::min(path.likely_distortion(set), kHopeless) + weight * set.trial.growth - 1;
    };
    double least = wish_.cost(found_.squeezed.front().trial) - 1;
    while (path.passed() < most_growth() && weight * path.passed() < least && path.advance(most_growth())) {
      for (const CutSet* set : path.front(most_growth())) least = std::min(least, likely(*set));
    }
    squeeze_best(path, likely, [&](const Trial& trial) { return wish_.cost(trial) - 1; });
  }

  /// Those that may be the best, what is likeliest first.
  template <class Likely, class Came>
  void squeeze_best(CutPath& path, const Likely& likely, const Came& came) {
    std::vector<CutSet*> sets = path.front(most_growth());
    std::stable_sort(sets.begin(), sets.end(), [&](const CutSet* a, const CutSet* b) { return likely(*a) < likely(*b); });
    for (CutSet* set : sets) {
      if (likely(*set) > (1 + kNear) * came(found_.best(wish_).trial) || trials_.finishing()) return;
      path.squeeze(*set);
    }
  }

  void look_for_all() {
    CutPath path(trials_, options_, true, step(), found_);
    while (path.passed() < most_growth() && path.advance(most_growth())) continue;
    for (CutSet* set : path.front(most_growth())) {
      if (found_.squeezed.size() < kMostPoints && !trials_.finishing()) path.squeeze(*set);
    }
  }

  double above_limits(const CutPath& path, const CutSet& set) const {
    return wish_.above_limits(path.likely_distortion(set), path.likely_stretch(set));
  }

  /// The limit is not kept, or by so many seams that rectangles may need fewer. Else the bound: without them it is not held, or
  /// charts that are too stiff for it are stretched.
  bool may_need_rectangles() {
    const Trial& best = found_.best(wish_).trial;
    if (trials_.finishing()) return false;
    if (wish_.has_limit() && !options_.trade_off)
      return !wish_.is_enough(best) || wish_.growth_weight * best.growth > kFewOfRectangles;
    return !std::isfinite(best.distortion) || found_.squeezed.front().solution.held > 0;
  }

  void look_at_rectangles() {
    auto rectangles = trials_.rectangles(rest_);
    if (!rectangles || rectangles->trial.growth > most_growth()) return;
    found_.squeezed.push_back(std::move(*rectangles));
  }

  double most_growth() const { return options_.max_boundary_growth.value_or(kAnyGrowth); }

  CutTrials& trials_;
  const RefineOptions& options_;
  Wish wish_{options_, trials_.growth_weight()};
  ProgressRange rest_;
  Outcomes found_;
};

}  // namespace

Solution cut_as_needed(const Refinement& run, const ProgressRange& range) {
  RefineOptions unlimited = run.options;
  unlimited.max_distortion.reset();
  unlimited.max_stretch.reset();
  const Refinement free{run.input, unlimited, run.monitor, run.journal, run.threads, run.asked};
  CutTrials trials(free, range.part(0, 0.1));
  SqueezedTrial best = Search(trials, run.options, range.part(0.1, 1)).run();
  run.journal.fallbacks.insert(run.journal.fallbacks.end(), best.fallbacks.begin(), best.fallbacks.end());
  run.journal.warnings.insert(run.journal.warnings.end(), best.warnings.begin(), best.warnings.end());
  if (!best.trial.cuts.empty()) warn_of_forbidden_edges(trials.prices(), run.input.set.charts, best.solution.atlas, run.journal);
  best.solution.re_embedded = trials.mended();
  return std::move(best.solution);
}

}  // namespace atlas_refine
