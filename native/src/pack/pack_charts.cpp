// The packer: a chart alone gets its best turn; several are placed on a grid,
// then compacted exactly.
#include "pack/pack_charts.h"

#include <cmath>

#include "measure/distortion.h"
#include "pack/canonical_outlines.h"
#include "pack/compaction.h"
#include "pack/grid_search.h"
#include "pack/turns.h"

namespace atlas_refine {

namespace {

// Beyond the gap, so that rounding it does not matter.
constexpr double kRounding = 1e-6;

std::vector<Placement> place_many(const std::vector<Outline>& outlines, double area, const PackOptions& options) {
  const CanonicalOutlines canonical = canonical_outlines(outlines, std::sqrt(area));
  PackOptions unit = options;
  unit.gap = static_cast<float>((1 + kRounding) * options.gap / canonical.unit);
  unit.gap += 2 * canonical.off_grid;
  return canonical.of_input(search_on_grid(canonical.outlines, 1, unit));
}

/// Of turns that are equally good the one that the outline's own shape tells; a chart that is turned by quarters only stays
/// upright then.
Placement place_one(const Outline& outline, double area, double box_aspect) {
  if (outline.rotate != Rotate::Any) {
    const Turn turn = best_turn(outline, box_aspect);
    return {turn.cosine, turn.sine, Vec2::Zero()};
  }
  const Placement first = canonical_outlines({outline}, std::sqrt(area)).motions[0];
  const Turn own{first.cosine, first.sine};
  std::vector<Vec2> hull = convex_hull(outline);
  for (Vec2& p : hull) p = own.apply(p);
  const Turn turn = (box_aspect > 0 ? best_turn(hull, box_aspect) : Turn{}).after(own);
  return {turn.cosine, turn.sine, Vec2::Zero()};
}

}  // namespace

Packing pack_charts(const std::vector<Outline>& outlines, const std::vector<double>& areas, const PackOptions& options) {
  Packing packing;
  if (outlines.empty()) return packing;
  double area = 0;
  for (const double chart_area : areas) area += chart_area;
  if (outlines.size() == 1) {
    packing.placements.push_back(place_one(outlines[0], area, options.box_aspect));
  } else {
    packing.placements = place_many(outlines, area, options);
  }
  const Box box = placed_box(outlines, packing.placements);
  for (Placement& placement : packing.placements) placement.offset -= box.min;
  packing.box = box_of_aspect({Vec2::Zero(), box.size()}, options.box_aspect);
  packing.pe = packing.box.area() > 0 ? area / packing.box.area() : 0;
  return packing;
}

}  // namespace atlas_refine
