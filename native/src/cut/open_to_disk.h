// Holes cut open: a chart with several boundary loops becomes a disk.
#pragma once

#include "geometry/split_mesh.h"

namespace atlas_refine {

/// What opening a chart came to.
struct Opening {
  int holes_cut = 0;     ///< boundary loops joined to the outer one
  bool is_disk = false;  ///< false where the chart has a handle or no boundary
};

/// Cuts the mesh along shortest edge paths (in the UV plane) between its boundary loops until it has one; of equally short paths
/// along one that ends in corners.
Opening open_to_disk(SplitMesh& mesh);

}  // namespace atlas_refine
