// CGAL's constrained Delaunay triangulation on its filtered kernel Epick.
#include "geometry/triangulate_region.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <utility>

namespace atlas_refine {
namespace {

enum class Side : char { Unknown, Outside, Inside };

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<Side, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                                            CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Handles = std::vector<Delaunay::Vertex_handle>;

/// False where two points are one, or all lie on one line.
bool insert_points(const Region& region, Delaunay& delaunay, Handles& handles) {
  const int count = static_cast<int>(region.points.size());
  handles.resize(count);
  Delaunay::Face_handle last;
  for (int i = 0; i < count; ++i) {
    const Delaunay::Face_handle near = region.near[i] >= 0 ? handles[region.near[i]]->face() : last;
    handles[i] = delaunay.insert(Kernel::Point_2(region.points[i].x(), region.points[i].y()), near);
    handles[i]->info() = i;
    last = handles[i]->face();
  }
  return static_cast<int>(delaunay.number_of_vertices()) == count && delaunay.dimension() == 2;
}

/// False where constraints cross each other or run through points.
bool insert_edges(const std::vector<std::array<int, 2>>& edges, const Handles& handles, Delaunay& delaunay) {
  try {
    for (const auto& [a, b] : edges) delaunay.insert_constraint(handles[a], handles[b]);
  } catch (const Delaunay::Intersection_of_constraints_exception&) {
    return false;
  }
  return std::all_of(edges.begin(), edges.end(),
                     [&](const std::array<int, 2>& e) { return delaunay.is_edge(handles[e[0]], handles[e[1]]); });
}

/// `next`: the vertex after each vertex on its loop, -1 inside.
bool on_loop(const Delaunay::Edge& edge, const std::vector<int>& next) {
  const int a = edge.first->vertex(Delaunay::ccw(edge.second))->info(), b = edge.first->vertex(Delaunay::cw(edge.second))->info();
  return next[a] == b || next[b] == a;
}

/// From the infinite face, which lies outside; crossing a loop changes sides.
void mark_sides(const std::vector<int>& next, Delaunay& delaunay) {
  for (auto face : delaunay.all_face_handles()) face->info() = Side::Unknown;
  std::vector<Delaunay::Face_handle> stack = {delaunay.infinite_face()};
  stack.back()->info() = Side::Outside;
  while (!stack.empty()) {
    const Delaunay::Face_handle face = stack.back();
    stack.pop_back();
    for (int i = 0; i < 3; ++i) {
      const Delaunay::Face_handle other = face->neighbor(i);
      if (other->info() != Side::Unknown) continue;
      const bool crosses = delaunay.is_constrained({face, i}) && on_loop({face, i}, next);
      other->info() = crosses == (face->info() == Side::Outside) ? Side::Inside : Side::Outside;
      stack.push_back(other);
    }
  }
}

}  // namespace

std::optional<std::vector<Triangle>> triangulate_region(const Region& region) {
  Delaunay delaunay;
  Handles handles;
  if (!insert_points(region, delaunay, handles)) return std::nullopt;
  std::vector<std::array<int, 2>> edges = region.chords;
  std::vector<int> next(region.points.size(), -1);
  for (const std::vector<int>& loop : region.loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      next[loop[k]] = loop[(k + 1) % loop.size()];
      edges.push_back({loop[k], next[loop[k]]});
    }
  }
  if (!insert_edges(std::move(edges), handles, delaunay)) return std::nullopt;
  mark_sides(next, delaunay);
  std::vector<Triangle> triangles;
  for (auto face : delaunay.finite_face_handles()) {
    if (face->info() != Side::Inside) continue;
    Triangle t = {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.push_back(t);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace atlas_refine
