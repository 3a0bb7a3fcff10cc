// Repairs told to the journal.
#pragma once

#include <vector>

#include "repair/repair_charts.h"
#include "report/solution.h"

namespace atlas_refine {

/// What the call's options ask of the repair.
RepairOptions repair_options(const Refinement& run);

/// One line for each chart that was changed. Returns those charts. Throws RefineError(BadInput) that names the first chart that
/// could not be mended, and how many there are.
std::vector<int> note_repairs(const Refinement& run, const RepairedCharts& repaired);

}  // namespace atlas_refine
