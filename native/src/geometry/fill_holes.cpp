// Loop by loop.
#include "geometry/fill_holes.h"

#include <optional>

#include "geometry/plane.h"
#include "geometry/triangulate_region.h"

namespace atlas_refine {
namespace {

/// The chart lies on the left of its loops, a hole on the right.
std::optional<std::vector<Triangle>> triangles_in(const Chart& chart, const std::vector<int>& loop) {
  const std::vector<int> around(loop.rbegin(), loop.rend());
  Region region{.points = {}, .loops = {{}}, .chords = {}, .near = {}};
  for (int k = 0; k < static_cast<int>(around.size()); ++k) {
    region.points.push_back(chart.uvs[around[k]]);
    region.loops.front().push_back(k);
    region.near.push_back(k - 1);
  }
  if (!(doubled_area(region.points) > 0)) return std::nullopt;
  auto triangles = triangulate_region(region);
  if (!triangles) return std::nullopt;
  for (Triangle& t : *triangles) {
    for (int& v : t) v = around[v];
  }
  return triangles;
}

}  // namespace

Filling fill_by_fans(const Chart& chart, std::size_t outer) {
  Filling out;
  for (std::size_t l = 0; l < chart.boundary_loops.size(); ++l) {
    if (l != outer) out.fans.push_back(l);
  }
  return out;
}

Filling fill_as_in_uvs(const Chart& chart, std::size_t outer) {
  Filling out;
  for (const std::size_t l : fill_by_fans(chart, outer).fans) {
    if (const auto triangles = triangles_in(chart, chart.boundary_loops[l]))
      out.triangles.insert(out.triangles.end(), triangles->begin(), triangles->end());
    else
      out.fans.push_back(l);
  }
  return out;
}

}  // namespace atlas_refine
