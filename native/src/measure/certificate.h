// The validity certificate: exact predicates on the values that are stored.
#pragma once

#include <vector>

#include "atlas_refine/measures.h"
#include "geometry/chart.h"

namespace atlas_refine {

/// Exact check of placed charts: every triangle strictly positive, no two boundary edges (of one chart or of two) that cross
/// or touch except neighbours at their common vertex. Also finds charts that lie wholly inside another chart's interior.
/// `chart` and `face` of the answer refer to `charts` and Chart::triangle_faces.
Validity certify_charts(const std::vector<Chart>& charts);

/// Smallest distance between boundaries of two different charts, absolute; infinity with fewer than two charts.
double gap_between_charts(const std::vector<Chart>& charts);

/// For each chart the smallest distance, absolute, between a boundary vertex and a boundary edge of the same loop that face
/// each other through the outside and whose distance along the boundary is at least `far_arc`; infinity where there is none.
std::vector<double> gap_within_charts(const std::vector<Chart>& charts, double far_arc);

}  // namespace atlas_refine
