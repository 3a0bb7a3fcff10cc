// The triangles of a chart that are not positive in the UV plane.
#pragma once

#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

/// One flag per triangle: flipped, without area, or positive by rounding only: a sliver.
std::vector<char> bad_triangles(const Chart& chart);

/// E_2 of `after` to the UVs of `before`, over the triangles that are positive there.
double distortion_to_good(const Chart& before, const Chart& after);

}  // namespace atlas_refine
