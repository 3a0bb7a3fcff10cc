// The triangles of a chart that are not positive in the UV plane, or hardly.
#pragma once

#include <vector>

#include "geometry/chart.h"
#include "measure/distortion.h"

namespace atlas_refine {

/// One flag per triangle: flipped, without area, positive by rounding only (a sliver), or crushed against its shape on the
/// surface as the chart as a whole is not.
std::vector<char> bad_triangles(const Chart& chart);

/// The same, and triangles at a vertex of a bad one that are positive and yet drawn out with it: their stretch against the
/// surface is far from what the chart has elsewhere. They have no shape to keep.
std::vector<char> misshapen_triangles(const Chart& chart);

/// The same, and triangles drawn out many times farther than the chart is elsewhere: at a vertex that was dragged away. Their
/// area tells nothing of the chart's texel density.
std::vector<char> triangles_out_of_scale(const Chart& chart);

/// Whether most of the chart's surface lies in `bad` triangles: then there is no shape to keep, and no size.
bool mostly_bad(const Chart& chart, const std::vector<char>& bad);

/// From the surface to the UVs, over the triangles that are not bad: best_energy() is their E_d.
DirichletSums sums_of_good(const Chart& chart);

/// E_d above which a chart is all but a line: its shape is not worth keeping.
inline constexpr double kLine = 100;

/// E_2 of `after` to the UVs of `before`, over the triangles that have a shape there.
double distortion_to_good(const Chart& before, const Chart& after);

}  // namespace atlas_refine
