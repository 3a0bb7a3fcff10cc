// Triangles as they are, polygons by a fan or by the triangulation of their UV outline.
#include "input/triangulate_faces.h"

#include <algorithm>
#include <optional>

#include "geometry/plane.h"
#include "geometry/predicates.h"
#include "geometry/triangulate_polygon.h"

namespace atlas_refine {

namespace {

/// A face as its chart sees it: counterclockwise where the chart is sound.
struct Polygon {
  std::vector<int> vertices;  ///< of the chart
  std::vector<Vec2> uvs;
  std::vector<Vec3> positions;
};

Polygon polygon_of(const Atlas& atlas, const std::vector<CornerRef>& corners, int face, bool turned, const Chart& chart) {
  Polygon polygon;
  const int first = atlas.face_offsets[face], end = atlas.face_offsets[face + 1];
  for (int k = first; k < end; ++k) {
    const int c = turned && k > first ? first + end - k : k;
    polygon.vertices.push_back(corners[c].vertex);
    polygon.uvs.push_back(chart.uvs[corners[c].vertex]);
    polygon.positions.push_back(atlas.positions[atlas.corner_vertices[c]]);
  }
  return polygon;
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

/// Nothing where the face has no positive triangulation.
std::optional<std::vector<Triangle>> positive_triangles(const Polygon& polygon) {
  if (polygon.uvs.size() > 3) return triangulate_polygon(polygon.uvs, polygon.positions);
  if (orientation(polygon.uvs[0], polygon.uvs[1], polygon.uvs[2]) <= 0) return std::nullopt;
  return polygon_fan(3);
}

}  // namespace

std::vector<FaceDefect> triangulate_faces(const Atlas& atlas, const std::vector<CornerRef>& corners,
                                          const std::vector<bool>& turned_faces, std::vector<Chart>& charts) {
  std::vector<FaceDefect> defects;
  for (int face = 0; face < atlas.face_count(); ++face) {
    const int k = corners[atlas.face_offsets[face]].chart;
    Chart& chart = charts[k];
    const Polygon polygon = polygon_of(atlas, corners, face, turned_faces[face], chart);
    std::optional<std::vector<Triangle>> triangles = positive_triangles(polygon);
    if (!triangles) {
      defects.push_back({k, face, defect_of(polygon.uvs)});
      triangles = polygon_fan(static_cast<int>(polygon.uvs.size()));
    }
    for (const Triangle& t : *triangles) {
      chart.triangles.push_back({polygon.vertices[t[0]], polygon.vertices[t[1]], polygon.vertices[t[2]]});
      chart.triangle_faces.push_back(face);
    }
  }
  return defects;
}

}  // namespace atlas_refine
