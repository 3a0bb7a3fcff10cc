// Polygons that an embedding has made concave, convex again.
#pragma once

#include "geometry/chart.h"
#include "support/monitor.h"

namespace atlas_refine {

bool all_guards_hold(Chart chart);

/// The valid chart with its UVs changed around polygons whose guards are broken, where all guards hold after that and the chart
/// is still valid; else as it was.
Chart convex_again(const Chart& chart, int threads, Monitor& monitor);

}  // namespace atlas_refine
