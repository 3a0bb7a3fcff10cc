// Polygons that an embedding has made concave, convex again.
#pragma once

#include "geometry/chart.h"
#include "support/monitor.h"

namespace atlas_refine {

bool all_guards_hold(Chart chart);

/// The chart, whose triangles are positive and overlap only where they may, with its UVs changed around polygons whose guards are
/// broken, so that these hold: around all of them or, where that is not to be had, around as many as can be mended one after the
/// other.
Chart convex_again(const Chart& chart, bool may_overlap, int threads, Monitor& monitor);

}  // namespace atlas_refine
