// What an atlas with some cuts comes to: forecast on coarse charts, or squeezed to the end.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/solution.h"
#include "seams/cut_places.h"
#include "whole.h"

namespace atlas_refine {

struct SqueezedTrial;

/// The outcome of some cuts.
struct Trial {
  std::vector<CutPlace> cuts;  ///< in the order in which they are made
  double growth = 0;           ///< of the boundary on the surface, as a fraction of that of the charts; both sides of a cut count
  double distortion = 0;       ///< E_d; infinite where the bound does not hold
  /// What they are one cut more than, where the pieces are best left in its layout; else they are placed anew.
  const SqueezedTrial* in_place_of = nullptr;
};

/// The same squeezed to the end.
struct SqueezedTrial {
  Trial trial;
  Solution solution;
  std::vector<std::string> fallbacks = {}, warnings = {};  ///< told on the way
};

class CutTrials {
 public:
  /// `run`: without a largest distortion.
  CutTrials(const Refinement& run, const ProgressRange& range);

  /// What there is will do.
  bool finishing() const { return run_.monitor.finishing(); }

  const std::vector<int>& mended() const { return whole_.mended; }

  /// The first to be asked for.
  SqueezedTrial without_cuts(const ProgressRange& range);
  /// Of what was forecast; nothing where the bound does not hold.
  std::optional<SqueezedTrial> squeezed(const Trial& trial, const ProgressRange& range) const;

  /// What one more cut than `present` has comes to, and what one cut less does: one trial for each that can be made, leaves no
  /// slivers, adds at most `most_growth` and holds the bound. `present` must outlive them.
  std::vector<Trial> forecasts(const SqueezedTrial& present, const std::vector<CutPlace>& places, double most_growth,
                               const ProgressRange& range) const;

  /// Where one more cut may pay; at most `most`.
  std::vector<CutPlace> places(const SqueezedTrial& present, int most) const;

 private:
  std::optional<std::vector<ChartCuts>> made(const std::vector<CutPlace>& cuts) const;
  std::optional<CutAtlas> atlas_of(const std::vector<ChartCuts>& charts) const;
  std::optional<Trial> forecast(const std::vector<CutPlace>& cuts, const SqueezedTrial* present, double most_growth) const;
  std::optional<CutAtlas> in_place(const std::vector<ChartCuts>& charts, const CutAtlas& atlas,
                                   const SqueezedTrial& present) const;
  double growth_of(const std::vector<ChartCuts>& charts) const;
  bool leaves_slivers(const std::vector<ChartCuts>& charts) const;
  std::vector<std::vector<double>> losses(const Solution& solution) const;
  double distortion_of(const Solution& solution) const;

  const Refinement& run_;
  Freedoms freedom_;
  WholeCharts whole_;
  std::vector<SidePrices> prices_;
  double boundary_;    // of all charts, on the surface
  double offset_ = 0;  // E_d less the objective, which other densities, shapes or weights make differ
};

}  // namespace atlas_refine
