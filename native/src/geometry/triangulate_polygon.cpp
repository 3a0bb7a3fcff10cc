// Triangulation of one polygon face: the fan where that is good, else CGAL's constrained Delaunay triangulation.
#include "geometry/triangulate_polygon.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "geometry/plane.h"
#include "geometry/predicates.h"

namespace atlas_refine {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel,
    CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<Kernel>,
                                         CGAL::Constrained_triangulation_face_base_2<Kernel>>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

/// A fan triangle below this share of the mean one is a sliver, in the UV plane or in space; another diagonal is better.
constexpr double kSmallestShare = 0.05;

bool fan_fits_uvs(const std::vector<Vec2>& uvs) {
  const double smallest = kSmallestShare * doubled_area(uvs) / static_cast<double>(uvs.size() - 2);
  for (std::size_t i = 2; i < uvs.size(); ++i) {
    if (orientation(uvs[0], uvs[i - 1], uvs[i]) <= 0 || doubled_area(uvs[0], uvs[i - 1], uvs[i]) < smallest) return false;
  }
  return true;
}

bool fan_fits_positions(const std::vector<Vec3>& positions) {
  const auto normal = [&](std::size_t i) -> Vec3 { return (positions[i - 1] - positions[0]).cross(positions[i] - positions[0]); };
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < positions.size(); ++i) sum += normal(i);
  const double smallest = kSmallestShare * sum.squaredNorm() / static_cast<double>(positions.size() - 2);
  for (std::size_t i = 2; i < positions.size(); ++i) {
    if (normal(i).dot(sum) < smallest) return false;
  }
  return true;
}

/// The polygon as edges of a triangulation. A place that the polygon comes to several times is one vertex of it.
struct Inserted {
  Delaunay delaunay;
  std::vector<Delaunay::Vertex_handle> places;  // of each corner

  int count() const { return static_cast<int>(places.size()); }
  Delaunay::Vertex_handle next(int corner) const { return places[(corner + 1) % count()]; }
  Delaunay::Vertex_handle previous(int corner) const { return places[(corner + count() - 1) % count()]; }
};

/// False unless each edge of the polygon is one edge of the triangulation.
bool insert_polygon(const std::vector<Vec2>& uvs, Inserted& polygon) {
  Delaunay& delaunay = polygon.delaunay;
  Delaunay::Face_handle near;
  for (const Vec2& uv : uvs) {
    polygon.places.push_back(delaunay.insert(Kernel::Point_2(uv.x(), uv.y()), near));
    near = polygon.places.back()->face();
  }
  if (delaunay.dimension() != 2) return false;
  try {
    for (int i = 0; i < polygon.count(); ++i) {
      if (polygon.places[i] == polygon.next(i)) return false;
      delaunay.insert_constraint(polygon.places[i], polygon.next(i));
    }
  } catch (const Delaunay::Intersection_of_constraints_exception&) {
    return false;
  }
  for (int i = 0; i < polygon.count(); ++i) {
    if (!delaunay.is_edge(polygon.places[i], polygon.next(i))) return false;
  }
  return true;
}

/// The triangle on the left of the edge from corner i on, and the index of that corner's place in it.
std::pair<Delaunay::Face_handle, int> left_of_edge(const Inserted& polygon, int i) {
  Delaunay::Face_handle face;
  int opposite = 0;
  polygon.delaunay.is_edge(polygon.places[i], polygon.next(i), face, opposite);
  if (face->vertex(Delaunay::ccw(opposite)) != polygon.places[i]) {
    const auto other = face->neighbor(opposite);
    opposite = polygon.delaunay.mirror_index(face, opposite);
    face = other;
  }
  return {face, Delaunay::ccw(opposite)};
}

/// A triangle's corners in the polygon, -1 where not known.
using Corners = std::map<Delaunay::Face_handle, Triangle>;

/// The corners of all triangles inside, from each corner of the polygon around its place from one of its edges to the other:
/// of a polygon that comes to a place several times only so they are told apart. Nothing where an outer face is met, or one
/// twice.
std::optional<Corners> corners_inside(const Inserted& polygon) {
  Corners out;
  for (int i = 0; i < polygon.count(); ++i) {
    auto [face, at] = left_of_edge(polygon, i);
    for (;;) {
      if (polygon.delaunay.is_infinite(face)) return std::nullopt;
      int& corner = out.emplace(face, Triangle{-1, -1, -1}).first->second[at];
      if (corner >= 0) return std::nullopt;
      corner = i;
      // On across the side that comes before this corner.
      const int side = Delaunay::ccw(at);
      if (face->vertex(Delaunay::cw(at)) == polygon.previous(i)) break;
      if (polygon.delaunay.is_constrained({face, side})) return std::nullopt;
      face = face->neighbor(side);
      at = face->index(polygon.places[i]);
    }
  }
  return out;
}

}  // namespace

std::vector<Triangle> polygon_fan(int corner_count) {
  std::vector<Triangle> fan;
  for (int i = 2; i < corner_count; ++i) fan.push_back({0, i - 1, i});
  return fan;
}

std::optional<std::vector<Triangle>> triangulate_polygon(const std::vector<Vec2>& uvs, const std::vector<Vec3>& positions) {
  const int count = static_cast<int>(uvs.size());
  if (fan_fits_uvs(uvs) && fan_fits_positions(positions)) return polygon_fan(count);
  Inserted polygon;
  if (!(0.5 * doubled_area(uvs) > 0) || !insert_polygon(uvs, polygon)) return std::nullopt;
  const std::optional<Corners> corners = corners_inside(polygon);
  if (!corners || static_cast<int>(corners->size()) != count - 2) return std::nullopt;
  std::vector<Triangle> triangles;
  for (auto [face, t] : *corners) {
    if (std::find(t.begin(), t.end(), -1) != t.end()) return std::nullopt;
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.push_back(t);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace atlas_refine
