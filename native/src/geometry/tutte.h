// Tutte's embedding: a bijective start for a chart that has none.
#pragma once

#include "geometry/fill_holes.h"

namespace atlas_refine {

/// The boundary loop that is longest on the surface.
std::size_t longest_loop(const Chart& chart);

/// UVs of `chart` embedded in a disk of the surface's area: its longest boundary loop on the circle at surface arc lengths (edges
/// without length a little apart), every other loop filled, each interior vertex at the mean of its neighbours. Free of flips and
/// overlaps up to rounding, which may spoil triangles of strongly shrunk parts: the caller checks.
/// Tutte 1963; positive weights, Floater 2003.
std::vector<Vec2> tutte_disk(const Chart& chart, const Filling& filling);

/// The same into a convex polygon, holes filled by fans: vertex k of boundary loop `outer` goes to polygon[k]. Where several of
/// them lie on one straight side, no inner edge may join two of them.
std::vector<Vec2> tutte(const Chart& chart, std::size_t outer, const std::vector<Vec2>& polygon);

}  // namespace atlas_refine
