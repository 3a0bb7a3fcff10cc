// How much a chart would shrink and grow if it were laid flat with given vertices on its border: what seams are worth, without an
// embedding.
#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

/// Curvature that no border takes up is paid for in scale. Of a conformal map that keeps lengths along its border (the one of
/// least area distortion: Springborn et al. 2008) the logarithm of the scale solves, to first order, a Poisson equation for the
/// curvature (Ben-Chen et al. 2008).
class ScaleForecast {
 public:
  explicit ScaleForecast(const Chart& chart);

  /// Per vertex the logarithm of the scale, 0 at the `border`; at least one vertex must be there.
  std::vector<double> logarithms(const std::vector<char>& border);

  /// E_d of a conformal map with these scales. Near 1 its excess is about four times that of the least distorted map (spheres,
  /// cylinders and capsules cut open).
  double energy(const std::vector<double>& logarithms) const;

 private:
  std::vector<Triangle> triangles_;
  std::vector<double> areas_;      ///< per triangle
  std::vector<double> curvature_;  ///< per vertex: 2 pi - the angles around it
  Eigen::SparseMatrix<double> laplacian_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
};

}  // namespace atlas_refine
