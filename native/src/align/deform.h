// Deformation of one chart until its boundary is exactly axis-aligned (section 3.1.2, eq. 8-10, Algorithm 1).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "align/polar_angles.h"

namespace atlas_refine {

/// What the boundary shall become: edge i takes the direction of quarter_turns[i] * pi/2.
struct AlignTarget {
  const BoundaryAngles& boundary;  ///< of the chart as it is now
  const std::vector<int>& quarter_turns;
};

struct AlignedShape {
  std::vector<Vec2> uvs;
  std::vector<int> quarter_turns;  ///< the target, with corners moved along the boundary where the deformation asked for it
};

/// UVs without flips whose boundary edges are parallel to the axes to the last bit and run in the asked directions; nothing where
/// the deformation does not get there. Where an edge beside a corner would shrink to nothing, the corner moves past it. The chart
/// must be free of flips, and have no triangle with two boundary edges and no inner edge between two boundary vertices. `poll` is
/// called before every iteration and may throw. Differs from Algorithm 1: projected Newton instead of L-BFGS, the length term
/// keeps a small fixed weight (growing with lambda it fights the angle term), and the flattening is the limit of a growing
/// quadratic penalty on what edges deviate from their axis: the same optimum as one unknown per segment, on the mesh's own
/// sparsity.
std::optional<AlignedShape> deform_to_axes(const Chart& chart, const AlignTarget& target, const std::function<void()>& poll);

/// The smallest deformation that makes every boundary edge axis-parallel: all vertices of a segment take its mean coordinate.
std::vector<Vec2> flattened(const std::vector<Vec2>& uvs, const AlignTarget& target);

}  // namespace atlas_refine
