// Trails replaced by paths along the edges of the input's polygons (section 4.1, "Cutting along the existing edges").
#pragma once

#include <vector>

#include "cut/cut_atlas.h"
#include "cut/side_prices.h"
#include "geometry/axis_aligned_chart.h"
#include "layout/trail_paths.h"

namespace atlas_refine {

/// Where charts are to be cut instead of along their trails: edges of `charts`, whose pieces they are, each once and each between
/// two parts of its chart. Every trail becomes a shortest edge path near it that joins what the trail joins, and so do the cuts
/// that open holes; what then bounds no part, or only a sliver, is left whole. Trails that no edges run along are left out.
/// Differs from the paper: lengths count times `prices` (one per chart) and grow with the distance from the trail.
std::vector<SurfacePath> edge_paths(const std::vector<AxisAlignedChart>& aligned, const std::vector<Chart>& charts,
                                    const TracedTrails& traced, const std::vector<SidePrices>& prices, int threads);

}  // namespace atlas_refine
