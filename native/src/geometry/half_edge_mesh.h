// Connectivity of a chart's triangles. OpenMesh lives behind this header and nowhere else.
#pragma once

#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

struct MeshTopology {
  std::vector<std::vector<int>> boundary_loops;  ///< vertex loops, the triangles on the left; ordered by their first half-edge
  int euler_characteristic = 0;                  ///< vertices in use - edges + triangles; 1 for a disk
};

/// Triangles must be consistently oriented where they share an edge; one that cannot be joined to the rest (non-manifold) is kept
/// as a piece of its own, one with a repeated vertex is left out.
MeshTopology mesh_topology(int vertex_count, const std::vector<Triangle>& triangles);

}  // namespace atlas_refine
