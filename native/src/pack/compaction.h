// Exact compaction: placed charts slide and turn, all at once, until the box cannot shrink any more.
#pragma once

#include <functional>

#include "pack/pack_charts.h"

namespace atlas_refine {

struct CompactionOptions {
  double first_step = 0;       ///< how far a chart may move in the first iteration: about the slack there is
  std::function<void()> poll;  ///< called often; may throw to cancel
};

/// Bounding box of the placed outlines.
Box placed_box(const std::vector<Outline>& outlines, const std::vector<Placement>& placements);

/// Improves placements by sequential linear programming over all rigid motions: the smallest box of the asked aspect with the
/// asked gap, from where they lie. They may be a little nearer to each other than the gap. The answer is not: its distances are
/// measured on the outlines as placed. Empty where no such answer is found.
std::vector<Placement> compact(const std::vector<Outline>& outlines, const std::vector<Placement>& placements,
                               const PackOptions& options, const CompactionOptions& compaction);

}  // namespace atlas_refine
