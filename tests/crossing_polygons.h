// A plate whose outline crosses itself by a hair, as faces between two bevels do.
#pragma once

#include <vector>

#include "small_atlases.h"

namespace atlas_refine::testing {

/// 4 x 2 with two notches side by side in its lower border, whose feet pass each other by `by`.
inline std::vector<Vec2> crossing_notches(double by) {
  return {{0, 0}, {1, 0}, {1.5, 0.8}, {2 + by, 0}, {2 - by, 0}, {2.5, 0.8}, {3, 0}, {4, 0}, {4, 2}, {0, 2}};
}

inline Atlas plate(const std::vector<Vec2>& outline) {
  std::vector<Vec3> positions;
  std::vector<int> face;
  for (const Vec2& uv : outline) {
    face.push_back(static_cast<int>(positions.size()));
    positions.emplace_back(uv.x(), uv.y(), 0);
  }
  return flat_atlas(positions, {face});
}

}  // namespace atlas_refine::testing
