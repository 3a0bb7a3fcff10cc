// Cut by cut, always the one that saves most for its length beside those that there are. What it saves is foreseen from the
// outlines that it leaves, or from what is near a way to a point inside, so that many are looked at and only few forecast; only
// what is forecast to keep the limit is squeezed to the end. Once the limit is kept the search goes back to what may need less
// boundary.
#include "needed/cut_to_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "needed/symmetric_cuts.h"

namespace atlas_refine {
namespace {

constexpr double kHopeful = 0.5;  // further cuts pay at this part of the best rate that was seen
// What a cut saves beside others of what it saved by itself, before any was forecast beside others; that counts as so much of
// the logarithm.
constexpr double kInherited = 0.8, kPrior = 3;
constexpr double kLikelyShare = 0.15;   // of the distortion near a cut that relaxes, before any was forecast
constexpr double kMostShare = 0.9;      // of all distortion that one cut may release
constexpr double kPriorStrain = 0.005;  // of E_d, that outlines tell; what they have told counts more from then on
constexpr double kPriorNear = 0.2;      // the same of distortion near cuts, as a part of all
constexpr double kRemoved = 0.2;        // of what a cut saved when it was added is lost without it, where that pays
constexpr double kLeastGain = 0.01;     // of the logarithm of E_d - 1
constexpr double kMuchLess = 0.7;       // of the boundary
constexpr double kRoughly = 1.25;       // times the boundary that is told before a cut is made
constexpr double kElsewhere = 0.3;      // of how far E_d is below, where a limit of stretch steers
constexpr double kNear = 0.1;           // of it, above the limit: what is forecast so near may keep it

/// How far the search goes.
struct Budget {
  int first_places;  ///< cuts across charts that are looked at
  int places, tips;  ///< the same from a set of cuts, and cuts to points of high curvature
  int first;         ///< forecast at once
  int improving;     ///< forecasts in all, once the limit is kept
  int forecasts;     ///< before, and of sets with one cut less
  int surprises;     ///< of them such as promise nothing
  int squeezes;
};

constexpr Budget kFast{20, 8, 2, 3, 8, 20, 1, 10};
constexpr Budget kNormal{30, 14, 4, 4, 18, 32, 3, 16};
constexpr Budget kBest{60, 40, 8, 8, 100, 160, 30, 60};

const Budget& budget_of(Effort effort) { return effort == Effort::Fast ? kFast : effort == Effort::Best ? kBest : kNormal; }

bool has(const std::vector<CutPlace>& cuts, const CutPlace& place) {
  return std::any_of(cuts.begin(), cuts.end(), [&](const CutPlace& cut) { return same(cut, place); });
}

/// In whatever order.
bool same(const std::vector<CutPlace>& a, const std::vector<CutPlace>& b) {
  return a.size() == b.size() && std::all_of(a.begin(), a.end(), [&](const CutPlace& cut) { return has(b, cut); });
}

/// A set of cuts that others may be found from: foreseen, or forecast.
struct Prospect {
  Trial trial;
  double before = 0;                       ///< excess of the set that it is one cut more or less than
  double growth_before = 0;                ///< the boundary without its last cut, as Trial::growth
  double gain = 0;                         ///< of that, as it is foreseen
  const SqueezedTrial* present = nullptr;  ///< that set, where it is one cut more
  double less_strain = 0;                  ///< than that set has
  bool is_forecast = false;
  int expansion = 0;  ///< in which it was found

  bool is_one_less() const { return gain < 0; }
  /// By the last cut: along edges of faces it may be much longer than straight.
  double growth() const { return trial.growth - growth_before; }
};

/// What cuts save of the excess, learnt from forecasts.
class Savings {
 public:
  /// `foreseen`: what was expected of it; 0 where nothing was.
  void learn(const CutPlace& place, double before, double less_strain, double foreseen, double gain) {
    if (less_strain > 0) {
      strain_ += less_strain;
      for_strain_ += std::exp(before) * std::max(0.0, 1 - std::exp(-gain));
    } else {
      near_ += place.released / std::exp(before);
      relaxed_ += std::max(0.0, 1 - std::exp(-gain));
    }
    if (foreseen > 0) {
      foreseen_ += foreseen;
      came_ += std::max(0.0, gain);
    }
    const auto known = find(place);
    if (known == known_.end()) {
      known_.push_back({place, gain});
    } else {
      known_[known - known_.begin()].gain = gain;
    }
  }

  /// `less_strain`: with it, where outlines tell.
  double foresee(const CutPlace& place, double less_strain, double before) const {
    const auto known = find(place);
    if (known != known_.end() && less_strain == 0) return known->gain;
    const double near = (kPriorNear * kLikelyShare + relaxed_) / (kPriorNear + near_) * place.released;
    const double packed = (kPriorStrain + for_strain_) / (kPriorStrain + strain_) * std::max(0.0, less_strain);
    return -std::log(1 - std::min(kMostShare, (near + packed) / std::exp(before)));
  }

  /// The part of what was foreseen that forecasts have come to so far.
  double faith() const { return (kPrior * kInherited + came_) / (kPrior + foreseen_); }

  /// Places that save something, and are not among these, added.
  void add_useful(std::vector<CutPlace>& places) const {
    for (const Saving& saving : known_) {
      if (saving.gain > kLeastGain && !has(places, saving.place)) places.push_back(saving.place);
    }
  }

 private:
  struct Saving {
    CutPlace place;
    double gain;
  };

  std::vector<Saving>::const_iterator find(const CutPlace& place) const {
    return std::find_if(known_.begin(), known_.end(), [&](const Saving& s) { return same(s.place, place); });
  }

  std::vector<Saving> known_;
  double near_ = 0, relaxed_ = 0, foreseen_ = 0, came_ = 0, strain_ = 0, for_strain_ = 0;
};

Prospect taken_from(std::vector<Prospect>& prospects, std::vector<Prospect>::iterator at) {
  Prospect out = std::move(*at);
  prospects.erase(at);
  return out;
}

/// What the search goes by: as far above `limit`, the excess to come to, as the forecast exceeds the limits that are set. Under
/// one of stretch less a part of how far E_d is below that: where stretch is local the first cuts hardly change it.
double steering_excess(const Wish& wish, const Bias& bias, double limit, const Trial& trial) {
  const double distortion = bias.distortion_of(trial);
  const double steered = limit + wish.above_limits(distortion, bias.stretch_of(trial));
  return steered - kElsewhere * std::max(0.0, steered - excess(distortion));
}

/// Sets that the search may go on with, and which of them first.
class Frontier {
 public:
  Frontier(const CutTrials& trials, const Wish& wish) : trials_(trials), wish_(wish) {}

  void aim_at(double limit) { limit_ = limit; }
  /// As an E_d; 0 where nothing keeps the limit, which a budget of seams has: all is far above.
  double aim() const { return limit_ > excess(1) ? 1 + std::exp(limit_) : 0; }
  bool empty() const { return open_.empty(); }
  bool is_near(const Trial& trial) const { return likely_excess(trial) <= limit_ + kNear; }

  void learn(const SqueezedTrial& squeezed) { bias_.learn(squeezed); }
  const Bias& bias() const { return bias_; }
  double likely_excess(const Trial& trial) const { return steering_excess(wish_, bias_, limit_, trial); }

  /// The cut that saves most for its length beside those that there are; where none of these is left, back to what promises to
  /// keep the limit with the least boundary. Nothing where none promises to do so with less than `enough`.
  std::optional<Prospect> next(double enough) {
    const auto hopeful =
        std::stable_partition(open_.begin(), open_.end(), [&](const Prospect& p) { return promise(p) < enough; });
    if (hopeful == open_.begin()) return std::nullopt;
    const auto last =
        std::stable_partition(open_.begin(), hopeful, [&](const Prospect& p) { return p.expansion == expansions_; });
    return taken_from(
        open_,
        last == open_.begin()
            ? std::min_element(last, hopeful, [&](const auto& a, const auto& b) { return promise(a) < promise(b); })
            : std::max_element(open_.begin(), last, [&](const auto& a, const auto& b) { return rate_of(a) < rate_of(b); }));
  }

  /// What is foreseen is rough: what needs much less boundary may do more than that.
  std::optional<Prospect> surprising(double enough) {
    const auto may = std::stable_partition(open_.begin(), open_.end(), [&](const Prospect& p) {
      return !p.is_forecast && !p.is_one_less() && p.trial.growth < kMuchLess * enough;
    });
    if (may == open_.begin()) return std::nullopt;
    return taken_from(
        open_, std::max_element(open_.begin(), may, [&](const auto& a, const auto& b) { return rate_of(a) < rate_of(b); }));
  }

  /// One cut more, at each of these places and of those that have saved something before.
  void add_more(const Trial& present, const SqueezedTrial* squeezed, std::vector<CutPlace> places, double most_growth) {
    ++expansions_;
    savings_.add_useful(places);
    const Previews previews = trials_.previews(present, places);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const CutPlace& place = places[k];
      const auto& [growth, strain] = previews.with[k];
      Trial trial{.cuts = present.cuts, .growth = present.growth + growth};
      trial.cuts.push_back(place);
      if (has(present.cuts, place) || !std::isfinite(growth) || trial.growth > kRoughly * most_growth) continue;
      const double before = likely_excess(present);
      const double less_strain = strain ? previews.strain - *strain : 0;
      foresee({std::move(trial), before, present.growth, savings_.foresee(place, less_strain, before), squeezed, less_strain});
    }
  }

  /// One cut less: what it saved when it was added is the most that it saves now.
  void add_less(const Trial& present) {
    for (std::size_t k = 0; k < present.cuts.size() && present.cuts.size() > 1; ++k) {
      Trial trial{.cuts = present.cuts, .growth = present.growth - trials_.growth_of(present.cuts[k])};
      trial.cuts.erase(trial.cuts.begin() + static_cast<std::ptrdiff_t>(k));
      const double before = likely_excess(present);
      const double lost = kRemoved * std::max(kLeastGain, savings_.foresee(present.cuts[k], 0, before));
      foresee({std::move(trial), before, 0, -lost});
    }
  }

  /// One that was forecast: kept where it is better than without its last cut or, with one cut less, no worse than the limit.
  void add_forecast(Prospect prospect) {
    prospect.is_forecast = true;
    const double gain = gain_of(prospect);
    if (!prospect.is_one_less()) {
      savings_.learn(prospect.trial.cuts.back(), prospect.before, prospect.less_strain, prospect.gain, gain);
      if (gain < kLeastGain) return;
      best_rate_ = std::max(best_rate_, gain / (prospect.growth() + kShortest));
      least_growth_ = std::min(least_growth_, prospect.growth());
    } else if (!is_near(prospect.trial)) {
      return;
    }
    open_.push_back(std::move(prospect));
  }

 private:
  double gain_of(const Prospect& prospect) const {
    if (prospect.is_forecast) return prospect.before - likely_excess(prospect.trial);
    return (prospect.gain > 0 ? savings_.faith() : 1) * prospect.gain;
  }

  /// Saved for the growth of the last cut; beyond the limit nothing is worth any.
  double rate_of(const Prospect& prospect) const {
    const double gain = std::min(gain_of(prospect), prospect.before - limit_);
    return gain / (prospect.growth() + kShortest);
  }

  /// The growth with which a set will keep the limit: further cuts save half as much for their length as the best so far, and are
  /// no shorter than the shortest.
  double promise(const Prospect& prospect) const {
    const double left = prospect.before - gain_of(prospect) - limit_;
    if (left <= 0) return prospect.trial.growth;
    return prospect.trial.growth + std::max(least_growth_, left / (kHopeful * best_rate_));
  }

  void foresee(Prospect prospect) {
    const std::vector<CutPlace>& cuts = prospect.trial.cuts;
    if (std::any_of(seen_.begin(), seen_.end(), [&](const auto& other) { return same(other, cuts); })) return;
    seen_.push_back(cuts);
    prospect.expansion = expansions_;
    open_.push_back(std::move(prospect));
  }

  const CutTrials& trials_;
  const Wish& wish_;
  double limit_ = 0;  ///< what to come to, as excess
  std::vector<Prospect> open_;
  std::vector<std::vector<CutPlace>> seen_;
  Savings savings_;
  double best_rate_ = 0.1, least_growth_ = 1;
  Bias bias_;
  int expansions_ = 0;
};

class LimitSearch {
 public:
  LimitSearch(const CutTrials& trials, const RefineOptions& options, const ProgressRange& range, Outcomes& found)
      : trials_(trials),
        wish_{options, trials.growth_weight()},
        budget_(budget_of(options.effort)),
        rest_(range),
        found_(found),
        frontier_(trials, wish_) {}

  void run() {
    const SqueezedTrial& whole = found_.squeezed.front();
    if (wish_.is_enough(whole.trial)) return;
    frontier_.learn(whole);
    frontier_.aim_at(wish_.aim(whole.trial));
    start_from(whole);
    while (!trials_.finishing() && static_cast<int>(found_.squeezed.size()) <= budget_.squeezes) {
      auto next = this->next();
      if (!next) break;
      if (next->is_forecast) {
        look_at(*next);
      } else if (may_forecast() || (next->is_one_less() && found_.tried < budget_.forecasts)) {
        forecast(std::move(*next));
      }
    }
    if (best_passed_ && !keeps_limit() && is_better(*best_passed_, found_.best(wish_).trial)) squeeze(*best_passed_);
  }

 private:
  ProgressRange step() {
    const ProgressRange out = rest_.part(0, 0.2);
    rest_ = rest_.part(0.2, 1);
    return out;
  }

  std::optional<Prospect> next() {
    const double enough = keeps_limit() ? found_.best(wish_).trial.growth : std::numeric_limits<double>::infinity();
    auto out = frontier_.next(enough);
    return out || surprises_++ >= budget_.surprises ? std::move(out) : frontier_.surprising(enough);
  }

  bool keeps_limit() { return wish_.is_enough(found_.best(wish_).trial); }
  bool is_better(const Trial& a, const Trial& b) const { return frontier_.likely_excess(a) < frontier_.likely_excess(b); }
  ForecastTerms terms() const { return {most_growth_, frontier_.bias(), frontier_.aim()}; }
  bool may_forecast() { return found_.tried < (keeps_limit() ? budget_.improving : budget_.forecasts); }

  /// The most promising are forecast side by side.
  void start_from(const SqueezedTrial& whole) {
    expand(whole.trial, &whole);
    std::vector<Prospect> first;
    while (static_cast<int>(first.size()) < budget_.first) {
      auto next = frontier_.next(std::numeric_limits<double>::infinity());
      if (!next) break;
      first.push_back(std::move(*next));
    }
    std::vector<std::vector<CutPlace>> sets;
    for (const Prospect& prospect : first) sets.push_back(prospect.trial.cuts);
    const auto trials = trials_.forecasts(sets, &whole, terms(), step());
    for (std::size_t k = 0; k < first.size(); ++k) {
      ++found_.tried;
      if (!trials[k]) continue;
      first[k].trial = std::move(*trials[k]);
      frontier_.add_forecast(std::move(first[k]));
    }
  }

  void expand(const Trial& present, const SqueezedTrial* squeezed) {
    const int places = present.cuts.empty() ? budget_.first_places : budget_.places;
    frontier_.add_more(present, squeezed, trials_.places(present, places, budget_.tips), most_growth_);
  }

  void forecast(Prospect prospect) {
    auto trial = trials_.forecasts({prospect.trial.cuts}, prospect.present, terms(), step()).front();
    if (!trial) return;
    ++found_.tried;
    prospect.trial = std::move(*trial);
    frontier_.add_forecast(std::move(prospect));
  }

  /// Squeezed, and others found from there. Pieces that are placed anew with every cut are only squeezed where that may be the
  /// end; once no more can be forecast, or where that may be the best there is.
  void look_at(const Prospect& prospect) {
    const bool is_best = !keeps_limit() && is_better(prospect.trial, found_.best(wish_).trial);
    const bool is_near = frontier_.is_near(prospect.trial);
    if (may_forecast() && !is_near && trials_.places_anew()) {
      if (!best_passed_ || is_better(prospect.trial, *best_passed_)) best_passed_ = prospect.trial;
      return expand(prospect.trial, nullptr);
    }
    if (!may_forecast() && !is_near && !is_best) return;
    squeeze(prospect.trial);
  }

  void squeeze(const Trial& trial) {
    auto squeezed = trials_.squeezed(trial, step());
    if (!squeezed) return;
    frontier_.learn(*squeezed);
    const SqueezedTrial& found = found_.squeezed.emplace_back(std::move(*squeezed));
    if (wish_.is_enough(found.trial)) {
      frontier_.add_less(found.trial);
    } else if (may_forecast()) {
      expand(found.trial, &found);
    }
  }

  const CutTrials& trials_;
  Wish wish_;
  double most_growth_ = wish_.options.max_boundary_growth.value_or(std::numeric_limits<double>::infinity());
  Budget budget_;
  ProgressRange rest_;
  Outcomes& found_;
  Frontier frontier_;
  int surprises_ = 0;
  std::optional<Trial> best_passed_;  // of those that others were found from but that were not squeezed
};

}  // namespace

void cut_to_limit(const CutTrials& trials, const RefineOptions& options, const ProgressRange& range, Outcomes& found) {
  LimitSearch(trials, options, range, found).run();
}

}  // namespace atlas_refine
