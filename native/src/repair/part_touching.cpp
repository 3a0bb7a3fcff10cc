// Touching vertices are drawn towards the middle of their triangles.
#include "repair/part_touching.h"

#include <algorithm>

#include "geometry/guards.h"
#include "geometry/near_pairs.h"
#include "measure/certificate.h"
#include "measure/distortion.h"

namespace atlas_refine {
namespace {

constexpr double kTouching = 1e-7;  // of the chart's size: borders so near each other are apart by rounding only

/// Boundary vertices within `tolerance` of a boundary edge they do not belong to, and the nearer ends of those edges.
std::vector<char> touching_vertices(const Chart& chart, double tolerance) {
  const Boundary boundary = make_boundary({chart}, {0});
  std::vector<char> touching(chart.vertex_count(), 0);
  for (const PointEdge& pair : near_pairs(boundary, chart.uvs, {}, tolerance)) {
    const int point = boundary.vertex[pair.point];
    const int start = boundary.vertex[pair.edge], end = boundary.vertex[boundary.next[pair.edge]];
    const Closest closest = closest_on_segment(chart.uvs[point], chart.uvs[start], chart.uvs[end]);
    if (closest.distance > tolerance) continue;
    touching[point] = 1;
    touching[closest.along < 0.5 ? start : end] = 1;
  }
  return touching;
}

}  // namespace

bool touches_itself(const Chart& chart) {
  const std::vector<char> touching = touching_vertices(chart, kTouching * uv_box({chart}).diagonal());
  return std::find(touching.begin(), touching.end(), 1) != touching.end();
}

std::optional<Chart> part_touching(const Chart& chart) {
  std::vector<Vec2> inward(chart.vertex_count(), Vec2::Zero());
  std::vector<int> count(chart.vertex_count(), 0);
  for (const Triangle& t : chart.triangles) {
    const Vec2 centre = (chart.uvs[t[0]] + chart.uvs[t[1]] + chart.uvs[t[2]]) / 3;
    for (int v : t) {
      inward[v] += centre - chart.uvs[v];
      ++count[v];
    }
  }
  const double size = uv_box({chart}).diagonal();
  std::optional<Chart> valid;
  for (const double tolerance : {kTouching, 1e-6, 1e-5, 1e-4}) {
    const std::vector<char> touching = touching_vertices(chart, tolerance * size);
    for (const double share : {0.1, 0.02}) {
      Chart parted = chart;
      for (int v = 0; v < chart.vertex_count(); ++v) {
        if (touching[v]) parted.uvs[v] += share / count[v] * inward[v];
      }
      if (!certify_charts({parted}).valid()) continue;
      drop_broken_guards(parted);
      if (!touches_itself(parted)) return parted;
      if (!valid) valid = parted;
    }
  }
  return valid;
}

}  // namespace atlas_refine
