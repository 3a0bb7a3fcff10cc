// The search for a packing: greedy starts on a grid, separations in ever
// smaller boxes, exact compaction of the best.
#pragma once

#include <vector>

#include "pack/pack_charts.h"

namespace atlas_refine {

/// Placements of two or more outlines; their box lies anywhere. `area` is the
/// sum of the charts' areas.
std::vector<Placement> search_on_grid(const std::vector<Outline>& outlines, double area, const PackOptions& options);

}  // namespace atlas_refine
