// The search for a packing on the grid: greedy starts, then separations in ever smaller boxes.
#pragma once

#include "pack/layout.h"

namespace atlas_refine {

/// Placements of two or more outlines, not yet moved to the origin. `dilated_area` is about what they take with their gaps.
std::vector<Placement> search_on_grid(const std::vector<Outline>& outlines, double area, double dilated_area,
                                      const PackOptions& options);

}  // namespace atlas_refine
