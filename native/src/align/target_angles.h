// Target polar angles: which axis direction every boundary edge shall take (section 3.1.1, eq. 2, 6, 7).
#pragma once

#include <vector>

namespace atlas_refine {

/// What the targets are chosen from. All arrays have one entry per boundary edge, in order; angles rise by 2 pi in one turn.
struct TargetProblem {
  const std::vector<double>& lengths;
  const std::vector<double>& angle_rad;  ///< smoothed and rotated polar angles
  double corner_cost = 0;                ///< per quarter turn of a corner, in length * rad^2
  double least_segment = 0;              ///< two corners are at least so far apart along the boundary
};

/// Quarter turns Theta_i of every edge: minimises sum l_i (theta_i - pi/2 Theta_i)^2 + corner_cost * sum |K_i| over all Theta
/// with -2 <= K_i <= 1 at every vertex, segments of least length, Theta_i + 4 after one turn, and every Theta_i at most three
/// quarter turns off the one nearest to theta_i. Empty where there are none, as on a boundary that is too short for four
/// segments. Among equal minima always the same one.
///
/// Differs from eq. (6)-(7) with splitting and corner reduction: a cyclic shortest path over labels, found by dynamic
/// programming, replaces projection and the local repairs that follow it, and never leaves K_i > 1.
std::vector<int> target_angles(const TargetProblem& problem);

}  // namespace atlas_refine
