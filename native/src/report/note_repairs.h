// Repairs told to the journal.
#pragma once

#include <vector>

#include "input/take_part.h"
#include "repair/repair_charts.h"
#include "report/solution.h"

namespace atlas_refine {

/// What the call's options ask of the repair.
RepairOptions repair_options(const Refinement& run);

/// Thrown where charts could not be mended: the others may be refined without them.
struct UnmendedCharts {
  std::vector<LeftChart> charts;  ///< by their numbers in the input
};

/// One line for each chart that was changed. Returns those charts. Throws UnmendedCharts.
std::vector<int> note_repairs(const Refinement& run, const RepairedCharts& repaired);

/// A chart made valid by itself, at the area that it has. Throws UnmendedCharts.
Chart made_valid(const Refinement& run, const Chart& chart);

}  // namespace atlas_refine
