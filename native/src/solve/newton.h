// Projected Newton on UV vertices, piece by piece of the method: assembly of E_d (eq. 9), direction, step limits, line search.
// The deformation to the axes, embedding and the reduction under the bound all step with these.
#pragma once

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/chart.h"
#include "solve/block_cholesky.h"
#include "solve/objective.h"
#include "support/profile.h"

namespace atlas_refine {

/// Gradient and Hessian of one iteration, two unknowns a node.
struct BlockSystem {
  BlockCholesky matrix;
  std::vector<Vec2> gradient;

  void set_zero();
};

/// Where each triangle's sides (0,1), (1,2), (2,0) lie in the matrix.
using TriangleSlots = std::vector<std::array<int, 3>>;

/// The pairs of nodes that triangles couple, for BlockCholesky::analyse.
std::vector<std::pair<int, int>> triangle_sides(const std::vector<Triangle>& triangles);
TriangleSlots triangle_slots(const BlockCholesky& matrix, const std::vector<Triangle>& triangles);

/// Sum of weight * energy; infinite with a flip.
double dirichlet_energy(const Objective& objective, const std::vector<Triangle>& triangles, const std::vector<Vec2>& x);
/// The terms of the sum, unweighted.
std::vector<double> triangle_energies(const Objective& objective, const std::vector<Triangle>& triangles,
                                      const std::vector<Vec2>& x);
/// Adds the energy's gradient and projected Hessian. The sums run in triangle order whatever the number of threads.
void add_dirichlet(const Objective& objective, const std::vector<Triangle>& triangles, const TriangleSlots& slots,
                   const std::vector<Vec2>& x, int threads, BlockSystem& system);

/// Levenberg damping: `value` times each node's mass is added to the diagonal, more by `growth` until the matrix can be factored.
struct Damping {
  double value;
  double growth;
  double most;
};
/// Factors the matrix; the damping that it took, or nothing where `most` was not enough.
std::optional<double> factor_damped(BlockSystem& system, const std::vector<double>& masses, const Damping& damping,
                                    int threads = 1);

/// -H^-1 gradient. The matrix must have been factored.
std::vector<Vec2> newton_direction(const BlockSystem& system);
/// The same, and H^-1 `other` in its place.
std::vector<Vec2> newton_direction(const BlockSystem& system, std::vector<Vec2>& other);

double dot(const std::vector<Vec2>& a, const std::vector<Vec2>& b);

/// Largest part of `step`, at most `limit`, that stays `short_of` (a factor below 1) the first flip.
double flip_free_fraction(const std::vector<Triangle>& triangles, const std::vector<Vec2>& x, const std::vector<Vec2>& step,
                          double limit, double short_of);

/// The part of a step that each piece may take, in [0, 1].
struct StepBounds {
  std::vector<double> of_piece;

  double least() const;
};

/// Armijo: the first of `limit` and smaller steps at which `merit_at` is low enough, 0 where none is: half as large where it is
/// too high, `back_off` times as large where it is infinite, a state that is not allowed. Its last call is the accepted one.
template <class MeritAt>
double backtrack(double limit, double merit, double slope, MeritAt&& merit_at, double back_off = 0.5) {
  constexpr double kDecrease = 1e-4;
  constexpr double kLeastPart = 1e-9;
  for (double fraction = limit; fraction > kLeastPart * limit;) {
    const double reached = merit_at(fraction);
    if (reached <= merit + kDecrease * fraction * slope) return fraction;
    fraction *= std::isfinite(reached) ? 0.5 : back_off;
  }
  return 0;
}

/// The same, with an account of its time: not for single vertices.
template <class MeritAt>
double line_search(double limit, double merit, double slope, MeritAt&& merit_at, double back_off = 0.5) {
  const PhaseScope scope(Phase::LineSearch);
  return backtrack(limit, merit, slope, merit_at, back_off);
}

}  // namespace atlas_refine
