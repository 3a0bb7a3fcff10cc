// Corners of an axis-aligned boundary.
#include "geometry/axis_aligned_chart.h"

namespace atlas_refine {

std::vector<int> corner_turns(const std::vector<int>& quarter_turns) {
  const int n = static_cast<int>(quarter_turns.size());
  std::vector<int> turns(n);
  for (int i = 0; i < n; ++i) turns[i] = quarter_turns[i] - (i > 0 ? quarter_turns[i - 1] : quarter_turns[n - 1] - 4);
  return turns;
}

}  // namespace atlas_refine
