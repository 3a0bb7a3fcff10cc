// A graph parted into two halves by few nodes.
#pragma once

#include "solve/vertex_cut.h"

namespace atlas_refine {

/// The side of each node of a connected graph. No edge joins left and right, each of which has at least about a quarter of the
/// nodes.
std::vector<GraphSide> separate(const Adjacency& graph);

}  // namespace atlas_refine
