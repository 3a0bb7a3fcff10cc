// Charts that no plane can hold, for want of a boundary or for a handle, opened along edges of their faces.
#pragma once

#include <array>
#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

/// Whether the chart is a sphere or disk with holes in it, or has handles.
struct ChartShape {
  int loops = 0;
  int handles = 0;

  bool fits_plane() const { return loops > 0 && handles == 0; }
};
ChartShape shape_of(const Chart& chart);

/// Edges, as pairs of vertices, to cut along so that the chart has a boundary and no handle: two short loops for each handle
/// (tree-cotree, Erickson and Whittlesey 2005), and paths to vertices that are far from all of those. Edges between triangles of
/// one face are not among them. Existing holes stay as they are.
std::vector<std::array<int, 2>> opening_edges(const Chart& chart);

}  // namespace atlas_refine
