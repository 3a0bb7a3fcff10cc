// The road without cuts: charts stay whole, are placed anew, and bend as far as the bound needs (the squeeze).
#pragma once

#include <optional>

#include "report/solution.h"

namespace atlas_refine {

/// Scales the charts of the input, mended or not, to the density that is asked for. True where that changed their relative
/// scales.
bool set_wanted_density(const Refinement& run, std::vector<Chart>& charts);

/// The charts of the input, free of flips and crossings, at their wanted densities.
struct WholeCharts {
  CutAtlas atlas;            ///< a piece each, seams where one was opened
  bool keeps_place = false;  ///< they may start where they lie
  std::vector<int> mended;   ///< charts
};
WholeCharts whole_charts(const Refinement& run, const ProgressRange& range);

/// The least intervention that holds the bound, or, where none does, the best that was found. Throws UnmendedCharts.
Solution refine_whole(const Refinement& run, const ProgressRange& range);

/// E_d that the charts would have without cuts at the bound; nothing where that is above `most`, or a chart cannot be made
/// valid.
std::optional<double> distortion_without_cuts(const Refinement& run, double most);

}  // namespace atlas_refine
