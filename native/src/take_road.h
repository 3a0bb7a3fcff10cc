// The road that is taken for one atlas, with what stands in where it leads nowhere.
#pragma once

#include "report/certify.h"
#include "report/solution.h"

namespace atlas_refine {

struct CertifiedSolution {
  Solution solution;
  CertifiedAtlas atlas;
};

/// Of charts that have their size; `packed`: before.
Gap at_size(const InputAtlas& input, Gap packed);

/// Throws RefineError(NotCertified), or UnmendedCharts.
CertifiedSolution certified(const Refinement& run, Solution solution, const ProgressRange& range);

/// As the options say. Throws as certified() does.
CertifiedSolution take_road(const Refinement& run, const ProgressRange& range);

}  // namespace atlas_refine
