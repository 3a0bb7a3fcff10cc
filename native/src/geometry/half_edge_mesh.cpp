// Connectivity of a chart's triangles; of what is no manifold from an OpenMesh half-edge mesh.
#include "geometry/half_edge_mesh.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "geometry/manifold_topology.h"

namespace atlas_refine {

namespace {

using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;
using Corners = std::array<OpenMesh::VertexHandle, 3>;

/// OpenMesh accepts a face only where each of its vertices and half-edges still has a free side.
bool can_add(const Mesh& mesh, const Corners& corners) {
  for (int i = 0; i < 3; ++i) {
    if (!mesh.is_boundary(corners[i])) return false;
    const auto half_edge = mesh.find_halfedge(corners[i], corners[(i + 1) % 3]);
    if (half_edge.is_valid() && !mesh.is_boundary(half_edge)) return false;
  }
  return true;
}

/// The mesh, and for each of its vertices the vertex it stands for.
struct BuiltMesh {
  Mesh mesh;
  std::vector<int> origins;
};

BuiltMesh build_mesh(int vertex_count, const std::vector<Triangle>& triangles) {
  // OpenMesh would complain on stderr of the non-manifold faces that are handled here.
  static const bool silenced = (omerr().disable(), true);
  static_cast<void>(silenced);
  BuiltMesh built;
  built.mesh.reserve(vertex_count, vertex_count + triangles.size(), triangles.size());
  const auto add_vertex = [&](int origin) {
    built.origins.push_back(origin);
    return OpenMesh::VertexHandle(built.mesh.add_vertex(Mesh::Point(0, 0, 0)));
  };
  for (int v = 0; v < vertex_count; ++v) add_vertex(v);
  for (const Triangle& t : triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    Corners corners;
    for (int i = 0; i < 3; ++i) corners[i] = OpenMesh::VertexHandle(t[i]);
    if (can_add(built.mesh, corners) && built.mesh.add_face(corners[0], corners[1], corners[2]).is_valid()) continue;
    for (int i = 0; i < 3; ++i) corners[i] = add_vertex(t[i]);
    built.mesh.add_face(corners[0], corners[1], corners[2]);
  }
  return built;
}

/// OpenMesh's boundary half-edges run with the chart on their right, as they look out of the mesh: walk them backwards.
std::vector<std::vector<int>> boundary_loops(const BuiltMesh& built) {
  const Mesh& mesh = built.mesh;
  std::vector<std::vector<int>> loops;
  std::vector<bool> visited(mesh.n_halfedges(), false);
  for (int h = 0; h < static_cast<int>(mesh.n_halfedges()); ++h) {
    const OpenMesh::HalfedgeHandle first(h);
    if (visited[h] || !mesh.is_boundary(first)) continue;
    std::vector<int>& loop = loops.emplace_back();
    OpenMesh::HalfedgeHandle walk = first;
    do {
      visited[walk.idx()] = true;
      loop.push_back(built.origins[mesh.to_vertex_handle(walk).idx()]);
      walk = mesh.prev_halfedge_handle(walk);
    } while (walk != first);
  }
  return loops;
}

}  // namespace

MeshTopology mesh_topology(int vertex_count, const std::vector<Triangle>& triangles) {
  if (auto known = manifold_topology(vertex_count, triangles)) return std::move(*known);
  const BuiltMesh built = build_mesh(vertex_count, triangles);
  MeshTopology topology;
  topology.boundary_loops = boundary_loops(built);
  int used = 0;
  for (int v = 0; v < static_cast<int>(built.mesh.n_vertices()); ++v) used += !built.mesh.is_isolated(OpenMesh::VertexHandle(v));
  topology.euler_characteristic = used - static_cast<int>(built.mesh.n_edges()) + static_cast<int>(built.mesh.n_faces());
  return topology;
}

}  // namespace atlas_refine
