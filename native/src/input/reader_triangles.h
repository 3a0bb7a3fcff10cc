// How the atlas' reader divides its polygons.
#pragma once

#include <optional>
#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

/// Atlas::triangles, face by face.
class ReaderTriangles {
 public:
  explicit ReaderTriangles(const Atlas& atlas);

  /// Over the places of `corners`, which are those of the face in the order of its chart. Nothing where the face is not named, or
  /// its triangles do not make up the polygon.
  std::optional<std::vector<Triangle>> of_face(int face, const std::vector<int>& corners) const;

 private:
  const Atlas& atlas_;
  std::vector<int> first_;  ///< of each face, into order_; empty where no face is named
  std::vector<int> order_;  ///< indices into Atlas::triangles, by face
};

}  // namespace atlas_refine
