// The charts of one stage as a picture's data.
#pragma once

#include <string>
#include <vector>

#include "atlas_refine/debug_sink.h"
#include "geometry/chart.h"

namespace atlas_refine {

/// Stretch is taken under the one global scale that minimises E_d, as Measures::stretch_max is.
AtlasSnapshot make_snapshot(std::string stage, std::string caption, const std::vector<Chart>& charts, const Box& box);

}  // namespace atlas_refine
