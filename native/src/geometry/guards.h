// What energies of a chart are summed over: its own triangles and the guards of its polygons.
#pragma once

#include "geometry/chart.h"

namespace atlas_refine {

/// The part of its area that each of the chart's own triangles counts for: one half where guards share its face, else 1.
std::vector<double> triangle_shares(const Chart& chart);

/// Calls visit(triangle, shape, share, face) for the chart's own triangles and then for its guards.
template <class Visit>
void for_each_element(const Chart& chart, Visit&& visit) {
  const std::vector<double> shares = triangle_shares(chart);
  for (std::size_t t = 0; t < chart.triangles.size(); ++t)
    visit(chart.triangles[t], chart.surface[t], shares[t], chart.triangle_faces[t]);
  for (const Guard& guard : chart.guards) visit(guard.triangle, guard.shape, guard.share, guard.face);
}

/// Takes all guards of a face away where one of them is not positive, or so flat that it could not be reduced.
void drop_broken_guards(Chart& chart);

}  // namespace atlas_refine
