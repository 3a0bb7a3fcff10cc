// The triangles of a chart that are not positive in the UV plane.
#pragma once

#include <vector>

#include "geometry/chart.h"
#include "measure/distortion.h"

namespace atlas_refine {

/// One flag per triangle: flipped, without area, or positive by rounding only: a sliver.
std::vector<char> bad_triangles(const Chart& chart);

/// From the surface to the UVs, over the other triangles: best_energy() is their E_d.
DirichletSums sums_of_good(const Chart& chart);

/// E_2 of `after` to the UVs of `before`, over the triangles that are positive there.
double distortion_to_good(const Chart& before, const Chart& after);

}  // namespace atlas_refine
