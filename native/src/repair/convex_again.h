// Polygons that an embedding has made concave, convex again.
#pragma once

#include "geometry/chart.h"
#include "support/monitor.h"

namespace atlas_refine {

bool all_guards_hold(Chart chart);

/// The valid chart with its UVs changed around polygons whose guards are broken, so that these hold and the chart is still valid:
/// around all of them or, where that is not to be had, around as many as can be mended one after the other.
Chart convex_again(const Chart& chart, int threads, Monitor& monitor);

}  // namespace atlas_refine
