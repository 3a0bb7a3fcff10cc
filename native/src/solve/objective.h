// What distortion is reduced against: a wanted shape and a weight for every triangle and guard (section 3.4 "Distortion type",
// section 4 "Local control").
#pragma once

#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

/// Shapes and weights of all elements of all pieces, in order: of each piece its triangles, then its guards. Solver units:
/// lengths are those of the surface / `unit`, so that the surface has area 1.
struct Objective {
  std::vector<Mat2> inverse_edges;  ///< of the wanted shape, as RestTriangle::inverse_edges
  /// >= 0, sum 1: areas, on the surface or those wanted if larger, times share, none less than a part of the mean; times
  /// importance.
  std::vector<double> weight;
  double unit = 1;  ///< sqrt(area of the surface)
};

/// What an Objective is made from. All but `importance` have one entry per piece.
struct ObjectiveRequest {
  /// Wanted UV length per surface length, up to a common factor; empty: the same for all.
  std::vector<double> density = {};
  /// UVs whose triangles are the wanted shapes; each piece is first scaled by `reference_scale` to the surface's size. Empty: the
  /// shapes of the surface. A triangle without area there keeps its shape on the surface.
  std::vector<std::vector<Vec2>> reference_uvs = {};
  std::vector<double> reference_scale = {};
  /// One weight > 0 per input face; empty: all the same. Only ratios count: the weights are normalised.
  std::vector<double> importance = {};
};

/// The densities are normalised so that all pieces together want the area of the surface.
Objective make_objective(const std::vector<Chart>& pieces, const ObjectiveRequest& request = {});

}  // namespace atlas_refine
