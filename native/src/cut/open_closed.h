// Charts that no plane can hold, for want of a boundary or for a handle, opened along edges of their faces.
#pragma once

#include <array>
#include <vector>

#include "cut/side_prices.h"
#include "geometry/chart.h"

namespace atlas_refine {

/// Whether the chart is a sphere or disk with holes in it, or has handles.
struct ChartShape {
  int loops = 0;
  int handles = 0;

  bool fits_plane() const { return loops > 0 && handles == 0; }
};
ChartShape shape_of(const Chart& chart);
/// The same by counting, for charts whose boundary loops are known.
bool fits_plane(const Chart& chart);

/// Edges, as pairs of vertices, to cut along so that the chart has a boundary and no handle: two short loops for each handle
/// (tree-cotree, Erickson and Whittlesey 2005), and seams to vertices of high curvature, as long as the distortion that they
/// save is worth their length (as in geometry images, Gu et al. 2002, with a forecast in place of embeddings). Lengths count
/// times `prices`. Edges between triangles of one face, and those without a price, are not among them. Existing holes stay as
/// they are. Too few where edges that must stay whole are in the way.
std::vector<std::array<int, 2>> opening_edges(const Chart& chart, const SidePrices& prices = {});

}  // namespace atlas_refine
