// The paper's road: axis-aligned charts, cut and packed as rectangles, distortion reduced under the bound (section 3).
#pragma once

#include <optional>
#include <string>

#include "report/solution.h"

namespace atlas_refine {

/// A solution, or why there is none.
struct Attempt {
  std::optional<Solution> solution = {};
  bool needless = false;     ///< no chart needs a cut
  std::string failure = {};  ///< why cuts did not lead to the bound
};

/// Where there is no solution charts are better left whole, which divides no face. Throws as refine() does.
Attempt refine_by_rectangles(const Refinement& run, const ProgressRange& range);

}  // namespace atlas_refine
