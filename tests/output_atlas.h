// The mesh that a result describes.
#pragma once

#include "atlas_refine/result.h"

namespace atlas_refine::testing {

/// The input's mesh with the result's UVs; where charts were cut, the cut mesh.
inline Atlas output(const Atlas& atlas, const RefineResult& result) {
  Atlas out = atlas;
  out.corner_uvs = result.corner_uvs;
  if (!result.cut) return out;
  out.face_offsets = result.cut->face_offsets;
  out.corner_vertices = result.cut->corner_vertices;
  for (const NewVertex& vertex : result.cut->new_vertices) {
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < 3; ++k) sum += vertex.weights[k] * atlas.positions[atlas.corner_vertices[vertex.corners[k]]];
    out.positions.push_back(sum);
  }
  return out;
}

}  // namespace atlas_refine::testing
