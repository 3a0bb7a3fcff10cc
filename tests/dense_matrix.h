// A sparse matrix of blocks as a dense one.
#pragma once

#include <Eigen/Core>

#include "solve/newton.h"

namespace atlas_refine::testing {

/// Two rows and columns a node.
inline Eigen::MatrixXd dense(const BlockCholesky& matrix) {
  const int nodes = matrix.node_count();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(2 * nodes, 2 * nodes);
  for (int i = 0; i < nodes; ++i) {
    out.block<2, 2>(2 * i, 2 * i) = matrix.diagonal[i];
    for (int j = i + 1; j < nodes; ++j) {
      const int slot = matrix.slot(i, j);
      if (slot < 0) continue;
      out.block<2, 2>(2 * i, 2 * j) = matrix.off_diagonal[slot];
      out.block<2, 2>(2 * j, 2 * i) = matrix.off_diagonal[slot].transpose();
    }
  }
  return out;
}

inline Eigen::MatrixXd dense(const BlockSystem& system) { return dense(system.matrix); }

}  // namespace atlas_refine::testing
