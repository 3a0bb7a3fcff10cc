// What E_d is measured against: rest shapes and weights (section 3.4 "Distortion type", section 4 "Local control").
#pragma once

#include <vector>

#include "atlas_refine/options.h"
#include "geometry/chart.h"

namespace atlas_refine {

/// Reference::Input takes the UVs that the charts have now as their rest shapes, at the surface's total area. Each triangle's
/// weight is multiplied by its face's importance; empty = 1.
void set_reference(std::vector<Chart>& charts, Reference reference, const std::vector<double>& importance);

}  // namespace atlas_refine
