// A chart: the value that passes between the stages.
#pragma once

#include <array>
#include <vector>

#include "atlas_refine/atlas.h"
#include "geometry/surface.h"

namespace atlas_refine {

using Triangle = std::array<int, 3>;

/// A triangle over three corners of a polygon that is none of the chart's own. Where it stays positive too, the face is valid
/// for readers that divide it otherwise.
struct Guard {
  Triangle triangle;
  int face;            ///< of the input
  RestTriangle shape;  ///< in space; of polygons that are folded there that of the input's UVs, at the surface's scale
  double share = 0;    ///< the part of its area that counts in measures; 0: it is only kept positive
};

/// A connected piece of the UV map. Vertices are UV vertices: one per fan of corners that share UVs.
struct Chart {
  std::vector<Vec2> uvs;                         ///< one per UV vertex
  std::vector<Triangle> triangles;               ///< local vertex indices, counterclockwise in the UV plane
  Surface surface;                               ///< one shape per triangle
  std::vector<int> triangle_faces;               ///< one per triangle: the input face it came from
  std::vector<Guard> guards;                     ///< ordered by their faces
  std::vector<std::vector<int>> boundary_loops;  ///< vertex loops, the chart on the left; the loop of largest |area| first
  int number = -1;                               ///< of the input's chart that it is or is part of: what messages name

  int vertex_count() const { return static_cast<int>(uvs.size()); }
};

struct Box {
  Vec2 min = Vec2::Zero();
  Vec2 max = Vec2::Zero();
  Vec2 size() const { return max - min; }
  double area() const { return size().x() * size().y(); }
  double diagonal() const { return size().norm(); }
};

}  // namespace atlas_refine
