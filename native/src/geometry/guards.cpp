// Guards of polygons: their share, and which of them hold.
#include "geometry/guards.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/plane.h"
#include "geometry/predicates.h"

namespace atlas_refine {
namespace {

/// UV area / area of the shape, as a fraction of the chart's own, below which a guard is as good as broken.
constexpr double kFlat = 1e-3;

double density(const Chart& chart) {
  double doubled = 0;
  for (const Triangle& t : chart.triangles) doubled += std::abs(doubled_area(chart.uvs[t[0]], chart.uvs[t[1]], chart.uvs[t[2]]));
  return 0.5 * doubled / chart.surface.area();
}

}  // namespace

std::vector<double> triangle_shares(const Chart& chart) {
  std::vector<double> shares(chart.triangles.size(), 1);
  if (chart.guards.empty()) return shares;
  for (std::size_t t = 0; t < shares.size(); ++t) {
    const int face = chart.triangle_faces[t];
    const auto guard = std::lower_bound(chart.guards.begin(), chart.guards.end(), face,
                                        [](const Guard& g, int wanted) { return g.face < wanted; });
    if (guard != chart.guards.end() && guard->face == face && guard->share > 0) shares[t] = 0.5;
  }
  return shares;
}

void drop_broken_guards(Chart& chart) {
  if (chart.guards.empty()) return;
  const double least = kFlat * density(chart);
  std::set<int> broken;
  for (const Guard& guard : chart.guards) {
    const Vec2 &a = chart.uvs[guard.triangle[0]], &b = chart.uvs[guard.triangle[1]], &c = chart.uvs[guard.triangle[2]];
    if (orientation(a, b, c) <= 0 || 0.5 * doubled_area(a, b, c) < least * guard.shape.area) broken.insert(guard.face);
  }
  std::erase_if(chart.guards, [&](const Guard& guard) { return broken.contains(guard.face); });
}

}  // namespace atlas_refine
