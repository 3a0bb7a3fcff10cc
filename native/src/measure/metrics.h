// The figures of measures.h, from charts.
#pragma once

#include <vector>

#include "atlas_refine/measures.h"
#include "geometry/chart.h"

namespace atlas_refine {

/// Everything that the charts alone tell: all but boundary_length, seam_edges and distortion_to_input.
Measures measure_charts(const std::vector<Chart>& charts, double box_aspect);

}  // namespace atlas_refine
