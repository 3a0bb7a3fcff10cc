// Sets of cuts found one after the other, along growing boundary.
#pragma once

#include <deque>
#include <vector>

#include "needed/cut_outcomes.h"
#include "needed/cut_savings.h"
#include "needed/cut_trials.h"

namespace atlas_refine {

/// A set of cuts: foreseen, then forecast.
struct CutSet {
  Trial trial;
  double before = 0;                       ///< excess of the set that it is one cut more or less than
  double gain = 0;                         ///< of that, as it is foreseen; negative of one cut less
  const SqueezedTrial* present = nullptr;  ///< that set, where it is one cut more
  double less_strain = 0;                  ///< than that set has
  double price = 1;                        ///< of the edges of its cuts, the mean for each length
  int together = 1;                        ///< so many cuts more than that set has
  bool is_forecast = false;
  double excess = 0;  ///< as it is forecast
  bool is_out = false;
  const SqueezedTrial* squeezed = nullptr;
  bool fails = false;  ///< squeezed, it does not hold the bound

  double cost() const { return price * trial.growth; }
};

/// The path knows neither limits nor budgets: they only say where it ends, and which of its sets is taken. What it has passed it
/// does not come back to. So a larger budget has all that a smaller one has to choose from, and a looser limit ends no later.
class CutPath {
 public:
  /// `thorough`: more is forecast a step, which is one of boundary. `found` has the charts without cuts.
  CutPath(const CutTrials& trials, const RefineOptions& options, bool thorough, const ProgressRange& range, Outcomes& found);

  /// Passes another set; false at the end, where all is passed, or nothing is left that adds at most `most_growth`.
  bool advance(double most_growth);
  /// All sets with as much boundary that the path will come to are known.
  double passed() const { return passed_; }
  /// What was passed and adds at most that: sets that none whose seams cost less is as good as, by growing cost; that is their
  /// boundary, by the prices of its edges where seams run along edges.
  std::vector<CutSet*> front(double most_growth);
  double likely_distortion(const CutSet& set) const { return bias_.distortion_of(set.trial); }
  double likely_stretch(const CutSet& set) const { return bias_.stretch_of(set.trial); }
  /// Nothing where it does not hold the bound.
  const SqueezedTrial* squeeze(CutSet& set);
  /// Forecast without the last cuts of those that were added together; nothing where that is known or does not hold the bound.
  CutSet* with_fewer(const CutSet& set, int less);

 private:
  double measured(const Trial& trial) const;
  double foreseen(const CutSet& set) const;
  double rate_of(const CutSet& set) const;
  std::vector<CutSet*> ahead(double reach);
  bool may_forecast() const;
  bool takes_risks() const;
  CutSet* next(double reach);
  void forecast(const std::vector<CutSet*>& sets);
  void pass(CutSet& set);
  void expand(const Trial& present, double own_price, double before, const SqueezedTrial* squeezed);
  void add_together(const Trial& present, std::size_t first);
  bool add_with_one_less(const CutSet& set);
  bool add(CutSet set);
  ProgressRange step();

  const CutTrials& trials_;
  const RefineOptions& options_;
  bool is_thorough_;
  bool is_stuck_ = false;  ///< nothing that is left promises to save anything
  int risks_ = 0;          ///< forecasts where that was so
  ProgressRange rest_;
  Outcomes& found_;
  double together_ = 0;  ///< growth by a cut in each of several charts
  int tried_before_;     ///< by other paths
  std::deque<CutSet> sets_;
  std::vector<std::vector<CutPlace>> pruned_;
  double passed_ = 0, best_ = 0;  ///< boundary, and least excess up to there
  Savings savings_;
  Bias bias_;
};

}  // namespace atlas_refine
