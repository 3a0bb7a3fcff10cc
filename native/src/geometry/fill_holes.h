// What fills the holes of a chart, so that it becomes a disk.
#pragma once

#include "geometry/chart.h"

namespace atlas_refine {

struct Filling {
  std::vector<std::size_t> fans;    ///< boundary loops that a fan around a vertex of their own fills
  std::vector<Triangle> triangles;  ///< that fill the other holes, over the chart's vertices, counterclockwise
};

/// Fans in all holes but loop `outer`.
Filling fill_by_fans(const Chart& chart, std::size_t outer);

/// Holes as the UVs have them, triangulated (constrained Delaunay); fans where their borders cross or touch themselves there. A
/// flap that reaches far into its hole then hangs on the border opposite, where a fan would draw it into its one vertex.
Filling fill_as_in_uvs(const Chart& chart, std::size_t outer);

}  // namespace atlas_refine
