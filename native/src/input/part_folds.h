// Charts that are folded: mirrored halves on each other, the front and the back of a sheet.
#pragma once

#include <array>
#include <vector>

#include "input/join_edges.h"

namespace atlas_refine {

/// Takes charts apart along the edges where they are folded, and winds the faces of each part anew. Where only a few faces are
/// turned over they stay in their chart, which has them as defects: none or few of their neighbours lie as they do. Returns
/// the parted edges, each as the corners that its two uses start from.
std::vector<std::array<int, 2>> part_folds(const Atlas& atlas, EdgeJoins& joins);

}  // namespace atlas_refine
