// The trails of a layout driven through the charts: paths of edges to cut along (section 3.2, "Cutting").
#pragma once

#include <vector>

#include "cut/cut_atlas.h"
#include "geometry/axis_aligned_chart.h"
#include "layout/axis_trails.h"

namespace atlas_refine {

/// Charts divided along their trails, still whole.
struct TracedTrails {
  std::vector<SplitMesh> meshes;   ///< one per chart
  std::vector<SurfacePath> paths;  ///< pieces are charts
};

/// Drives each chart's trails in order, each to the boundary or to a trail before it.
TracedTrails trace_trails(const std::vector<AxisAlignedChart>& aligned, const std::vector<std::vector<TrailStart>>& trails);

}  // namespace atlas_refine
