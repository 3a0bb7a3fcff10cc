// Figures and reasons.
#include "report/shortfall.h"

#include "atlas_refine/error.h"
#include "input/check_atlas.h"
#include "measure/distortion.h"
#include "pack/room_for_gap.h"
#include "reduce/kept_density.h"
#include "report/journal.h"
#include "report/locked.h"

namespace atlas_refine {
namespace {

/// Empty where there are none.
std::string words_on_limits(const RefineOptions& options) {
  const std::string distortion = options.max_distortion ? "a distortion of " + number_text("%g", *options.max_distortion) : "";
  const std::string stretch = options.max_stretch ? "a stretch of " + number_text("%g", *options.max_stretch) : "";
  return distortion + (distortion.empty() || stretch.empty() ? "" : " and ") + stretch;
}

/// How far charts may not grow.
std::string too_dense() { return "over " + number_text("%g", kMostDense) + " times the texel density of the others"; }

/// Where the gap leaves next to no room at the bound.
std::string words_on_gap(const std::vector<Chart>& charts, const RefineOptions& options) {
  constexpr double kNearlyAll = 0.9;
  if (!options.gap || charts.size() == 1) return "";
  const double aspect = options.box_aspect == 0 ? 1 : options.box_aspect;
  const Vec2 box = sides_of_area(uv_area(charts) / options.pe_bound, aspect);
  const double taken = RoomForGap(charts, *options.gap, aspect).taken(options.gap->length(box), box);
  if (taken < kNearlyAll) return "";
  return "; with the gap around them the charts would take " + number_text("%.0f", 100 * taken) +
         " % of the room: a smaller one leaves more";
}

}  // namespace

bool within_limits(const RefineOptions& options, const Measures& of) {
  constexpr double kStored = 1e-5;  // of stretch, that rounding of stored UVs adds to small triangles
  if (options.point) return true;   // of the trade-off: it is wanted whatever its distortion
  const bool kept = !options.max_distortion || of.distortion <= *options.max_distortion * (1 + 1e-9);
  return kept && (!options.max_stretch || of.stretch_99 <= *options.max_stretch * (1 + kStored));
}

std::string words_on_outgrown(int charts) {
  return "for more, " + std::to_string(charts) + (charts == 1 ? " chart" : " charts") + " would grow to " + too_dense();
}

std::string words_on_held(int charts) {
  const std::string who =
      charts == 1 ? "1 chart kept its shape: bent, it" : std::to_string(charts) + " charts kept their shapes: bent, they";
  return who + " would have grown to " + too_dense() + ", which are stretched instead";
}

std::string shortfall(const InputAtlas& input, const RefineOptions& options, const Measures& after,
                      const std::vector<Chart>& charts, int outgrown) {
  const std::string figures = "packing efficiency " + number_text("%.4f", after.pe_fixed_aspect) + " at E_d " +
                              number_text("%.4f", after.distortion) +
                              (options.max_stretch ? ", stretch " + number_text("%.4f", after.stretch_99) : "");
  const std::string limit = options.point ? "" : words_on_limits(options);
  if (!within_limits(options, after)) {
    const std::string growth = options.seams == Seams::Needed && options.max_boundary_growth
                                   ? " and a boundary growth of " + number_text("%g", *options.max_boundary_growth)
                                   : "";
    const bool may_try_harder = options.seams == Seams::Needed && options.effort != Effort::Best;
    return message_prefix(input.atlas) + "no atlas within " + limit + growth + " was found; the least distorted one has " +
           figures + (may_try_harder ? "; more effort may find one" : "");
  }
  if (after.pe_fixed_aspect >= options.pe_bound) return "";
  return message_prefix(input.atlas) + "the bound " + number_text("%g", options.pe_bound) + " was not reached" +
         (limit.empty() ? "" : " within " + limit) + "; the best found is " + figures +
         words_on_kept(input.set.charts, freedom_of(input.set, options), options.box_aspect) +
         (outgrown > 0 ? "; " + words_on_outgrown(outgrown) : "") + words_on_gap(charts, options);
}

}  // namespace atlas_refine
