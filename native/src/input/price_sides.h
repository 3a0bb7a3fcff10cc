// What seams along the edges of the input's polygons cost (section 4.1, "Cutting along the existing edges").
#pragma once

#include <vector>

#include "atlas_refine/options.h"
#include "cut/side_prices.h"
#include "input/split_charts.h"

namespace atlas_refine {

/// One per chart of `set`. With Cut::Edges diagonals of polygons and `no_seam` edges must stay whole, sharp edges cost down to
/// half of flat ones, such as other parts of the mesh hide half of those seen from all sides, and `prefer_seam` edges a tenth.
/// With Cut::Split only `no_seam` edges differ from the others; empty where there are none.
std::vector<SidePrices> price_sides(const Atlas& atlas, const ChartSet& set, const RefineOptions& options);

}  // namespace atlas_refine
