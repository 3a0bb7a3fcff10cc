// Triangulation of one polygon face: the fan where that is good, else CGAL's constrained Delaunay triangulation.
#include "geometry/triangulate_polygon.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "geometry/plane.h"
#include "geometry/predicates.h"

namespace atlas_refine {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<bool, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                                            CGAL::No_constraint_intersection_tag>;

/// A fan triangle below this share of the mean one is a sliver, in the UV plane or in space; another diagonal is better.
constexpr double kSmallestShare = 0.05;

double polygon_area(const std::vector<Vec2>& uvs) {
  double doubled = 0;
  for (std::size_t i = 2; i < uvs.size(); ++i) doubled += doubled_area(uvs[0], uvs[i - 1], uvs[i]);
  return 0.5 * doubled;
}

bool fan_fits_uvs(const std::vector<Vec2>& uvs) {
  const double smallest = kSmallestShare * 2 * polygon_area(uvs) / static_cast<double>(uvs.size() - 2);
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

/// Inserts the polygon; false unless its corners are distinct and each of its edges is one edge of the triangulation, which
/// is to say that the polygon is simple.
bool insert_polygon(const std::vector<Vec2>& uvs, Delaunay& delaunay) {
  const int count = static_cast<int>(uvs.size());
  std::vector<Delaunay::Vertex_handle> handles(count);
  Delaunay::Face_handle near;
  for (int i = 0; i < count; ++i) {
    handles[i] = delaunay.insert(Kernel::Point_2(uvs[i].x(), uvs[i].y()), near);
    handles[i]->info() = i;
    near = handles[i]->face();
  }
  if (static_cast<int>(delaunay.number_of_vertices()) != count || delaunay.dimension() != 2) return false;
  try {
    for (int i = 0; i < count; ++i) delaunay.insert_constraint(handles[i], handles[(i + 1) % count]);
  } catch (const Delaunay::Intersection_of_constraints_exception&) {
    return false;
  }
  for (int i = 0; i < count; ++i) {
    if (!delaunay.is_edge(handles[i], handles[(i + 1) % count])) return false;
  }
  return true;
}

/// Marks (info) the faces reached from the infinite one without crossing the polygon.
void mark_outside(Delaunay& delaunay) {
  for (auto face : delaunay.all_face_handles()) face->info() = false;
  std::vector<Delaunay::Face_handle> stack = {delaunay.infinite_face()};
  stack.back()->info() = true;
  while (!stack.empty()) {
    const Delaunay::Face_handle face = stack.back();
    stack.pop_back();
    for (int i = 0; i < 3; ++i) {
      const Delaunay::Face_handle next = face->neighbor(i);
      if (next->info() || delaunay.is_constrained({face, i})) continue;
      next->info() = true;
      stack.push_back(next);
    }
  }
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
  Delaunay delaunay;
  if (polygon_area(uvs) <= 0 || !insert_polygon(uvs, delaunay)) return std::nullopt;
  mark_outside(delaunay);
  std::vector<Triangle> triangles;
  for (auto face : delaunay.finite_face_handles()) {
    if (face->info()) continue;
    Triangle t = {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.push_back(t);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace atlas_refine
