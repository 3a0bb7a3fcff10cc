// Charts placed anew by the packer, the gap given as the fraction of a box that is only known afterwards.
#pragma once

#include <cstdint>
#include <vector>

#include "atlas_refine/options.h"
#include "geometry/chart.h"
#include "support/monitor.h"

namespace atlas_refine {

struct PlaceOptions {
  Gap gap;
  double box_aspect = 0;
  double target_pe = 1;  ///< good enough: stop searching there
  std::uint64_t seed = 1;
  int threads = 1;
};

/// The same charts, rigidly moved, at least the gap apart. Their scales and shapes are kept.
std::vector<Chart> place_charts(const std::vector<Chart>& charts, const PlaceOptions& options, Monitor& monitor);

}  // namespace atlas_refine
