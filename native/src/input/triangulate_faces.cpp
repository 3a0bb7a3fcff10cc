// Triangles as they are, polygons by a fan or by the triangulation of their UV outline.
#include "input/triangulate_faces.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "geometry/plane.h"
#include "geometry/predicates.h"
#include "geometry/triangulate_polygon.h"

namespace atlas_refine {

namespace {

/// The corners of a face in the order that its chart has them in.
std::vector<int> face_corners(const Atlas& atlas, int face, bool turned) {
  std::vector<int> corners(atlas.face_offsets[face + 1] - atlas.face_offsets[face]);
  std::iota(corners.begin(), corners.end(), atlas.face_offsets[face]);
  if (turned) std::reverse(corners.begin() + 1, corners.end());
  return corners;
}

/// What is wrong with a face that has no positive triangulation.
FaceDefect::Kind defect_of(const std::vector<Vec2>& uvs) {
  bool negative = false, zero = false;
  double doubled = 0;
  for (std::size_t i = 2; i < uvs.size(); ++i) {
    const int sign = orientation(uvs[0], uvs[i - 1], uvs[i]);
    negative = negative || sign < 0;
    zero = zero || sign == 0;
    doubled += doubled_area(uvs[0], uvs[i - 1], uvs[i]);
  }
  if (zero && !negative) return FaceDefect::Kind::ZeroArea;
  return uvs.size() > 3 && doubled > 0 ? FaceDefect::Kind::CrossesItself : FaceDefect::Kind::Flipped;
}

/// Triangles over the corners of a face; nothing where they cannot all be positive.
std::optional<std::vector<Triangle>> positive_triangles(const Atlas& atlas, const std::vector<int>& corners,
                                                        const std::vector<Vec2>& uvs) {
  if (uvs.size() == 3) {
    return orientation(uvs[0], uvs[1], uvs[2]) > 0 ? std::optional(polygon_fan(3)) : std::nullopt;
  }
  std::vector<Vec3> positions;
  for (int c : corners) positions.push_back(atlas.positions[atlas.corner_vertices[c]]);
  return triangulate_polygon(uvs, positions);
}

}  // namespace

std::vector<FaceDefect> triangulate_faces(const Atlas& atlas, const std::vector<CornerRef>& corners,
                                          const std::vector<bool>& turned_faces, std::vector<Chart>& charts) {
  std::vector<FaceDefect> defects;
  std::vector<Vec2> uvs;
  for (int face = 0; face < atlas.face_count(); ++face) {
    const std::vector<int> own = face_corners(atlas, face, turned_faces[face]);
    const int k = corners[own[0]].chart;
    Chart& chart = charts[k];
    uvs.clear();
    for (int c : own) uvs.push_back(chart.uvs[corners[c].vertex]);
    std::optional<std::vector<Triangle>> triangles = positive_triangles(atlas, own, uvs);
    if (!triangles) {
      defects.push_back({k, face, defect_of(uvs)});
      triangles = polygon_fan(static_cast<int>(own.size()));
    }
    for (const Triangle& t : *triangles) {
      chart.triangles.push_back({corners[own[t[0]]].vertex, corners[own[t[1]]].vertex, corners[own[t[2]]].vertex});
      chart.triangle_faces.push_back(face);
    }
  }
  return defects;
}

}  // namespace atlas_refine
