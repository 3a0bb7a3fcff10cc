// Stage 1 of the paper: every chart deformed until its boundary is axis-aligned (section 3.1).
#pragma once

#include <vector>

#include "cut/side_prices.h"
#include "geometry/axis_aligned_chart.h"
#include "geometry/freedom.h"
#include "support/monitor.h"

namespace atlas_refine {

struct AlignOptions {
  double sigma = 0.004;  ///< eq. (3), as a fraction of the boundary's length
  int threads = 1;
  Freedoms freedom = {};                ///< charts that do not bend come back as they are
  std::vector<SidePrices> prices = {};  ///< of cuts that open holes, one per chart; empty: 1 for all
};

/// Aligns every chart. Charts must be free of flips; they may overlap themselves.
std::vector<AxisAlignedChart> align_charts(const std::vector<Chart>& charts, const AlignOptions& options, Monitor& monitor);

}  // namespace atlas_refine
