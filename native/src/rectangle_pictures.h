// Pictures of one chart on the paper's road (Fig. 5 and 7): smoothed directions, target angles, axis-aligned, trails, rectangles.
#pragma once

#include <vector>

#include "atlas_refine/debug_sink.h"
#include "geometry/axis_aligned_chart.h"
#include "layout/axis_trails.h"

namespace atlas_refine {

/// Of the chart with the largest area. `charts` are what `aligned` was made from, `trails` those that are cut along.
std::vector<AtlasSnapshot> rectangle_pictures(const std::vector<Chart>& charts, const std::vector<AxisAlignedChart>& aligned,
                                              const std::vector<std::vector<TrailStart>>& trails, double sigma);

}  // namespace atlas_refine
