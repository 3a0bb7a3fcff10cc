// What the corners of a CutMesh were before the cut.
#pragma once

#include <array>

#include "atlas_refine/result.h"

namespace atlas_refine::cli {

/// A new vertex as a point of one face: up to three of the face's corners and their weights.
struct FacePoint {
  std::array<int, 3> corners;
  Vec3 weights;

  /// The corner that counts most.
  int nearest() const;
};

/// The corner of `face` that holds `vertex`, -1 where none does.
int corner_with_vertex(const Atlas& atlas, int face, int vertex);

/// `vertex` seen from `face`, which has it inside or on an edge. Faces on both sides of an edge may have vertices of their own
/// there, so corners of the other face are found by vertex and else by position.
FacePoint point_of_face(const Atlas& atlas, const NewVertex& vertex, int face);

Vec3 position_of(const Atlas& atlas, const NewVertex& vertex);

}  // namespace atlas_refine::cli
