// Where charts are placed before any is bent, and the gap that is left between them.
#pragma once

#include <vector>

#include "geometry/freedom.h"
#include "pack/place_charts.h"
#include "report/solution.h"

namespace atlas_refine {

inline constexpr double kStoredSpare = 1 + 1e-6;  ///< times the bound: storing single precision must not lose it

/// Where charts lie, and the gap that was left between them.
struct Placing {
  PlacedCharts placed;
  Gap gap;
};

/// Those that are not locked.
std::vector<Chart> movable_of(const std::vector<Chart>& charts, const Freedoms& freedom);

DistortionLimits limits_of(const RefineOptions& options);

double packing_efficiency(const PlacedCharts& placed, double aspect);
bool gap_kept(const Refinement& run, const PlacedCharts& placed, const Freedoms& freedom, const Gap& gap);
/// They reach the bound times `spare`, within the limits of distortion.
bool holds_bound(const Refinement& run, const PlacedCharts& placed, double spare = 1);

/// Rectangles go on to the optimum under the bound, unless that was not to be or there are thousands of charts to bend.
bool goes_on(const Refinement& run, std::size_t charts);

/// Thousands of charts are in each other's way: bending them takes a minute, and a little less gap spares it.
bool rather_moves(const Refinement& run, std::size_t charts);

/// `good_enough`: the PE at which no better one is looked for. Throws RefineError(BoundNotReached) where locked charts leave the
/// others no room.
PlacedCharts place(const Refinement& run, const std::vector<Chart>& charts, const Freedoms& freedom, const Gap& gap,
                   double good_enough, PackSearch search = PackSearch::Thorough);

/// The gap that was asked for, or those that may be, the largest first. `most_taken`: of the box, with half the gap around
/// charts.
std::vector<Gap> gaps_of(const Refinement& run, const std::vector<Chart>& charts, const Freedoms& freedom, double most_taken = 1);

/// Placed with the first of the gaps to be tried with which placing the charts is enough, else with the first that was tried.
Placing place_with(const Refinement& run, const std::vector<Chart>& charts, const Freedoms& freedom, double good_enough,
                   const std::vector<Gap>& gaps);

/// Of all gaps those that may be kept by charts that bend, or that begin with the one that placing them left.
std::vector<Gap> gaps_to_squeeze_with(const Refinement& run, const std::vector<Chart>& pieces, const Freedoms& freedom,
                                      const Placing& placing, std::vector<Gap> gaps);

}  // namespace atlas_refine
