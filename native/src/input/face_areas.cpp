// Fans from the first corner: signed parts add up whatever the polygon's outline.
#include "input/face_areas.h"

#include <Eigen/Geometry>

#include "geometry/plane.h"

namespace atlas_refine {

double doubled_uv_area(const Atlas& atlas, int face) {
  const int first = atlas.face_offsets[face];
  double sum = 0;
  for (int c = first + 2; c < atlas.face_offsets[face + 1]; ++c) {
    sum += doubled_area(atlas.corner_uvs[first], atlas.corner_uvs[c - 1], atlas.corner_uvs[c]);
  }
  return sum;
}

double doubled_area_in_space(const Atlas& atlas, int face) {
  const int first = atlas.face_offsets[face];
  const auto position = [&](int c) -> const Vec3& { return atlas.positions[atlas.corner_vertices[c]]; };
  Vec3 sum = Vec3::Zero();
  for (int c = first + 2; c < atlas.face_offsets[face + 1]; ++c) {
    sum += (position(c - 1) - position(first)).cross(position(c) - position(first));
  }
  return sum.norm();
}

}  // namespace atlas_refine
