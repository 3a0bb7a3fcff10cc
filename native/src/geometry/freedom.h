// What may be done to each chart: bend it, move it, or nothing.
#pragma once

#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

enum class Freedom : char {
  Bends,  ///< its shape may change
  Moves,  ///< it keeps its shape
  Fixed   ///< it stays where it is in the texture: others go around it
};

/// One per chart; empty where all bend.
using Freedoms = std::vector<Freedom>;

/// Whether a face of the chart has a flag that is not 0; empty: none has.
bool any_flagged(const Chart& chart, const std::vector<char>& flags);

/// A chart with a face that is set in `locked` is fixed, else one with a face that is set in `keep_shape` moves. The flags are
/// one per face of the input, or empty.
Freedoms freedom_of(const std::vector<Chart>& charts, const std::vector<char>& keep_shape, const std::vector<char>& locked);

inline bool bends(const Freedoms& freedom, std::size_t chart) { return freedom.empty() || freedom[chart] == Freedom::Bends; }
inline bool is_fixed(const Freedoms& freedom, std::size_t chart) { return !freedom.empty() && freedom[chart] == Freedom::Fixed; }
bool any_fixed(const Freedoms& freedom);
bool all_fixed(const Freedoms& freedom);
/// Nothing can be gained by bending.
bool none_bends(const Freedoms& freedom);

/// Placed charts and the box that they are placed in: [0, frame.x] x [0, frame.y], which the unit square of the texture stands
/// for, or their own bounding box, wherever it is, where `frame` is zero. Fixed charts need a frame, and have their UVs times it.
struct PlacedCharts {
  std::vector<Chart> charts;
  Vec2 frame = Vec2::Zero();

  bool has_frame() const { return frame.x() > 0; }
};

/// Sum of the areas of the chart's UV triangles within the box.
double area_within(const Chart& chart, const Box& box);

}  // namespace atlas_refine
