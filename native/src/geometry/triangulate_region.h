// Triangulation of a region with holes, with more points inside (constrained Delaunay).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

struct Region {
  std::vector<Vec2> points;
  std::vector<std::vector<int>> loops;     ///< the region on the left of each
  std::vector<std::array<int, 2>> chords;  ///< edges inside that the triangulation is to have
  std::vector<int> near;                   ///< per point: one before it that is near, for speed; -1 = none known
};

/// Triangles of the region, counterclockwise, sorted. Nothing where points coincide, or loops and chords meet between points.
std::optional<std::vector<Triangle>> triangulate_region(const Region& region);

}  // namespace atlas_refine
