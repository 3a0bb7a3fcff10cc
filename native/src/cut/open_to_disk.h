// Holes cut open: a chart with several boundary loops becomes a disk.
#pragma once

#include "cut/side_prices.h"
#include "geometry/split_mesh.h"

namespace atlas_refine {

/// What opening a chart came to.
struct Opening {
  int holes_cut = 0;     ///< boundary loops joined to the outer one
  bool is_disk = false;  ///< false where the chart has a handle or no boundary
};

/// Cuts the mesh along shortest edge paths (in the UV plane) between its boundary loops until it has one; of equally short paths
/// along one that ends in corners. Lengths count times `prices`, whose chart the mesh must still have undivided.
Opening open_to_disk(SplitMesh& mesh, const SidePrices& prices = {});

}  // namespace atlas_refine
