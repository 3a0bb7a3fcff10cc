// Triangles as they are, polygons as their reader divides them, by a fan or by the triangulation of their UV outline; what
// crosses itself so that the least of it is flipped.
#include "input/triangulate_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <optional>

#include "geometry/convex_polygon.h"
#include "geometry/least_flipped.h"
#include "geometry/plane.h"
#include "geometry/predicates.h"
#include "geometry/rest_triangle.h"
#include "geometry/triangulate_polygon.h"
#include "input/face_areas.h"
#include "input/reader_triangles.h"

namespace atlas_refine {

namespace {

// Flipped area, of a square of the face's size, above the least, that a division is taken with: the reader's, which the face will
// be seen by, and a fan, which must not spoil what is small. Where all flip much, a fan may flip ten times as much.
constexpr double kReaders = 1e-3, kFan = 1e-9, kFanMore = 10;

/// A guard's part of its face in the UVs / that in space, below which it has no shape worth keeping.
constexpr double kCrushed = 1e-3;

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

bool all_positive(const std::vector<Triangle>& triangles, const std::vector<Vec2>& uvs) {
  return std::all_of(triangles.begin(), triangles.end(),
                     [&](const Triangle& t) { return orientation(uvs[t[0]], uvs[t[1]], uvs[t[2]]) > 0; });
}

/// One face, its corners in the order of its chart.
struct Outline {
  std::vector<int> corners;
  std::vector<Vec2> uvs;
  std::vector<Vec3> positions;

  int size() const { return static_cast<int>(corners.size()); }
};

/// Triangles over the corners of a face; nothing where they cannot all be positive.
std::optional<std::vector<Triangle>> positive_triangles(int face, const Outline& outline, const ReaderTriangles& reader) {
  if (outline.size() == 3) return std::nullopt;  // see add_positive_triangle()
  if (auto own = reader.of_face(face, outline.corners); own && all_positive(*own, outline.uvs)) return own;
  return triangulate_polygon(outline.uvs, outline.positions);
}

bool has_repeats(std::vector<int> values) {
  std::sort(values.begin(), values.end());
  return std::adjacent_find(values.begin(), values.end()) != values.end();
}

/// As the input has them, counterclockwise for the most part.
std::vector<Vec2> uvs_turned_up(const Atlas& atlas, const std::vector<int>& corners) {
  std::vector<Vec2> uvs;
  for (int c : corners) uvs.push_back(atlas.corner_uvs[c]);
  const double turned = doubled_area(uvs) < 0 ? -1 : 1;
  for (Vec2& uv : uvs) uv.x() *= turned;
  return uvs;
}

/// A face without a positive triangulation, as its reader divides it or as a fan where next to nothing of it runs backwards more
/// than it must: what crosses itself by a hair is to be mended by a hair. Corners that are one vertex of the chart may not meet
/// in a triangle; such a face has a triangulation where the input has its corners: noise was settled since.
std::vector<Triangle> any_triangles(const Atlas& atlas, const std::vector<CornerRef>& corners, int face, const Outline& outline,
                                    const ReaderTriangles& reader) {
  std::vector<int> vertices;
  for (int c : outline.corners) vertices.push_back(corners[c].vertex);
  const bool repeats = has_repeats(vertices);
  if (repeats) {
    if (const auto as_read = triangulate_polygon(uvs_turned_up(atlas, outline.corners), outline.positions)) return *as_read;
  }
  const std::vector<Triangle> fan = polygon_fan(outline.size());
  if (outline.size() == 3) return fan;
  const FlippedArea flipped(outline.uvs, outline.positions);
  const auto best = least_flipped(flipped, vertices);
  if (!best) return fan;
  const double least = flipped.of(*best);
  if (const auto own = reader.of_face(face, outline.corners); own && !repeats && flipped.of(*own) < least + kReaders) return *own;
  return !repeats && flipped.of(fan) < kFanMore * least + kFan ? fan : *best;
}

FaceReading reading_of(int chart, const Outline& outline, bool has_triangles) {
  const bool fan = all_positive(polygon_fan(outline.size()), outline.uvs);
  return {chart, fan, has_triangles, outline.size() == 3 ? fan : is_strictly_convex(outline.uvs)};
}

/// Whether both are one triangle; corners may start anywhere.
bool same_triangle(Triangle a, Triangle b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

/// What else than its own triangles is to stay positive; see triangulate_faces().
std::vector<Triangle> guards_of(const Outline& outline, const FaceReading& reading, const std::vector<Triangle>& own) {
  std::vector<Triangle> wanted;
  if (reading.diagonals && (outline.size() == 4 || is_convex_above_noise(outline.uvs))) {
    for (int i = 0; i < outline.size(); ++i) wanted.push_back(corner_triangle(i, outline.size()));
  } else if (reading.fan) {
    wanted = polygon_fan(outline.size());
  }
  std::erase_if(wanted, [&](const Triangle& t) {
    const bool is_own = std::any_of(own.begin(), own.end(), [&](const Triangle& other) { return same_triangle(t, other); });
    return is_own || rest_from_plane(outline.uvs[t[0]], outline.uvs[t[1]], outline.uvs[t[2]], 1).area == 0;
  });
  return wanted;
}

/// Twice the area of a triangle of the face / that of the face, in the UVs and in space.
struct Part {
  double in_uvs, in_space;
};

Part part_of(const Atlas& atlas, int face, const Outline& outline, const Triangle& t) {
  const auto& uv = outline.uvs;
  const auto& p = outline.positions;
  return {doubled_area(uv[t[0]], uv[t[1]], uv[t[2]]) / doubled_area(uv),
          (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm() / doubled_area_in_space(atlas, face)};
}

/// Guards with their shapes in space, where the polygon is clearly convex there; none where one of them is so thin in the UVs
/// that it would stop the engine: the corner counts as straight. Half of a quad's area then goes to either diagonal.
std::vector<Guard> shaped(const Atlas& atlas, int face, const Outline& outline, const std::vector<Triangle>& triangles) {
  const bool in_space = is_clearly_convex(outline.positions);
  const double share = in_space && outline.size() == 4 && is_clearly_convex(outline.uvs) ? 0.5 : 0;
  std::vector<Guard> out;
  for (const Triangle& t : triangles) {
    const auto& p = outline.positions;
    const Part part = part_of(atlas, face, outline, t);
    if (in_space && part.in_uvs < kCrushed * part.in_space) return {};
    out.push_back({t, face, in_space ? rest_from_space(p[t[0]], p[t[1]], p[t[2]]) : RestTriangle{Mat2::Zero(), 0}, share});
  }
  return out;
}

/// What needs no outline: a face of three corners that is positive.
bool add_positive_triangle(const Atlas& atlas, const std::vector<CornerRef>& corners, int face, bool turned, Chart& chart) {
  const int first = atlas.face_offsets[face];
  if (atlas.face_offsets[face + 1] - first != 3) return false;
  const auto vertex = [&](int c) { return corners[c].vertex; };
  const Triangle t = {vertex(first), vertex(turned ? first + 2 : first + 1), vertex(turned ? first + 1 : first + 2)};
  if (orientation(chart.uvs[t[0]], chart.uvs[t[1]], chart.uvs[t[2]]) <= 0) return false;
  chart.triangles.push_back(t);
  chart.triangle_faces.push_back(face);
  return true;
}

}  // namespace

FaceTriangles triangulate_faces(const Atlas& atlas, const std::vector<CornerRef>& corners, const std::vector<bool>& turned_faces,
                                std::vector<Chart>& charts) {
  FaceTriangles out;
  const ReaderTriangles reader(atlas);
  for (int face = 0; face < atlas.face_count(); ++face) {
    const int own = corners[atlas.face_offsets[face]].chart;
    if (add_positive_triangle(atlas, corners, face, turned_faces[face], charts[own])) {
      out.readings.push_back({own, true, true, true});
      continue;
    }
    Outline outline{face_corners(atlas, face, turned_faces[face]), {}, {}};
    Chart& chart = charts[own];
    for (int c : outline.corners) {
      outline.uvs.push_back(chart.uvs[corners[c].vertex]);
      outline.positions.push_back(atlas.positions[atlas.corner_vertices[c]]);
    }
    const auto on_chart = [&](const Triangle& t) -> Triangle {
      return {corners[outline.corners[t[0]]].vertex, corners[outline.corners[t[1]]].vertex,
              corners[outline.corners[t[2]]].vertex};
    };
    std::optional<std::vector<Triangle>> triangles = positive_triangles(face, outline, reader);
    out.readings.push_back(reading_of(own, outline, triangles.has_value()));
    if (!triangles) {
      out.defects.push_back({own, face, defect_of(outline.uvs)});
      triangles = any_triangles(atlas, corners, face, outline, reader);
    }
    for (const Triangle& t : *triangles) {
      chart.triangles.push_back(on_chart(t));
      chart.triangle_faces.push_back(face);
    }
    if (!out.readings.back().ears) continue;
    for (Guard& guard : shaped(atlas, face, outline, guards_of(outline, out.readings.back(), *triangles))) {
      guard.triangle = on_chart(guard.triangle);
      chart.guards.push_back(guard);
    }
  }
  return out;
}

}  // namespace atlas_refine
