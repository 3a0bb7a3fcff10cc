// A chart: the value that passes between the stages.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine {

using Mat2 = Eigen::Matrix2d;
using Triangle = std::array<int, 3>;

/// The undeformed shape of one triangle: the 3D triangle laid flat, in surface units.
struct RestTriangle {
  Mat2 inverse_edges;  ///< inverse of the 2x2 matrix whose columns are the flat edges p1 - p0 and p2 - p0
  double area = 0;     ///< weight in E_d, eq. (9); > 0
};

/// A connected piece of the UV map. Vertices are UV vertices: one per fan of corners that share UVs.
struct Chart {
  std::vector<Vec2> uvs;                         ///< one per UV vertex
  std::vector<Triangle> triangles;               ///< local vertex indices, counterclockwise in the UV plane
  std::vector<RestTriangle> rest;                ///< one per triangle
  std::vector<int> triangle_faces;               ///< one per triangle: the input face it came from
  std::vector<std::vector<int>> boundary_loops;  ///< vertex loops, the chart on the left; the loop of largest |area| first

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
