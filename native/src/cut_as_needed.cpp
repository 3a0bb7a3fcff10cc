// Best first: the cuts that promise to come to what is asked with the least seams are squeezed, and others forecast from there.
#include "cut_as_needed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>

#include "cut_trials.h"

namespace atlas_refine {
namespace {

constexpr double kShortest = 0.02;  // boundary growth added to each cut's where rates are compared: else the shortest always win
constexpr double kHopeful = 0.5;    // further cuts pay at this part of the best rate that was seen, at first
constexpr double kSettled = 1e-4;   // of E_d: less is no gain
constexpr int kMostPoints = 24;     // of a trade-off
constexpr std::array<double, 5> kPrices = {0.1, 0.4, 0.05, 0.2, 0.025};  // of seams, as seam_cost: for a trade-off
constexpr double kHopeless = 10;                                         // E_d that counts where the bound does not hold

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

double loss(const Trial& trial) { return std::min(trial.distortion, kHopeless); }

/// What the options ask of cuts.
struct Wish {
  const RefineOptions& options;

  bool has_limit() const { return options.max_distortion.has_value(); }
  bool is_enough(const Trial& trial) const { return has_limit() && trial.distortion <= *options.max_distortion; }
  double cost(const Trial& trial) const { return loss(trial) + options.seam_cost * trial.growth; }

  /// With a limit the least seams that keep it, else the least of distortion and what seams cost.
  bool is_better(const Trial& a, const Trial& b) const {
    if (!has_limit()) return cost(a) < cost(b) - kSettled;
    if (is_enough(a) != is_enough(b)) return is_enough(a);
    return is_enough(a) ? a.growth < b.growth : a.distortion < b.distortion;
  }
};

bool same(const Trial& a, const Trial& b) { return a.growth == b.growth && a.distortion == b.distortion; }

/// All that was found.
struct Outcomes {
  std::deque<SqueezedTrial> squeezed;  ///< the first without cuts
  std::vector<Trial> forecast;         ///< those not squeezed
  std::vector<Trial> failed;           ///< forecast to hold the bound, which they do not
  int tried = 0;

  /// The same cuts may come in another order.
  bool knows(const Trial& trial) const {
    const auto is_same = [&](const Trial& other) { return same(other, trial); };
    return std::any_of(forecast.begin(), forecast.end(), is_same) || std::any_of(failed.begin(), failed.end(), is_same);
  }

  SqueezedTrial& best(const Wish& wish) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < squeezed.size(); ++k) {
      if (wish.is_better(squeezed[k].trial, squeezed[best].trial)) best = k;
    }
    return squeezed[best];
  }

  /// Those than which no other has both less boundary and less distortion.
  std::vector<TradeOff> trade_off() const {
    std::vector<TradeOff> all;
    const auto add = [&](const Trial& t, bool is_squeezed) {
      all.push_back({t.growth, t.distortion, static_cast<int>(t.cuts.size()), is_squeezed});
    };
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

  /// Its end where there is none.
  std::vector<Trial>::iterator forecast_on_front() {
    const std::vector<TradeOff> front = trade_off();
    return std::find_if(forecast.begin(), forecast.end(), [&](const Trial& trial) {
      return std::any_of(front.begin(), front.end(), [&](const TradeOff& f) {
        return !f.squeezed && f.boundary_growth == trial.growth && f.distortion == trial.distortion;
      });
    });
  }

  SqueezedTrial& point(int number) {
    const std::vector<TradeOff> front = trade_off();
    const TradeOff& wanted = front[std::min<std::size_t>(number, front.size() - 1)];
    return *std::find_if(squeezed.begin(), squeezed.end(), [&](const SqueezedTrial& s) {
      return s.trial.growth == wanted.boundary_growth && s.trial.distortion == wanted.distortion;
    });
  }

  CutReport report(const Trial& chosen) const {
    CutReport out{static_cast<int>(chosen.cuts.size()), tried, trade_off()};
    for (const TradeOff& outcome : out.trade_off) out.chosen += outcome.boundary_growth <= chosen.growth;
    return out;
  }
};

class Search {
 public:
  Search(CutTrials& trials, const RefineOptions& options, const ProgressRange& range)
      : trials_(trials), options_(options), wish_{options}, budget_(budget_of(options.effort)), rest_(range) {}

  SqueezedTrial run() {
    found_.squeezed.push_back(trials_.without_cuts(step()));
    if (options_.trade_off) {
      look_for_all();
    } else {
      look_for_best();
    }
    SqueezedTrial& chosen = options_.point ? found_.point(*options_.point) : found_.best(wish_);
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
    if (!wish_.is_enough(found_.squeezed.front().trial)) expand(found_.squeezed.front());
    while (found_.squeezed.size() < budget_.squeezes && !found_.forecast.empty() && !trials_.finishing()) {
      const auto next = cheapest([&](const Trial& trial) { return promise(trial); });
      if (is_hopeless(*next)) break;
      const SqueezedTrial* found = squeeze(next);
      if (!found) continue;
      const bool goes_on = wish_.has_limit() ? !wish_.is_enough(found->trial) : found == &found_.best(wish_);
      if (goes_on && expansions_ < budget_.expansions) expand(*found);
    }
  }

  /// Goes on from what is cheapest at one price of seams after the other, then squeezes what may be worth a choice.
  void look_for_all() {
    expand(found_.squeezed.front());
    for (int k = 0; k < budget_.expansions && !found_.forecast.empty() && !trials_.finishing(); ++k) {
      const double price = kPrices[k % kPrices.size()];
      const SqueezedTrial* found = squeeze(cheapest([&](const Trial& trial) { return loss(trial) + price * trial.growth; }));
      if (found) expand(*found);
    }
    for (int k = 0; k < kMostPoints && !trials_.finishing(); ++k) {
      const auto next = found_.forecast_on_front();
      if (next == found_.forecast.end()) break;
      squeeze(next);
    }
    found_.forecast.clear();
  }

  template <class Cost>
  std::vector<Trial>::iterator cheapest(const Cost& cost) {
    return std::min_element(found_.forecast.begin(), found_.forecast.end(),
                            [&](const Trial& a, const Trial& b) { return cost(a) < cost(b); });
  }

  /// With a limit the growth with which a trial will keep it: further cuts save as much for their length as the best so far, or
  /// part of it, ever less of it so that the search goes deeper instead of wider, and are no shorter than the shortest.
  double promise(const Trial& trial) const {
    if (!wish_.has_limit()) return wish_.cost(trial);
    if (wish_.is_enough(trial)) return trial.growth;
    const double rate = kHopeful / expansions_ * best_rate_;
    return trial.growth + std::max(least_growth_, (loss(trial) - *options_.max_distortion) / rate);
  }

  bool is_hopeless(const Trial& trial) {
    const Trial& best = found_.best(wish_).trial;
    if (!wish_.has_limit()) return wish_.cost(trial) >= wish_.cost(best) - kSettled;
    return wish_.is_enough(best) && promise(trial) >= best.growth;
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
    const double most = options_.max_boundary_growth.value_or(std::numeric_limits<double>::infinity());
    for (Trial& trial : trials_.forecasts(present, trials_.places(present, budget_.forecasts), most, step())) {
      ++found_.tried;
      const double gain = loss(present.trial) - loss(trial), more = trial.growth - present.trial.growth;
      if ((more > 0 && gain < kSettled) || found_.knows(trial)) continue;
      if (more > 0) {
        best_rate_ = std::max(best_rate_, gain / (more + kShortest));
        least_growth_ = std::min(least_growth_, more);
      }
      found_.forecast.push_back(std::move(trial));
    }
  }

  CutTrials& trials_;
  const RefineOptions& options_;
  Wish wish_;
  Budget budget_;
  ProgressRange rest_;
  Outcomes found_;
  double best_rate_ = kSettled, least_growth_ = kHopeless;
  int expansions_ = 0;
};

}  // namespace

Solution cut_as_needed(const Refinement& run, const ProgressRange& range) {
  RefineOptions unlimited = run.options;
  unlimited.max_distortion.reset();
  const Refinement free{run.input, unlimited, run.monitor, run.journal, run.threads, run.asked};
  CutTrials trials(free, range.part(0, 0.1));
  SqueezedTrial best = Search(trials, run.options, range.part(0.1, 1)).run();
  run.journal.fallbacks.insert(run.journal.fallbacks.end(), best.fallbacks.begin(), best.fallbacks.end());
  run.journal.warnings.insert(run.journal.warnings.end(), best.warnings.begin(), best.warnings.end());
  best.solution.re_embedded = trials.mended();
  return std::move(best.solution);
}

}  // namespace atlas_refine
