// Many charts of like height side by side, row upon row.
#pragma once

#include <cmath>
#include <vector>

#include "pack/pack_charts.h"
#include "pack/watch.h"

namespace atlas_refine {

struct RowOptions {
  double gap = 0;
  double box_aspect = 0;     ///< width / height, 0 = free
  double enough = INFINITY;  ///< area of the box
};

/// Each chart in a turn that lays an edge of its hull on the floor or the ceiling of its row, beside the one whose side it fits
/// best. Thousands of single faces are packed so more densely than a search for the lowest place has them, and far sooner; rows
/// of round charts leave much free. No placements where no box was found that is small enough, soon where it is far from that.
std::vector<Placement> pack_in_rows(const std::vector<Outline>& outlines, const RowOptions& options, Watch& watch);

}  // namespace atlas_refine
