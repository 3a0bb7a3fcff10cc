// Dense kernels of the sparse factorisation: the partial Cholesky factor of one front, and its triangular solves.
// They use the widest registers that the machine has (AVX-512, AVX2, else the baseline: SSE2, NEON). Every value is a sum in one
// fixed order, without fused multiply-add, whatever a register holds: the bits are the same with all of them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace atlas_refine {

/// The first `pivots` columns of a symmetric matrix of `rows` rows, both even. `panel` holds their lower triangle by columns,
/// `rows` apart; what stands above the diagonal is not used, and overwritten.
struct Front {
  double* panel;
  int rows;
  int pivots;

  int below() const { return rows - pivots; }
};

/// One right-hand side of a front: its values at the pivots, and at the rows below.
struct FrontSide {
  double* at_pivots;
  double* below;
};

/// Where the factorisation of a front writes, and by how many threads a large one may be divided.
struct FrontOutput {
  double* update;
  double* packed;  ///< scratch memory of packed_size
  int threads = 1;
};

/// The kernels for one set of instructions.
struct FrontKernels {
  const char* name;
  /// Replaces the panel by its factor L, with the inverse of its diagonal, and writes -(L below)(L below)^T to the lower triangle
  /// of the update, below() x below() by columns. False where a pivot is not positive; panel and update are then of no use.
  bool (*factor)(const Front& front, const FrontOutput& out);
  /// at_pivots := L^-1 at_pivots, below -= (L below) at_pivots.
  void (*solve_forward)(const Front& front, std::span<const FrontSide> sides);
  /// at_pivots := L^-T (at_pivots - (L below)^T below).
  void (*solve_backward)(const Front& front, std::span<const FrontSide> sides);
};

/// What this machine can run, the best last.
std::vector<FrontKernels> supported_kernels();
const FrontKernels& best_kernels();

std::size_t packed_size(const Front& front);

}  // namespace atlas_refine
