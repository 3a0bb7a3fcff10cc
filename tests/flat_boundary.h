// The boundaries of an atlas with the points that they run through.
#pragma once

#include <vector>

#include "charts.h"
#include "geometry/boundary.h"

namespace atlas_refine {

struct FlatBoundary {
  Boundary boundary;
  std::vector<Vec2> positions;
};

inline FlatBoundary flat_boundary(const Atlas& atlas) {
  const std::vector<Chart> charts = testing::charts_of(atlas);
  FlatBoundary result;
  std::vector<int> first;
  for (const Chart& chart : charts) {
    first.push_back(static_cast<int>(result.positions.size()));
    result.positions.insert(result.positions.end(), chart.uvs.begin(), chart.uvs.end());
  }
  result.boundary = make_boundary(charts, first);
  return result;
}

}  // namespace atlas_refine
