// How far from its bad triangles a chart lies on itself: what moves near them cannot part it there.
#pragma once

#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

/// `ring`: edges between each vertex and the nearest bad triangle. The largest r for which a vertex of ring r or more lies well
/// inside a triangle whose corners all are; 0 without one. Where only vertices of rings below r may move, the chart will
/// overlap itself whatever they do.
int overlap_depth(const Chart& chart, const std::vector<int>& ring);

}  // namespace atlas_refine
