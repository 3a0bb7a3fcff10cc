// Derivatives of one triangle's energy as one vector and one matrix of its six coordinates.
#pragma once

#include <Eigen/Core>

#include "solve/symmetric_dirichlet.h"

namespace atlas_refine::testing {

inline Eigen::VectorXd stacked_gradient(const TriangleDerivatives& d) {
  Eigen::VectorXd g(6);
  g << d.gradient[0], d.gradient[1], d.gradient[2];
  return g;
}

inline Eigen::MatrixXd full_hessian(const TriangleDerivatives& d) {
  Eigen::MatrixXd h(6, 6);
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    h.block<2, 2>(2 * k, 2 * k) = d.diagonal[k];
    h.block<2, 2>(2 * k, 2 * next) = d.off_diagonal[k];
    h.block<2, 2>(2 * next, 2 * k) = d.off_diagonal[k].transpose();
  }
  return h;
}

}  // namespace atlas_refine::testing
