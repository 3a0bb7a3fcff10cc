// An energy that is finite for flipped triangles too, and drives them to positive area as its parameter falls. Garanzha et al.
// 2021, "Foldover-free maps in 50 lines of code", eq. (2)-(5).
#pragma once

#include <vector>

#include "solve/symmetric_dirichlet.h"

namespace atlas_refine {

inline constexpr double kLeastEpsilon = 1e-10;

/// chi(D, eps) = (D + sqrt(eps^2 + D^2)) / 2: positive, and near max(D, 0) where eps is small.
double regularised_determinant(double determinant, double epsilon);

/// The eps after a step that took the energy from `before` to `after`: the largest with which the least determinant counts as
/// less than before by the share that the energy fell, at least a tenth; next to nothing once all determinants are above that.
double next_epsilon(double epsilon, double least_determinant, double before, double after);

/// The energy that a step has reached at its eps.
struct FoldoverLevel {
  double energy, epsilon;
};

/// The steps so far tell that the flipped triangles do not unfold: what holds them is fixed.
bool stay_folded(const std::vector<FoldoverLevel>& steps);

/// (|J|^2 + det^2 + 1) / (4 chi): where eps is 0 the mean of the conformal |J|^2 / (2 det) and the areal (det + 1 / det) / 2;
/// then 1 for rotations.
double foldover_energy(const Mat2& j, double epsilon);

/// Energy, gradient and, with `project`, positive semidefinite Hessian for a triangle of weight 1, whatever its sign.
TriangleDerivatives foldover_derivatives(const Mat2& inverse_edges, const Vec2& p0, const Vec2& p1, const Vec2& p2,
                                         double epsilon, bool project = true);

}  // namespace atlas_refine
