// Charts whose borders touch themselves and do nothing worse.
#pragma once

#include <optional>

#include "geometry/chart.h"

namespace atlas_refine {

/// Whether borders of the chart are within rounding of each other: a ten millionth of its size.
bool touches_itself(const Chart& chart);

/// The chart with the borders where it touches itself drawn a little into it, without guards of faces that this bends; nothing
/// where that does not make it valid.
std::optional<Chart> part_touching(const Chart& chart);

}  // namespace atlas_refine
