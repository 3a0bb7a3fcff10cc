// The squeeze: charts bend inside a shrinking box until the bound holds; several starts, the best result wins.
#pragma once

#include <vector>

#include "reduce/reduce.h"
#include "support/monitor.h"

namespace atlas_refine {

struct SqueezeOptions {
  double pe_bound = 0.8;
  double box_aspect = 0;
  std::vector<Gap> gaps;      ///< to be tried in this order: the asked one, then smaller ones where that is allowed
  double max_distortion = 0;  ///< 0 = no limit
  double max_price = 0;       ///< gives up a gap above this, except the last; 0 = no limit
  int threads = 1;
};

struct Squeezed {
  std::vector<Chart> charts;
  Gap gap;               ///< that was kept
  ReduceResult outcome;  ///< its `uvs` are those of `charts`
  int iterations = 0;    ///< over all starts and gaps
};

/// Reduces from every start (each free of flips, crossings and nearer charts than the first gap) and keeps the result of least
/// distortion that holds the bound; where none does, goes on from the best with the next gap, and in the end returns the state of
/// the highest PE. Starts run in parallel; the choice is by energy, ties by index.
Squeezed squeeze(const std::vector<std::vector<Chart>>& starts, const SqueezeOptions& options, Monitor& monitor);

}  // namespace atlas_refine
