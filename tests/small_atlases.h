// Atlases of a few faces, written out by hand.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine {

/// Faces as lists of vertices. Corner UVs are the positions' x and y.
inline Atlas flat_atlas(const std::vector<Vec3>& positions, const std::vector<std::vector<int>>& faces) {
  Atlas atlas;
  atlas.positions = positions;
  atlas.face_offsets = {0};
  for (const std::vector<int>& face : faces) {
    for (int v : face) {
      atlas.corner_vertices.push_back(v);
      atlas.corner_uvs.push_back(positions[v].head<2>());
    }
    atlas.face_offsets.push_back(atlas.corner_count());
  }
  return atlas;
}

/// The unit square of two triangles: vertices counterclockwise from the origin.
inline Atlas unit_square() { return flat_atlas({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}); }

/// A strip of quads 1 x 1 along x.
inline Atlas strip(int quads) {
  std::vector<Vec3> positions;
  std::vector<std::vector<int>> faces;
  for (int i = 0; i <= quads; ++i) {
    positions.push_back({static_cast<double>(i), 0, 0});
    positions.push_back({static_cast<double>(i), 1, 0});
  }
  for (int i = 0; i < quads; ++i) faces.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
  return flat_atlas(positions, faces);
}

/// A plank of one face, `length` x 1, its UVs as the surface.
inline Atlas plank(double length) { return flat_atlas({{0, 0, 0}, {length, 0, 0}, {length, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}); }

/// A tube without ends, `length` long, each of its sides one face, 1 wide, and a chart of its own beside the others.
inline Atlas tube(int sides, double length) {
  const double radius = 0.5 / std::sin(std::numbers::pi / sides);
  Atlas atlas;
  atlas.face_offsets = {0};
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    for (const double z : {0.0, length}) atlas.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    const int next = (k + 1) % sides;
    for (const int v : {2 * k, 2 * k + 1, 2 * next + 1, 2 * next}) atlas.corner_vertices.push_back(v);
    for (const Vec2& uv : {Vec2(0, 0), Vec2(length, 0), Vec2(length, 1), Vec2(0, 1)})
      atlas.corner_uvs.emplace_back(uv.x(), uv.y() + 1.5 * k);
    atlas.face_offsets.push_back(atlas.corner_count());
  }
  return atlas;
}

/// An open tube of quads, `along` rows of `around`, radius and rows 1, its UVs a ring: as seen from one end, each row smaller
/// than the one before it and turned by `twist_rad` against it.
inline Atlas tube_as_ring(int around, int along, double twist_rad) {
  constexpr double kNarrower = 0.7;
  std::vector<Vec3> positions;
  std::vector<std::vector<int>> faces;
  for (int j = 0; j <= along; ++j) {
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      positions.emplace_back(std::cos(angle), std::sin(angle), j);
      const int next = (i + 1) % around, row = j * around;
      if (j < along) faces.push_back({row + i, row + around + i, row + around + next, row + next});
    }
  }
  Atlas atlas = flat_atlas(positions, faces);
  for (int c = 0; c < atlas.corner_count(); ++c) {
    const Vec3& p = positions[atlas.corner_vertices[c]];
    const double radius = std::pow(kNarrower, p.z()), angle = std::atan2(p.y(), p.x()) + twist_rad * p.z();
    atlas.corner_uvs[c] = radius * Vec2(std::cos(angle), std::sin(angle));
  }
  return atlas;
}

/// A cone, rolled out in the UVs to half a square; its tip is a whole column of vertices, each one at the same place.
inline Atlas cone(int count) {
  std::vector<Vec3> positions;
  std::vector<std::vector<int>> faces;
  for (int j = 0; j <= count; ++j) {
    for (int i = 0; i <= count; ++i) positions.push_back(Vec3(i, j, 0) / count);
  }
  for (int j = 0; j < count; ++j) {
    for (int i = 0; i + j < count; ++i) {
      const int v = j * (count + 1) + i;
      faces.push_back({v, v + 1, v + count + 2, v + count + 1});
    }
  }
  Atlas atlas = flat_atlas(positions, faces);
  for (Vec3& p : atlas.positions) {
    const double x = p.x(), turn = 1.5 * std::numbers::pi * p.y();
    p = Vec3(x * std::cos(turn), x * std::sin(turn), x);
  }
  return atlas;
}

/// Adds `by` to the UVs of one face.
inline void shift_face(Atlas& atlas, int face, const Vec2& by) {
  for (int c = atlas.face_offsets[face]; c < atlas.face_offsets[face + 1]; ++c) atlas.corner_uvs[c] += by;
}

}  // namespace atlas_refine
