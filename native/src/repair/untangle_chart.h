// A chart with a few flipped or zero-area triangles mended in place.
#pragma once

#include <optional>

#include "geometry/chart.h"
#include "support/monitor.h"

namespace atlas_refine {

/// The chart with every triangle positive: good triangles as the input's UVs have them, bad ones as near as they can be to their
/// shape on the surface. Only vertices near bad triangles move, as few as will do: rings around them, in doubling widths, until
/// the good triangles keep their shapes (E_2 <= 1.02). Where none does, the best, and bad ones stay as thin as that takes.
/// `may_overlap`: the boundary may cross itself, and bad ones have their room: the chart is going to be deformed. Nothing where
/// none was found.
std::optional<Chart> untangle_chart(const Chart& chart, bool may_overlap, int threads, Monitor& monitor);

}  // namespace atlas_refine
