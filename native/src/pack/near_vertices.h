// Vertices of placed charts that are near other charts.
#pragma once

#include <functional>
#include <vector>

#include "pack/scene.h"

namespace atlas_refine {

/// A vertex and the nearest point of another chart's edge.
struct NearVertex {
  int vertex, edge;  ///< entries of the scene's edges
  Vec2 foot;
  double distance;

  Vec2 normal(const Scene& scene) const { return (scene.edges[vertex].a - foot) / distance; }
};

/// Those up to `reach` apart, for each vertex the nearest edges in each direction, for each chart that it faces. Vertices of one
/// chart's stretch that is no longer than `stretch` are one: what they bar is nearly the same. With `few` directions may be much
/// alike, but there are no more than a few.
std::vector<NearVertex> near_vertices(const Scene& scene, const BoxTree& tree, double reach, double stretch, bool few,
                                      const std::function<void()>& poll);

}  // namespace atlas_refine
