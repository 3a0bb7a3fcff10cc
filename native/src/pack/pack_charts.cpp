// The packer: a chart alone gets its best turn; several are placed on a grid,
// then compacted exactly.
#include "pack/pack_charts.h"

#include <cmath>

#include "measure/distortion.h"
#include "pack/canonical_outlines.h"
#include "pack/compaction.h"
#include "pack/grid_search.h"
#include "pack/rows.h"
#include "pack/turns.h"

namespace atlas_refine {

namespace {

// Beyond the gap, so that rounding it does not matter.
constexpr double kRounding = 1e-6;

/// In units of the canonical outlines.
double gap_between(const CanonicalOutlines& canonical, const PackOptions& options) {
  return static_cast<float>((1 + kRounding) * options.gap / canonical.unit) + 2 * canonical.off_grid;
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

double sum_of(const std::vector<double>& areas) {
  double out = 0;
  for (const double area : areas) out += area;
  return out;
}

Packing packing_of(const std::vector<Outline>& outlines, std::vector<Placement> placements, double area, double aspect) {
  Packing out{.placements = std::move(placements), .box = {}};
  const Box box = placed_box(outlines, out.placements);
  for (Placement& placement : out.placements) placement.offset -= box.min;
  out.box = box_of_aspect({Vec2::Zero(), box.size()}, aspect);
  out.pe = out.box.area() > 0 ? area / out.box.area() : 0;
  return out;
}

Packing packing_of(const std::vector<Outline>& outlines, const CanonicalOutlines& canonical, std::vector<Placement> placements,
                   double area, double aspect) {
  Packing out = packing_of(outlines, canonical.of_input(placements), area, aspect);
  out.canonical = std::move(placements);
  return out;
}

}  // namespace

Packing pack_charts(const std::vector<Outline>& outlines, const std::vector<double>& areas, const PackOptions& options) {
  if (outlines.empty()) return {};
  const double area = sum_of(areas);
  if (outlines.size() == 1)
    return packing_of(outlines, {place_one(outlines[0], area, options.box_aspect)}, area, options.box_aspect);
  const CanonicalOutlines canonical = canonical_outlines(outlines, std::sqrt(area));
  PackOptions unit = options;
  unit.gap = gap_between(canonical, options);
  return packing_of(outlines, canonical, search_on_grid(canonical.outlines, 1, unit), area, options.box_aspect);
}

std::optional<Packing> pack_charts_in_rows(const std::vector<Outline>& outlines, const std::vector<double>& areas,
                                           const PackOptions& options) {
  const double area = sum_of(areas);
  const CanonicalOutlines canonical = canonical_outlines(outlines, std::sqrt(area));
  Watch watch(options.tick);
  std::vector<Placement> placements =
      pack_in_rows(canonical.outlines, {gap_between(canonical, options), options.box_aspect, 1 / options.target_pe}, watch);
  if (placements.empty()) return std::nullopt;
  return packing_of(outlines, canonical, std::move(placements), area, options.box_aspect);
}

std::optional<Packing> with_larger_gap(const std::vector<Outline>& outlines, const std::vector<double>& areas,
                                       const Packing& packing, double before, const PackOptions& options) {
  constexpr double kFirstStep = 0.01;  // sides of a square that holds the charts
  constexpr std::size_t kFew = 32;     // charts: another search takes as little, and may find a better layout
  if (outlines.size() <= kFew || outlines.size() > kManyCharts) return std::nullopt;
  const double area = sum_of(areas);
  const CanonicalOutlines canonical = canonical_outlines(outlines, std::sqrt(area));
  // Those outermost move by what all in a row move apart.
  const double wider = std::sqrt(outlines.size()) * (options.gap - before) / canonical.unit;
  const CompactionOptions compaction{gap_between(canonical, options), options.box_aspect, std::max(kFirstStep, wider), [&] {
                                       if (options.tick) options.tick(1);
                                     }};
  std::vector<Placement> placements = compact(canonical.outlines, packing.canonical, compaction);
  if (placements.empty()) return std::nullopt;
  return packing_of(outlines, canonical, std::move(placements), area, options.box_aspect);
}

}  // namespace atlas_refine
