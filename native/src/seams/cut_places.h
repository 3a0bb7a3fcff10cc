// Where a cut may pay: necks of charts, where distortion is pent up, and points that no chart can lie flat around.
#pragma once

#include <vector>

#include "seams/chart_cuts.h"

namespace atlas_refine {

inline constexpr double kLeastPart = 0.02;  ///< of its chart's area: less is not worth a seam

/// Of so few all pieces are placed anew with every cut, and the one that loses most is looked at closely; of more pieces stay
/// where they lie, and each has little of what is lost.
inline constexpr std::size_t kFewCharts = 8;

/// A cut that may pay.
struct CutPlace {
  int chart;
  Chord chord;
  double released = 0;  ///< distortion that is near enough to relax
  double freed = 0;     ///< distortion, wherever it is, that is there because of the hole that the cut opens

  /// That is more than what is near it.
  bool opens_hole() const { return freed > released; }
};

/// Distortion that is pent up in a part of a chart.
struct Loss {
  Vec2 at;        ///< in the chart as repaired
  double amount;  ///< of all charts it sums up to E_d - 1
};

/// What is known of a chart.
struct ChartState {
  const ChartCuts* cuts;  ///< those that it has
  const Chart* chart;     ///< as repaired
  std::vector<Loss> losses;
};

/// At most `straight` across charts: the shortest ways along edges that open holes, then, best first, in turn by how short they
/// are for what they cut off and by how much distortion is near them for their length; then at most `tips` ways to points of high
/// curvature. Charts of `states` without cuts of their own (nullptr) are left alone.
std::vector<CutPlace> cut_places(const std::vector<ChartState>& states, int straight, int tips);

}  // namespace atlas_refine
