// Which vertices of a chart a coarse mesh keeps: all of the boundary, inside ever fewer away from it.
#pragma once

#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

struct Sample {
  std::vector<int> vertices;  ///< of the chart: the boundary loop by loop, then those held inside, then others
  std::vector<int> near;      ///< per entry of these: an earlier entry that is near it, -1 = none known
};

/// Vertices inside keep a distance from each other, along edges on the surface, that grows from the boundary's edge lengths up to
/// `spacing`. Those inside that are `held` are taken too.
Sample sample_vertices(const Chart& chart, const std::vector<char>& held, double spacing);

}  // namespace atlas_refine
