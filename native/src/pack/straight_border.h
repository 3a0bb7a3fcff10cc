// Charts whose longest border runs straight: panels, planks, letters.
#pragma once

#include <optional>

#include "geometry/chart.h"
#include "pack/turns.h"

namespace atlas_refine {

/// The smallest turn that lays the chart's longest straight border on an axis; nothing where no border is straight over a good
/// share of the chart's outline.
std::optional<Turn> turn_onto_axis(const Chart& chart);

}  // namespace atlas_refine
