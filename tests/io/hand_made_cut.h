// Cut meshes that tests write down: what each corner is the mean of follows from the new vertices.
#pragma once

#include <stdexcept>

#include "atlas_refine/result.h"

namespace atlas_refine::io {

/// Fills in corner_sources and corner_weights. A new vertex seen from another face than its own has that face's corners at the
/// same positions.
inline void add_corner_means(CutMesh& cut, const Atlas& atlas) {
  const auto corner_where = [&](int face, const auto& holds) {
    for (int c = atlas.face_offsets[face]; c < atlas.face_offsets[face + 1]; ++c) {
      if (holds(atlas.corner_vertices[c])) return c;
    }
    throw std::logic_error("the cut does not fit the atlas");
  };
  const auto old_vertices = static_cast<int>(atlas.positions.size());
  for (std::size_t part = 0; part < cut.face_sources.size(); ++part) {
    const int face = cut.face_sources[part];
    for (int c = cut.face_offsets[part]; c < cut.face_offsets[part + 1]; ++c) {
      const int vertex = cut.corner_vertices[c];
      auto& sources = cut.corner_sources.emplace_back();
      cut.corner_weights.emplace_back(1, 0, 0);
      if (vertex < old_vertices) {
        sources.fill(corner_where(face, [&](int v) { return v == vertex; }));
        continue;
      }
      const NewVertex& point = cut.new_vertices[vertex - old_vertices];
      cut.corner_weights.back() = point.weights;
      int heaviest = 0;
      point.weights.maxCoeff(&heaviest);
      for (int k = 0; k < 3; ++k) {
        const int like = point.corners[point.weights[k] > 0 ? k : heaviest];
        const Vec3& place = atlas.positions[atlas.corner_vertices[like]];
        sources[k] = corner_where(face, [&](int v) { return atlas.positions[v] == place; });
      }
    }
  }
}

}  // namespace atlas_refine::io
