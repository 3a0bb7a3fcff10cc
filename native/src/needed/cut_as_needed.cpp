// Without a limit: the cuts that promise most are squeezed, and others forecast from there.
#include "needed/cut_as_needed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>

#include "needed/cut_outcomes.h"
#include "needed/cut_to_limit.h"

namespace atlas_refine {
namespace {

constexpr int kMostPoints = 24;     // of a trade-off
constexpr int kTipsPart = 3;        // one of so many cuts leads to a point of high curvature
constexpr int kPackings = 2;        // more of several charts, before any is cut
constexpr double kByChance = 5e-4;  // of E_d: so much more or less other packings of a file came to
constexpr double kAnyGrowth = std::numeric_limits<double>::infinity();
constexpr double kAsGood = 1.02;          // times the boundary, or the cost: what symmetric cuts may have more
constexpr double kFewOfRectangles = 0.4;  // growth: rectangles add less to 5 of the 46 files of one chart in the bench only
constexpr std::array<double, 5> kPrices = {0.1, 0.4, 0.05, 0.2, 0.025};  // of seams, as seam_cost: for a trade-off

/// How far the search goes.
struct Budget {
  int forecasts;         ///< cuts that are tried from one state
  int expansions;        ///< states that others are tried from
  std::size_t squeezes;  ///< states that are squeezed to the end
};

Budget budget_of(Effort effort) {
  switch (effort) {
    case Effort::Fast:
      return {8, 3, 6};
    case Effort::Normal:
      return {12, 8, 12};
    case Effort::Best:
      return {32, 20, 40};
  }
  return {};
}

/// Where seams cost nothing the least distortion is looked for that the budget of seams allows.
RefineOptions with_limit(RefineOptions options) {
  if (!options.max_distortion && !options.max_stretch) options.max_distortion = 1;
  return options;
}

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

class Search {
 public:
  Search(CutTrials& trials, const RefineOptions& options, const ProgressRange& range)
      : trials_(trials), options_(options), rest_(range) {}

  SqueezedTrial run() {
    found_.squeezed.push_back(without_cuts(trials_, wish_, step()));
    if (options_.trade_off) {
      look_for_all();
    } else if (wish_.has_limit() || options_.seam_cost == 0) {
      cut_to_limit(trials_, with_limit(options_), step(), found_);
      if (wish_.has_limit() && may_need_rectangles()) look_at_rectangles();
    } else {
      look_for_best();
    }
    SqueezedTrial& chosen =
        options_.point ? found_.point(*options_.point) : symmetric(trials_, wish_, found_.best(wish_), step(), found_);
    chosen.solution.cuts = found_.report(chosen.trial);
    return std::move(chosen);
  }

 private:
  /// Every step has a part of what is left of the progress: most searches end soon.
  ProgressRange step() {
    const ProgressRange out = rest_.part(0, 0.3);
    rest_ = rest_.part(0.3, 1);
    return out;
  }

  void look_for_best() {
    expand(found_.squeezed.front());
    while (found_.squeezed.size() < budget_.squeezes && !found_.forecast.empty() && !trials_.finishing()) {
      const auto next = cheapest([&](const Trial& trial) { return wish_.cost(trial); });
      if (wish_.cost(*next) >= wish_.cost(found_.best(wish_).trial) - kSettled) break;
      const SqueezedTrial* found = squeeze(next);
      if (found && found == &found_.best(wish_) && expansions_ < budget_.expansions) expand(*found);
    }
  }

  /// Goes on from what is cheapest at one price of seams after the other, then squeezes what may be worth a choice.
  void look_for_all() {
    expand(found_.squeezed.front());
    for (int k = 0; k < budget_.expansions && !found_.forecast.empty() && !trials_.finishing(); ++k) {
      const double price = kPrices[k % kPrices.size()];
      const SqueezedTrial* found =
          squeeze(cheapest([&](const Trial& trial) { return loss(trial) + price * wish_.growth_weight * trial.growth; }));
      if (found) expand(*found);
    }
    for (int k = 0; k < kMostPoints && !trials_.finishing(); ++k) {
      const auto next = found_.forecast_on_front();
      if (next == found_.forecast.end()) break;
      squeeze(next);
    }
    found_.forecast.clear();
  }

  /// The limit is not kept, or by so many seams that rectangles may need fewer.
  bool may_need_rectangles() {
    const Trial& best = found_.best(wish_).trial;
    return !trials_.finishing() && (!wish_.is_enough(best) || wish_.growth_weight * best.growth > kFewOfRectangles);
  }

  void look_at_rectangles() {
    auto rectangles = trials_.rectangles(rest_);
    if (!rectangles || rectangles->trial.growth > most_growth()) return;
    if (wish_.is_enough(rectangles->trial)) found_.squeezed.push_back(std::move(*rectangles));
  }

  double most_growth() const { return options_.max_boundary_growth.value_or(kAnyGrowth); }

  template <class Cost>
  std::vector<Trial>::iterator cheapest(const Cost& cost) {
    return std::min_element(found_.forecast.begin(), found_.forecast.end(),
                            [&](const Trial& a, const Trial& b) { return cost(a) < cost(b); });
  }

  /// Nothing where the bound does not hold.
  const SqueezedTrial* squeeze(std::vector<Trial>::iterator next) {
    const Trial trial = *next;
    found_.forecast.erase(next);
    auto squeezed = trials_.squeezed(trial, step());
    if (squeezed) return &found_.squeezed.emplace_back(std::move(*squeezed));
    found_.failed.push_back(trial);
    return nullptr;
  }

  /// Forecasts what one more cut comes to, and what one cut less does.
  void expand(const SqueezedTrial& present) {
    ++expansions_;
    for (auto& trial : trials_.forecasts(neighbours(present.trial), &present, {most_growth()}, step())) {
      if (!trial) continue;
      ++found_.tried;
      const double gain = loss(present.trial) - loss(*trial);
      if ((trial->growth > present.trial.growth && gain < kSettled) || found_.knows(*trial)) continue;
      found_.forecast.push_back(std::move(*trial));
    }
  }

  std::vector<std::vector<CutPlace>> neighbours(const Trial& present) const {
    std::vector<std::vector<CutPlace>> out;
    const int tips = budget_.forecasts / kTipsPart;
    for (const CutPlace& place : trials_.places(present, budget_.forecasts - tips, tips)) {
      out.push_back(present.cuts);
      out.back().push_back(place);
    }
    for (std::size_t k = 0; k + 1 < present.cuts.size(); ++k) {
      out.push_back(present.cuts);
      out.back().erase(out.back().begin() + static_cast<std::ptrdiff_t>(k));
    }
    return out;
  }

  CutTrials& trials_;
  const RefineOptions& options_;
  Wish wish_{options_, trials_.growth_weight()};
  Budget budget_ = budget_of(options_.effort);
  ProgressRange rest_;
  Outcomes found_;
  int expansions_ = 0;
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
  best.solution.re_embedded = trials.mended();
  return std::move(best.solution);
}

}  // namespace atlas_refine
