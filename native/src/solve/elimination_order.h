// The order in which the nodes of a sparse symmetric matrix are eliminated: what fills it in least.
#pragma once

#include <vector>

#include "solve/adjacency.h"

namespace atlas_refine {

/// Approximate minimum degree (Amestoy, Davis, Duff 1996); where many nodes hang together, within the parts that nested
/// dissection leaves of them (George 1973), which are eliminated before what separates them.
struct EliminationOrder {
  std::vector<int> nodes;  ///< first to last
  double work = 0;         ///< about what it cost to find, in multiplications of 2x2 blocks
};

EliminationOrder elimination_order(const Adjacency& graph);

}  // namespace atlas_refine
