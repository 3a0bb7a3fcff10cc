// What the paper's road needs of a chart before it is deformed: a disk whose triangulation can become axis-aligned.
#pragma once

#include <vector>

#include "geometry/split_mesh.h"

namespace atlas_refine {

/// A chart made ready.
struct PreparedChart {
  SplitMesh mesh;
  int holes_cut = 0;     ///< boundary loops joined to the outer one
  bool is_disk = false;  ///< false where the chart has a handle or no boundary
};

/// Cuts the chart to a disk along shortest edge paths between its boundary loops, divides boundary edges that are long beside the
/// others (Fig. 23) and every inner edge between two boundary vertices: the third side of an ear is one of those.
PreparedChart prepare_chart(const Chart& chart);

}  // namespace atlas_refine
