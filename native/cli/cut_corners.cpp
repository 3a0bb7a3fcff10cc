// What the corners of a CutMesh were before the cut.
#include "cut_corners.h"

#include <stdexcept>

namespace atlas_refine::cli {

namespace {

int corner_at_position(const Atlas& atlas, int face, const Vec3& position) {
  for (int c = atlas.face_offsets[face]; c < atlas.face_offsets[face + 1]; ++c) {
    if (atlas.positions[atlas.corner_vertices[c]] == position) return c;
  }
  return -1;
}

}  // namespace

int FacePoint::nearest() const {
  int k = 0;
  weights.maxCoeff(&k);
  return corners[k];
}

int corner_with_vertex(const Atlas& atlas, int face, int vertex) {
  for (int c = atlas.face_offsets[face]; c < atlas.face_offsets[face + 1]; ++c) {
    if (atlas.corner_vertices[c] == vertex) return c;
  }
  return -1;
}

FacePoint point_of_face(const Atlas& atlas, const NewVertex& vertex, int face) {
  FacePoint point{vertex.corners, vertex.weights};
  for (int k = 0; k < 3; ++k) {
    const int corner = vertex.corners[k];
    if (corner >= atlas.face_offsets[face] && corner < atlas.face_offsets[face + 1]) continue;
    if (vertex.weights[k] == 0) {
      point.corners[k] = atlas.face_offsets[face];
      continue;
    }
    const int of_corner = atlas.corner_vertices[corner];
    point.corners[k] = corner_with_vertex(atlas, face, of_corner);
    if (point.corners[k] < 0) point.corners[k] = corner_at_position(atlas, face, atlas.positions[of_corner]);
    if (point.corners[k] < 0) throw std::logic_error("a new vertex is not a point of face " + std::to_string(face));
  }
  return point;
}

Vec3 position_of(const Atlas& atlas, const NewVertex& vertex) {
  Vec3 position = Vec3::Zero();
  for (int k = 0; k < 3; ++k) position += vertex.weights[k] * atlas.positions[atlas.corner_vertices[vertex.corners[k]]];
  return position;
}

}  // namespace atlas_refine::cli
