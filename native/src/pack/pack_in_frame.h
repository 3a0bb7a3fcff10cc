// Placing rigid charts in a box of given sides, around obstacles, as large as they fit.
#pragma once

#include <optional>

#include "pack/pack_charts.h"

namespace atlas_refine {

struct FrameOptions {
  Vec2 frame = Vec2::Zero();  ///< the box is [0, frame.x] x [0, frame.y]
  double margin = 0;          ///< smallest distance of a chart to the walls
  double gap = 0;             ///< to other charts and to obstacles; like the margin in the frame's units
  double enough = 1;          ///< a scale at which the search ends
  std::uint64_t seed = 1;
  int threads = 1;
  std::function<void(double)> tick = {};  ///< as PackOptions::tick
};

struct FramePacking {
  double scale = 1;                   ///< of the outlines in the frame
  std::vector<Placement> placements;  ///< in the outlines' units: of the frame / scale
};

/// The largest scale found at which all outlines fit, at most options.enough; nothing where they do not fit even when they cover
/// a ten-thousandth of the frame. Obstacles may overlap each other and lie partly outside the frame. Charts may lie in their
/// holes. Deterministic for a seed, whatever the number of threads.
std::optional<FramePacking> pack_in_frame(const std::vector<Outline>& outlines, const std::vector<Outline>& obstacles,
                                          const FrameOptions& options);

}  // namespace atlas_refine
