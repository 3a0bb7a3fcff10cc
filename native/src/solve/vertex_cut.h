// Few nodes that part a graph.
#pragma once

#include <vector>

#include "solve/adjacency.h"

namespace atlas_refine {

enum class GraphSide : char { Left, Right, Middle };

/// Of the nodes in the middle as few stay as can part left from right; the others join the sides, so that they are about as large
/// as each other. Edges that lead past the middle are not parted.
void narrow_to_cut(const Adjacency& graph, std::vector<GraphSide>& sides);

}  // namespace atlas_refine
