// Packing rectangles with quarter turns: a fast heuristic for every candidate, and annealing for the best of them.
#pragma once

#include <vector>

#include "atlas_refine/atlas.h"
#include "support/rng.h"

namespace atlas_refine {

struct RectanglePacking {
  std::vector<Vec2> positions;  ///< min corner of each rectangle
  std::vector<char> turned;     ///< by a quarter turn: its sides have changed places
  Vec2 box = Vec2::Zero();      ///< of the asked aspect, the rectangles' box in its min corner
};

/// Packs by skyline best fit (Burke, Kendall, Whitwell 2004) into strips of many widths; the smallest box wins. Near-linear in
/// the number of rectangles. Two rectangles are at least `padding` apart; nothing is kept from the box's sides.
/// `box_aspect` is width / height, 0 = free.
RectanglePacking pack_rectangles(const std::vector<Vec2>& sizes, double padding, double box_aspect);

/// Simulated annealing on sequence pairs (Murata et al. 1996) from a packing; never worse than it.
RectanglePacking anneal_packing(const std::vector<Vec2>& sizes, double padding, double box_aspect, RectanglePacking start,
                                int iterations, Rng& rng);

}  // namespace atlas_refine
