// The packer: greedy placements in strips of many widths, then a guided local search that shrinks the box of the best.
#include "pack/pack_charts.h"

#include <algorithm>
#include <cmath>

#include "pack/grid_search.h"

namespace atlas_refine {
namespace {

double boundary_length(const Outline& outline) {
  double length = 0;
  for (const auto& loop : outline.loops) {
    for (size_t k = 0; k < loop.size(); ++k) length += (loop[k] - loop[(k + 1) % loop.size()]).norm();
  }
  return length;
}

/// Moves everything to the origin and fits the box of the asked aspect around it.
void finish(const std::vector<Outline>& outlines, double area, double aspect, Packing& packing) {
  Vec2 low = Vec2::Constant(INFINITY), high = Vec2::Constant(-INFINITY);
  for (size_t i = 0; i < outlines.size(); ++i) {
    for (const auto& loop : outlines[i].loops) {
      for (const Vec2& p : loop) {
        low = low.cwiseMin(packing.placements[i].apply(p));
        high = high.cwiseMax(packing.placements[i].apply(p));
      }
    }
  }
  for (Placement& placement : packing.placements) placement.offset -= low;
  packing.box = {Vec2::Zero(), high - low};
  if (aspect > 0) {
    const double width = std::max(packing.box.max.x(), aspect * packing.box.max.y());
    packing.box.max = {width, width / aspect};
  }
  packing.pe = packing.box.area() > 0 ? area / packing.box.area() : 0;
}

}  // namespace

Packing pack_charts(const std::vector<Outline>& outlines, const std::vector<double>& areas, const PackOptions& options) {
  Packing packing;
  if (outlines.empty()) return packing;
  double area = 0, dilated_area = 0;
  for (size_t i = 0; i < outlines.size(); ++i) {
    area += areas[i];
    dilated_area += areas[i] + 0.5 * options.gap * boundary_length(outlines[i]);
  }
  if (outlines.size() == 1) {
    const Turn turn = best_turn(convex_hull(outlines[0]), options.box_aspect);
    packing.placements.push_back({turn.cosine, turn.sine, Vec2::Zero()});
  } else {
    packing.placements = search_on_grid(outlines, area, dilated_area, options);
  }
  finish(outlines, area, options.box_aspect, packing);
  return packing;
}

}  // namespace atlas_refine
