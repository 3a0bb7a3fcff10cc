// Small sparse linear programs by Mehrotra's predictor-corrector interior point
// method.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace atlas_refine {

/// One inequality: sum of coefficient * variable >= bound.
struct LinearInequality {
  struct Term {
    int variable;
    double coefficient;
  };
  std::vector<Term> terms;
  double bound = 0;
};

/// Minimises cost . z subject to the inequalities and |z_i| <= reach_i, to
/// about 1e-4 of the cost of a step of full reach; the inequalities hold to
/// 1e-9 of the reach. Empty where it does not converge. `poll` is called in
/// every iteration.
Eigen::VectorXd solve_linear_program(const Eigen::VectorXd& cost, const std::vector<LinearInequality>& inequalities,
                                     const Eigen::VectorXd& reach, const std::function<void()>& poll);

}  // namespace atlas_refine
