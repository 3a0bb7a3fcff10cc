// Flipped triangles turned back: least distortion from given shapes under an energy that is finite for flips (Garanzha et al.
// 2021, "Foldover-free maps in 50 lines of code").
#pragma once

#include <optional>
#include <vector>

#include "geometry/chart.h"
#include "support/monitor.h"

namespace atlas_refine {

/// Triangles, some of which are not positive, and the shape that each is to have.
struct Tangle {
  std::vector<Triangle> triangles;
  std::vector<Mat2> inverse_edges;  ///< of the wanted shapes, as RestTriangle::inverse_edges, in units of the UVs
  std::vector<double> weights;      ///< > 0, one per triangle
  std::vector<char> fixed;          ///< one per vertex
  bool stays_positive = false;      ///< no triangle is flipped, and none is to be on the way
};

/// The UVs with every triangle positive (exactly) and near its wanted shape, vertices that are fixed where they were; nothing
/// where that was not found. Whether triangles overlap each other is not looked at.
std::optional<std::vector<Vec2>> untangle(const Tangle& tangle, std::vector<Vec2> uvs, int threads, Monitor& monitor);

}  // namespace atlas_refine
