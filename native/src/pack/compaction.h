// Exact compaction: placed charts slide and turn, all at once, until the box
// cannot shrink any more.
#pragma once

#include <functional>

#include "pack/pack_charts.h"

namespace atlas_refine {

struct CompactionOptions {
  double gap = 0;
  double box_aspect = 0;       ///< 0 = free
  double first_step = 0;       ///< how far a chart may move in the first iteration:
                               ///< about the slack there is
  std::function<void()> poll;  ///< called often; may throw to cancel
};

/// Bounding box of the placed outlines.
Box placed_box(const std::vector<Outline>& outlines, const std::vector<Placement>& placements);

/// Improves placements by sequential linear programming over all rigid motions.
/// The answer is at least the gap apart (measured on the outlines as placed),
/// and its box is no larger where the placements were so, too. Those that are
/// nearer are drawn apart; nothing comes back where that fails.
std::vector<Placement> compact(const std::vector<Outline>& outlines, const std::vector<Placement>& placements,
                               const CompactionOptions& options);

}  // namespace atlas_refine
