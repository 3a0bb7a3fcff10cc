// Distances and overlaps of placed outlines.
#include "pack/scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/boundary.h"
#include "geometry/predicates.h"

namespace atlas_refine {
namespace {

/// The point lies inside the chart: its outline winds about it.
bool inside(const Scene& scene, int chart, const Vec2& p) {
  int winding = 0;
  for (int k = scene.first_edges[chart]; k < scene.first_edges[chart + 1]; ++k) {
    const PlacedEdge& edge = scene.edges[k];
    if ((edge.a.y() > p.y()) == (edge.b.y() > p.y())) continue;
    if (orientation(edge.a, edge.b, p) == (edge.b.y() > edge.a.y() ? 1 : -1)) winding += edge.b.y() > edge.a.y() ? 1 : -1;
  }
  return winding != 0;
}

bool any_chart_inside_another(const Scene& scene) {
  std::vector<int> charts(scene.boxes.size());
  std::iota(charts.begin(), charts.end(), 0);
  const BoxTree tree(scene.boxes, charts);
  const double touching = 0;
  bool found = false;
  for (const int chart : charts) {
    const Vec2& corner = scene.edges[scene.first_edges[chart]].a;
    tree.visit_within({corner, corner}, touching, chart, [&](int other) {
      found = inside(scene, other, corner);
      return !found;
    });
    if (found) return true;
  }
  return false;
}

}  // namespace

Scene make_scene(const std::vector<Outline>& outlines, const std::vector<Placement>& placements) {
  Scene scene;
  const auto empty = Box{Vec2::Constant(INFINITY), Vec2::Constant(-INFINITY)};
  scene.box = empty;
  for (size_t c = 0; c < outlines.size(); ++c) {
    const size_t first = scene.edges.size();
    scene.first_edges.push_back(static_cast<int>(first));
    Box box = empty;
    for (const auto& loop : outlines[c].loops) {
      for (size_t k = 0; k < loop.size(); ++k) {
        const Vec2 a = placements[c].apply(loop[k]), b = placements[c].apply(loop[(k + 1) % loop.size()]);
        scene.edges.push_back({static_cast<int>(c), a, b});
        box = united(box, {a, a});
      }
    }
    scene.turnable.push_back(outlines[c].rotate == Rotate::Any);
    scene.boxes.push_back(box);
    scene.centres.push_back(0.5 * (box.min + box.max));
    double radius = 0;
    for (size_t k = first; k < scene.edges.size(); ++k) radius = std::max(radius, (scene.edges[k].a - scene.centres[c]).norm());
    scene.radii.push_back(std::max(radius, 1e-300));
    scene.box = united(scene.box, box);
  }
  scene.first_edges.push_back(static_cast<int>(scene.edges.size()));
  return scene;
}

BoxTree edge_tree(const Scene& scene) {
  std::vector<Box> boxes;
  std::vector<int> labels;
  for (const PlacedEdge& edge : scene.edges) {
    boxes.push_back({edge.a.cwiseMin(edge.b), edge.a.cwiseMax(edge.b)});
    labels.push_back(edge.chart);
  }
  return {std::move(boxes), std::move(labels)};
}

Vec2 nearest_point(const Vec2& p, const PlacedEdge& edge) {
  return edge.a + closest_on_segment(p, edge.a, edge.b).along * (edge.b - edge.a);
}

double smallest_gap(const Scene& scene, const BoxTree& tree) {
  double nearest = scene.box.diagonal();
  for (const PlacedEdge& edge : scene.edges) {
    tree.visit_within({edge.a, edge.a}, nearest, edge.chart, [&](int other) {
      nearest = std::min(nearest, (edge.a - nearest_point(edge.a, scene.edges[other])).norm());
      return true;
    });
  }
  const double touching = 0;
  for (const PlacedEdge& edge : scene.edges) {
    const Box span{edge.a.cwiseMin(edge.b), edge.a.cwiseMax(edge.b)};
    tree.visit_within(span, touching, edge.chart, [&](int other) {
      if (segments_touch(edge.a, edge.b, scene.edges[other].a, scene.edges[other].b)) nearest = 0;
      return nearest > 0;
    });
    if (nearest == 0) return 0;
  }
  return any_chart_inside_another(scene) ? 0 : nearest;
}

}  // namespace atlas_refine
