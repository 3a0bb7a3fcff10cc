// Surfaces without a boundary, or with a handle, whose UVs are no map of them.
#pragma once

#include <cmath>
#include <numbers>

#include "atlas_refine/atlas.h"
#include "input/split_charts.h"

namespace atlas_refine::shapes {

inline void add_quad(Atlas& atlas, const std::array<int, 4>& vertices) {
  if (atlas.face_offsets.empty()) atlas.face_offsets = {0};
  for (const int v : vertices) {
    atlas.corner_vertices.push_back(v);
    atlas.corner_uvs.push_back(atlas.positions[v].head<2>());
  }
  atlas.face_offsets.push_back(atlas.corner_count());
}

/// A torus of quads, radii 3 and 1; every face whose number is a multiple of (faces / holes) is left out. UVs: seen from above.
inline Atlas torus(int around, int tube, int holes = 0) {
  Atlas atlas;
  for (int i = 0; i < around * tube; ++i) {
    const double a = 2 * std::numbers::pi * (i / tube) / around, b = 2 * std::numbers::pi * (i % tube) / tube;
    atlas.positions.emplace_back((3 + std::cos(b)) * std::cos(a), (3 + std::cos(b)) * std::sin(a), std::sin(b));
  }
  const auto at = [&](int i, int j) { return (i % around) * tube + j % tube; };
  for (int f = 0; f < around * tube; ++f) {
    if (holes > 0 && f % (around * tube / holes) == 0) continue;
    const int i = f / tube, j = f % tube;
    add_quad(atlas, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  }
  return atlas;
}

/// A cube of n x n quads a side; doubled vertices along the cube's edges lie at equal positions. UVs:
/// seen from above.
inline Atlas cube(int n) {
  Atlas atlas;
  for (int side = 0; side < 6; ++side) {
    const int first = static_cast<int>(atlas.positions.size());
    const int axis = side / 2;
    const double sign = side % 2 == 0 ? 1 : -1;
    for (int k = 0; k < (n + 1) * (n + 1); ++k) {
      Vec3 p;
      p[axis] = n * sign;
      p[(axis + 1) % 3] = (2 * (k % (n + 1)) - n) * sign;
      p[(axis + 2) % 3] = 2 * (k / (n + 1)) - n;
      atlas.positions.push_back(p / n);
    }
    for (int f = 0; f < n * n; ++f) {
      const int at = first + f / n * (n + 1) + f % n;
      add_quad(atlas, {at, at + 1, at + n + 2, at + n + 1});
    }
  }
  return atlas;
}

/// The same with its vertices on a sphere.
inline Atlas cube_sphere(int n) {
  Atlas atlas = cube(n);
  for (std::size_t v = 0; v < atlas.positions.size(); ++v)
    atlas.positions[v] /= std::sqrt(atlas.positions[v].dot(atlas.positions[v]));
  for (int c = 0; c < atlas.corner_count(); ++c) atlas.corner_uvs[c] = atlas.positions[atlas.corner_vertices[c]].head<2>();
  return atlas;
}

/// UVs once around and once about the tube of a torus, shared where they start again: faces there span the map.
inline Atlas wrapped(Atlas torus) {
  for (int c = 0; c < torus.corner_count(); ++c) {
    const Vec3& p = torus.positions[torus.corner_vertices[c]];
    const double tube = std::atan2(p.z(), std::hypot(p.x(), p.y()) - 3);
    torus.corner_uvs[c] = Vec2(std::atan2(p.y(), p.x()), tube) / (2 * std::numbers::pi);
  }
  return torus;
}

/// Charts as they hang together in the UV map, folded ones whole.
inline std::vector<Chart> unparted(const Atlas& atlas) { return split_charts(atlas, Joining::Exact).charts; }

}  // namespace atlas_refine::shapes
