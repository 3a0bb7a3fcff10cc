// Placed charts by the edges of their outlines.
#pragma once

#include <vector>

#include "geometry/box_tree.h"
#include "pack/pack_charts.h"

namespace atlas_refine {

struct PlacedEdge {
  int chart;
  Vec2 a, b;
};

/// The charts where they lie now.
struct Scene {
  std::vector<char> turnable;     ///< charts that may get any rotation
  std::vector<int> first_edges;   ///< of each chart in edges, and their end
  std::vector<PlacedEdge> edges;  ///< all charts' boundary edges; `a` runs through all vertices
  std::vector<Vec2> centres;      ///< of each chart's bounding box
  std::vector<double> radii;      ///< of each chart about its centre
  std::vector<Box> boxes;
  Box box;
};

Scene make_scene(const std::vector<Outline>& outlines, const std::vector<Placement>& placements);

/// Over all edges, labelled by their charts.
BoxTree edge_tree(const Scene& scene);

Vec2 nearest_point(const Vec2& p, const PlacedEdge& edge);

/// Smallest distance between the boundaries of two charts; 0 where charts overlap.
double smallest_gap(const Scene& scene, const BoxTree& tree);

}  // namespace atlas_refine
