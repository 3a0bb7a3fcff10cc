// What one more cut is likely to save, learnt from those that were forecast.
#pragma once

#include <vector>

#include "seams/cut_places.h"

namespace atlas_refine {

inline constexpr double kLeastGain = 0.01;  ///< of the logarithm of E_d - 1: less is none

bool has(const std::vector<CutPlace>& cuts, const CutPlace& place);

/// In whatever order.
bool same(const std::vector<CutPlace>& a, const std::vector<CutPlace>& b);

bool has_any(const std::vector<std::vector<CutPlace>>& sets, const std::vector<CutPlace>& cuts);

/// What cuts save of the excess.
class Savings {
 public:
  /// `foreseen`: what was expected of it; 0 where nothing was.
  void learn(const CutPlace& place, double before, double less_strain, double foreseen, double gain);

  /// `less_strain`: with it, where outlines tell.
  double foresee(const CutPlace& place, double less_strain, double before) const;

  /// The part of what was foreseen that forecasts have come to so far.
  double faith() const;

  /// Places that save something, and are not among these, added.
  void add_useful(std::vector<CutPlace>& places) const;

 private:
  struct Saving {
    CutPlace place;
    double gain;
  };

  std::vector<Saving>::const_iterator find(const CutPlace& place) const;

  std::vector<Saving> known_;
  double near_ = 0, relaxed_ = 0, freeable_ = 0, freed_ = 0, foreseen_ = 0, came_ = 0, strain_ = 0, for_strain_ = 0;
};

}  // namespace atlas_refine
