// Flags of faces to charts; triangles clipped to a box.
#include "geometry/freedom.h"

#include <algorithm>
#include <cmath>

#include "geometry/plane.h"

namespace atlas_refine {
namespace {

/// The part of a convex polygon where sign * p[axis] <= sign * limit.
std::vector<Vec2> clipped(const std::vector<Vec2>& polygon, int axis, double limit, double sign) {
  std::vector<Vec2> out;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double beyond_a = sign * (a[axis] - limit), beyond_b = sign * (b[axis] - limit);
    if (beyond_a <= 0) out.push_back(a);
    if ((beyond_a < 0 && beyond_b > 0) || (beyond_a > 0 && beyond_b < 0))
      out.push_back(a + beyond_a / (beyond_a - beyond_b) * (b - a));
  }
  return out;
}

}  // namespace

bool any_flagged(const Chart& chart, const std::vector<char>& flags) {
  return !flags.empty() &&
         std::any_of(chart.triangle_faces.begin(), chart.triangle_faces.end(), [&](int face) { return flags[face] != 0; });
}

Freedoms freedom_of(const std::vector<Chart>& charts, const std::vector<char>& keep_shape, const std::vector<char>& locked) {
  Freedoms out;
  out.reserve(charts.size());
  for (const Chart& chart : charts)
    out.push_back(any_flagged(chart, locked) ? Freedom::Fixed : any_flagged(chart, keep_shape) ? Freedom::Moves : Freedom::Bends);
  if (std::all_of(out.begin(), out.end(), [](Freedom freedom) { return freedom == Freedom::Bends; })) out.clear();
  return out;
}

bool any_fixed(const Freedoms& freedom) { return std::find(freedom.begin(), freedom.end(), Freedom::Fixed) != freedom.end(); }

bool all_fixed(const Freedoms& freedom) {
  return !freedom.empty() && std::all_of(freedom.begin(), freedom.end(), [](Freedom f) { return f == Freedom::Fixed; });
}

bool none_bends(const Freedoms& freedom) {
  return !freedom.empty() && std::find(freedom.begin(), freedom.end(), Freedom::Bends) == freedom.end();
}

double area_within(const Chart& chart, const Box& box) {
  double area = 0;
  for (const Triangle& t : chart.triangles) {
    std::vector<Vec2> polygon = {chart.uvs[t[0]], chart.uvs[t[1]], chart.uvs[t[2]]};
    for (int axis = 0; axis < 2; ++axis) {
      polygon = clipped(polygon, axis, box.min[axis], -1);
      polygon = clipped(polygon, axis, box.max[axis], 1);
    }
    area += 0.5 * std::abs(doubled_area(polygon));
  }
  return area;
}

}  // namespace atlas_refine
