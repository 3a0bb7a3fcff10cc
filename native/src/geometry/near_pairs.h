// The search for points and edges of boundaries that come near each other.
#pragma once

#include <vector>

#include "geometry/boundary.h"

namespace atlas_refine {

/// All pairs whose swept boxes (position and position + displacement) come within `radius`, ordered by point, then edge.
/// Left out: edges that end at the point, and pairs of different loops of one chart (the chart itself lies between them).
/// `displacements` may be empty: nothing moves.
std::vector<PointEdge> near_pairs(const Boundary& boundary, const std::vector<Vec2>& positions,
                                  const std::vector<Vec2>& displacements, double radius);

/// The same for a boundary that moves step by step: pairs are looked for in space farther out than asked, and later ones chosen
/// from these as long as no point leaves what it swept then by more than the rest of that reach. So a search along a step serves
/// for a part of it and for where it ends, too.
class NearPairs {
 public:
  std::vector<PointEdge> find(const Boundary& boundary, const std::vector<Vec2>& positions,
                              const std::vector<Vec2>& displacements, double radius);

 private:
  std::vector<PointEdge> known_;  ///< within reach_ of each other
  std::vector<Box> swept_;        ///< by the points then
  double reach_ = -1, largest_radius_ = 0;
};

}  // namespace atlas_refine
