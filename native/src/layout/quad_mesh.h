// The quad mesh Q of the naive decomposition: every trail of every corner, traced to the boundary (section 3.2, Fig. 7a).
#pragma once

#include <vector>

#include "cut/side_prices.h"
#include "geometry/axis_aligned_chart.h"
#include "layout/axis_trails.h"

namespace atlas_refine {

/// Q of one chart. Faces are rectangles, segments the pieces of trails between nodes.
struct QuadMesh {
  struct Segment {
    int left, right;  ///< faces on its two sides
    double length;    ///< on the surface, more where no seam is wanted
  };
  struct Trail {
    TrailStart start;
    std::vector<int> nodes;
    std::vector<int> segments;  ///< between consecutive nodes
    double length = 0;          ///< of its segments
  };
  std::vector<Box> faces;
  std::vector<double> face_areas;
  std::vector<Segment> segments;
  std::vector<Trail> trails;
  std::vector<std::vector<int>> corners;  ///< trails of each reflex or extra corner, counterclockwise
  std::vector<char> optional_corner;      ///< extra corners, which need no trail
  int node_count = 0;
  double boundary_length = 0;  ///< on the surface
};

/// Q from the chart's reflex corners and from `extra_corners` boundary vertices besides, spread evenly along the long sides.
/// Trails count as much longer where they run along or across edges at kNoSeam of `prices`, which are those of `source`.
QuadMesh make_quad_mesh(const AxisAlignedChart& aligned, const Chart& source, int extra_corners, const SidePrices& prices = {});

}  // namespace atlas_refine
