// For the packer's tests: outlines from the test shapes, and the distance of placed charts by comparing everything with
// everything.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/predicates.h"
#include "pack/pack_charts.h"
#include "shapes.h"

namespace atlas_refine::testing {

inline Outline outline_of(const shapes::Polygon& polygon) {
  Outline outline{{polygon.outer}};
  outline.loops.insert(outline.loops.end(), polygon.holes.begin(), polygon.holes.end());
  return outline;
}

inline Outline placed(const Outline& outline, const Placement& placement) {
  Outline result = outline;
  for (auto& loop : result.loops) {
    for (Vec2& p : loop) p = placement.apply(p);
  }
  return result;
}

/// Calls visit(a, b) for every boundary edge.
template <class Visit>
void for_edges(const Outline& outline, const Visit& visit) {
  for (const auto& loop : outline.loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) visit(loop[k], loop[(k + 1) % loop.size()]);
  }
}

inline double distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

inline bool contains(const Outline& outline, const Vec2& p) {
  bool odd = false;
  for_edges(outline, [&](const Vec2& a, const Vec2& b) {
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) odd = !odd;
  });
  return odd;
}

/// Distance of two charts as regions: 0 where they overlap or one lies in the other's inside.
inline double distance(const Outline& one, const Outline& two) {
  double nearest = INFINITY;
  for_edges(one, [&](const Vec2& a, const Vec2& b) {
    for_edges(two, [&](const Vec2& c, const Vec2& d) {
      if (segments_touch(a, b, c, d)) nearest = 0;
      nearest = std::min({nearest, distance(a, c, d), distance(b, c, d), distance(c, a, b), distance(d, a, b)});
    });
  });
  if (contains(one, two.loops[0][0]) || contains(two, one.loops[0][0])) return 0;
  return nearest;
}

inline double smallest_distance(const std::vector<Outline>& outlines, const std::vector<Placement>& placements) {
  double nearest = INFINITY;
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      nearest = std::min(nearest, distance(placed(outlines[i], placements[i]), placed(outlines[k], placements[k])));
    }
  }
  return nearest;
}

/// Charts to be packed, with their areas.
struct Charts {
  std::vector<Outline> outlines;
  std::vector<double> areas;
  double area = 0;

  void add(const shapes::Polygon& polygon) {
    outlines.push_back(outline_of(polygon));
    areas.push_back(shapes::area(polygon));
    area += areas.back();
  }
};

}  // namespace atlas_refine::testing
