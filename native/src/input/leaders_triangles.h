// Polygons that lie on each other, divided alike: what a cut of the one needs to be followed by the other.
#pragma once

#include <vector>

#include "input/split_charts.h"
#include "input/stacks.h"

namespace atlas_refine {

/// True where the polygons of `chart` lie on those of `onto`, however they are divided: `vertices` has for each vertex of the
/// chart the one of `onto` that it lies on.
bool same_polygons(const Chart& chart, const Chart& onto, const std::vector<int>& vertices);

/// The follower's polygons divided as those of its leader, with the surface that has. Only where they are the same polygons.
void divide_as_leader(const Atlas& atlas, const Follower& follower, ChartSet& set);

}  // namespace atlas_refine
