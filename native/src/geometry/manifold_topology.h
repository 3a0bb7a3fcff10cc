// Topology of triangles that are a manifold as they are, which nearly all charts are: in linear time, without a mesh.
#pragma once

#include <optional>
#include <vector>

#include "geometry/half_edge_mesh.h"

namespace atlas_refine {

/// What mesh_topology() says; nothing where an edge has more than two triangles or two that are oriented apart, where fans meet
/// in one vertex, or where a triangle repeats a vertex.
std::optional<MeshTopology> manifold_topology(int vertex_count, const std::vector<Triangle>& triangles);

}  // namespace atlas_refine
