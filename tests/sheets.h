// Flat sheets of quads, and what exporters, modifiers and artists do to them: noise, doubles, folds, pinches.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "small_atlases.h"
#include "support/rng.h"

namespace atlas_refine {

/// A flat sheet of quads 0.1 x 0.1, vertices row by row; UVs are the positions.
inline Atlas sheet(int columns, int rows) {
  std::vector<Vec3> positions;
  std::vector<std::vector<int>> faces;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) positions.push_back({0.1 * i, 0.1 * j, 0});
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int v = j * (columns + 1) + i;
      faces.push_back({v, v + 1, v + columns + 2, v + columns + 1});
    }
  }
  return flat_atlas(positions, faces);
}

/// The UVs of a sheet along a part of a circle of so many radians, which its first row of vertices is.
inline Atlas bent_into_arc(Atlas sheet, double turn_rad) {
  double length = 0;
  for (const Vec2& uv : sheet.corner_uvs) length = std::max(length, uv.x());
  for (Vec2& uv : sheet.corner_uvs) {
    const double radius = length / turn_rad - uv.y(), angle_rad = turn_rad * uv.x() / length;
    uv = radius * Vec2(std::sin(angle_rad), -std::cos(angle_rad));
  }
  return sheet;
}

/// Every corner's UV moved by up to `amount`, each for itself.
inline Atlas with_noise(Atlas atlas, double amount) {
  Rng rng(7, 0, 0);
  for (Vec2& uv : atlas.corner_uvs) uv += amount * Vec2(2 * rng.uniform() - 1, 2 * rng.uniform() - 1);
  return atlas;
}

/// Every face has vertices of its own.
inline Atlas unwelded(const Atlas& atlas) {
  Atlas out = atlas;
  out.positions.clear();
  for (int c = 0; c < atlas.corner_count(); ++c) {
    out.positions.push_back(atlas.positions[atlas.corner_vertices[c]]);
    out.corner_vertices[c] = c;
  }
  return out;
}

inline void add_face(Atlas& atlas, const std::vector<int>& vertices, const std::vector<Vec2>& uvs) {
  atlas.corner_vertices.insert(atlas.corner_vertices.end(), vertices.begin(), vertices.end());
  atlas.corner_uvs.insert(atlas.corner_uvs.end(), uvs.begin(), uvs.end());
  atlas.face_offsets.push_back(atlas.corner_count());
}

/// A copy of one face of another atlas with the same vertices, wound the other way round on request.
inline void add_double(Atlas& atlas, const Atlas& source, int face, bool turned) {
  const int begin = source.face_offsets[face], end = source.face_offsets[face + 1];
  std::vector<int> vertices(source.corner_vertices.begin() + begin, source.corner_vertices.begin() + end);
  std::vector<Vec2> uvs(source.corner_uvs.begin() + begin, source.corner_uvs.begin() + end);
  if (turned) {
    std::reverse(vertices.begin(), vertices.end());
    std::reverse(uvs.begin(), uvs.end());
  }
  add_face(atlas, vertices, uvs);
}

inline Atlas double_sided(int columns, int rows) {
  Atlas atlas = sheet(columns, rows);
  for (int f = 0; f < columns * rows; ++f) add_double(atlas, sheet(columns, rows), f, true);
  return atlas;
}

/// The same faces in another order.
inline Atlas shuffled(const Atlas& atlas) {
  Atlas out{atlas.name, atlas.positions, {0}, {}, {}};
  const int count = atlas.face_count();
  for (int k = 0; k < count; ++k) add_double(out, atlas, (k * 37 + 11) % count, false);  // 37 is no divisor of the counts here
  return out;
}

/// A sheet of 6 x 6 with two holes that meet at a vertex.
inline Atlas pinched_sheet() {
  const Atlas whole = sheet(6, 6);
  Atlas atlas{whole.name, whole.positions, {0}, {}, {}};
  for (int f = 0; f < 36; ++f) {
    if (f != 14 && f != 21) add_double(atlas, whole, f, false);
  }
  return atlas;
}

/// With the mirror image in the plane through the origin across an axis, as Blender's Mirror modifier makes it: vertices on the
/// plane are shared, each face of the image has the UVs of its own.
inline Atlas with_mirror(const Atlas& half, int axis) {
  Atlas out = half;
  std::vector<int> image;
  for (const Vec3& p : half.positions) {
    if (p[axis] == 0) {
      image.push_back(static_cast<int>(image.size()));
      continue;
    }
    image.push_back(static_cast<int>(out.positions.size()));
    out.positions.push_back(p);
    out.positions.back()[axis] = -p[axis];
  }
  for (int f = 0; f < half.face_count(); ++f) {
    add_double(out, half, f, true);
    for (int c = out.face_offsets[half.face_count() + f]; c < out.corner_count(); ++c)
      out.corner_vertices[c] = image[out.corner_vertices[c]];
  }
  return out;
}

/// A sheet of 6 x 4 folded in the UV plane along its middle.
inline Atlas mirrored_halves() {
  Atlas atlas = sheet(6, 4);
  for (Vec2& uv : atlas.corner_uvs) uv.x() = std::abs(uv.x() - 0.3);
  return atlas;
}

}  // namespace atlas_refine
