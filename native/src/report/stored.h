// UVs as they will be stored: in the unit square, or at a density, and rounded.
#pragma once

#include <optional>
#include <vector>

#include "atlas_refine/options.h"
#include "geometry/chart.h"

namespace atlas_refine {

/// The value that is left after storing it.
Vec2 as_stored(const Vec2& uv, Stored stored);

/// UVs in the unit square at `origin`, or at the density that is asked, as they will be stored, per piece.
std::vector<std::vector<Vec2>> stored_uvs(const std::vector<Chart>& pieces, const Vec2& frame, const Vec2& origin,
                                          const RefineOptions& options);

/// The chart with its UVs as stored, stretched back and at its own scale, where rounding them made it invalid: borders that are
/// apart by no more than that, the sides of a slit, may touch. `points`: RepairOptions::space_points of the chart.
std::optional<Chart> broken_as_stored(const Chart& chart, const std::vector<int>& points, std::vector<Vec2> stored,
                                      double box_aspect);

}  // namespace atlas_refine
