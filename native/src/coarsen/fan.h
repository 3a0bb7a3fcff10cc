// The neighbourhood of a vertex that decimation removes and brings back, by lengths on the surface.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace atlas_refine {

inline constexpr int kMostNeighbours = 12;  // of a vertex that is removed

/// One number a neighbour of a vertex.
using Angles = std::array<double, kMostNeighbours>;
using Lengths = std::array<double, kMostNeighbours>;

/// The triangles around a vertex, counterclockwise; each joins a neighbour to the next.
struct Fan {
  int size = 0;
  std::array<int, kMostNeighbours> triangles, ring;
  Lengths spokes, rims;  ///< of the sides at the vertex, and of those across

  int after(int k) const { return k + 1 < size ? k + 1 : 0; }
};

/// Angles at the vertex, of each triangle.
inline Angles angles_of(const Fan& fan) {
  Angles out = {};
  double sum = 0;
  for (int k = 0; k < fan.size; ++k) {
    const double a = fan.spokes[k], b = fan.spokes[fan.after(k)], c = fan.rims[k];
    sum += out[k] = std::acos(std::clamp((a * a + b * b - c * c) / (2 * a * b), -1.0, 1.0));
  }
  for (int k = 0; k < fan.size; ++k) out[k] *= 2 * std::numbers::pi / sum;
  return out;
}

}  // namespace atlas_refine
