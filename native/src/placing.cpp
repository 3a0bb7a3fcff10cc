// The packer asked with one gap after the other.
#include "placing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "atlas_refine/error.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "reduce/squeeze.h"
#include "report/locked.h"
#include "report/texture.h"

namespace atlas_refine {
namespace {

Box box_of(const PlacedCharts& placed, double aspect) {
  return placed.has_frame() ? Box{Vec2::Zero(), placed.frame} : box_of_aspect(uv_box(placed.charts), aspect);
}

/// The PE beyond which the box that the gap is a part of is larger than the charts'.
double most_pe(const Refinement& run) {
  return run.input.gap_of_texture ? run.options.pe_bound : std::numeric_limits<double>::infinity();
}

/// The box that charts need grows with their area and half the gap around them: PE at another gap, from that at one.
double likely_pe(const Refinement& run, const PlacedCharts& placed, const Freedoms& freedom, const Gap& gap, const Gap& other) {
  const std::vector<Chart> movable = movable_of(placed.charts, freedom);
  const Vec2 box = box_of(placed, run.options.box_aspect).size();
  const auto grown = [&](const Gap& g) { return uv_area(movable) + 0.5 * g.length(box) * uv_perimeter(movable); };
  return packing_efficiency(placed, run.options.box_aspect) * grown(gap) / grown(other);
}

/// The part of a box that charts take with half the gap around them.
double taken(const Refinement& run, const std::vector<Chart>& charts, const Gap& gap, double pe) {
  const double box = uv_area(charts) / pe;
  return pe * (1 + 0.5 * gap.length(sides_of_area(box, run.options.box_aspect)) * uv_perimeter(charts) / uv_area(charts));
}

PlaceOptions place_options(const Refinement& run, const Gap& gap, double good_enough, PackSearch search) {
  return {.gap = gap,
          .box_aspect = run.options.box_aspect,
          .target_pe = good_enough,
          .most_pe = most_pe(run),
          .seed = run.options.seed,
          .threads = run.threads,
          .search = search,
          .rotate = run.options.rotate,
          .align_axes = run.options.align_axes};
}

/// With the largest of the gaps with which rows hold the bound: that is told sooner than by any search.
std::optional<Placing> in_rows(const Refinement& run, const std::vector<Chart>& charts, const std::vector<Gap>& gaps) {
  std::optional<Placing> best;
  for (auto gap = gaps.rbegin(); gap != gaps.rend(); ++gap) {
    const PlaceOptions options = place_options(run, *gap, run.options.pe_bound, PackSearch::Thorough);
    auto placed = place_in_rows(charts, options, run.monitor);
    if (!placed) break;
    Placing placing{{.charts = std::move(*placed)}, *gap};
    if (!holds_bound(run, placing.placed, kStoredSpare)) break;
    best = std::move(placing);
  }
  return best;
}

/// More than the packer fills of a box with thousands of charts.
bool takes_too_much(const Refinement& run, const std::vector<Chart>& charts, const Freedoms& freedom, const Gap& gap) {
  constexpr double kMostTaken = 0.9;
  return !none_bends(freedom) && !any_fixed(freedom) && taken(run, charts, gap, run.options.pe_bound) > kMostTaken;
}

/// Whether a search may find room for a wider gap than rows have: where sizes are mixed it fills more than they do.
bool may_take_wider_gap(const Refinement& run, const std::vector<Chart>& charts, const std::vector<Gap>& gaps,
                        const Placing& rows) {
  constexpr double kMostFound = 0.88;  // of the box, in atlases of 1000 and 5000 charts
  return std::any_of(gaps.begin(), gaps.end(), [&](const Gap& gap) {
    return gap.value > rows.gap.value && taken(run, charts, gap, run.options.pe_bound) <= kMostFound;
  });
}

/// Without those gaps with which little is left at the bound of what the placement leaves free: thousands of charts would jam.
std::vector<Gap> without_jams(const Refinement& run, const Placing& placing, std::vector<Gap> gaps) {
  constexpr double kLeastLeft = 0.4;
  const std::vector<Chart>& charts = placing.placed.charts;
  const double pe = packing_efficiency(placing.placed, run.options.box_aspect), bound = run.options.pe_bound;
  const double free = kLeastLeft * (1 - taken(run, charts, placing.gap, pe));
  while (gaps.size() > 1 && 1 - taken(run, charts, gaps.front(), bound) < free) gaps.erase(gaps.begin());
  return gaps;
}

}  // namespace

std::vector<Chart> movable_of(const std::vector<Chart>& charts, const Freedoms& freedom) {
  std::vector<Chart> out;
  for (std::size_t c = 0; c < charts.size(); ++c) {
    if (!is_fixed(freedom, c)) out.push_back(charts[c]);
  }
  return out;
}

DistortionLimits limits_of(const RefineOptions& options) {
  return {.distortion = options.max_distortion.value_or(0), .stretch = options.max_stretch.value_or(0)};
}

double packing_efficiency(const PlacedCharts& placed, double aspect) {
  const Box box = box_of(placed, aspect);
  if (!placed.has_frame()) return uv_area(placed.charts) / box.area();
  double area = 0;
  for (const Chart& chart : placed.charts) area += area_within(chart, box);
  return area / box.area();
}

bool gap_kept(const Refinement& run, const PlacedCharts& placed, const Freedoms& freedom, const Gap& gap) {
  const double aspect = run.options.box_aspect, pe = packing_efficiency(placed, aspect);
  const double larger = std::sqrt(std::max(1.0, pe / most_pe(run)));
  return gap_between_charts(placed.charts, freedom) >= kStartGap * larger * gap.length(box_of(placed, aspect).size());
}

bool holds_bound(const Refinement& run, const PlacedCharts& placed, double spare) {
  const RefineOptions& options = run.options;
  return limits_of(options).used_by(placed.charts) <= 1 &&
         packing_efficiency(placed, options.box_aspect) >= spare * options.pe_bound;
}

bool goes_on(const Refinement& run, std::size_t charts) {
  return run.options.relax || (!run.options.rectangles.until_input && charts < kThousands);
}

bool rather_moves(const Refinement& run, std::size_t charts) { return charts >= kThousands && !run.options.relax; }

PlacedCharts place(const Refinement& run, const std::vector<Chart>& charts, const Freedoms& freedom, const Gap& gap,
                   double good_enough, PackSearch search) {
  const PlaceOptions options = place_options(run, gap, good_enough, search);
  if (!any_fixed(freedom)) return {.charts = place_charts(charts, options, run.monitor)};
  auto placed = place_around(charts, freedom, options, run.monitor);
  if (!placed)
    throw RefineError(
        ErrorCode::BoundNotReached, "pack",
        "the locked charts leave the others no room" + words_on_kept(run.input.set.charts, freedom, options.box_aspect));
  return std::move(*placed);
}

std::vector<Gap> gaps_of(const Refinement& run, const std::vector<Chart>& charts, const Freedoms& freedom, double most_taken) {
  const RefineOptions& options = run.options;
  if (options.gap) return {*options.gap};
  if (!any_fixed(freedom)) return automatic_gaps(charts, options.pe_bound, options.box_aspect, 0, most_taken);
  const Box texture{Vec2::Zero(), Vec2(options.box_aspect, 1)};
  double taken = 0;
  for (std::size_t c = 0; c < charts.size(); ++c) {
    if (is_fixed(freedom, c)) taken += area_within(charts[c], texture);
  }
  return automatic_gaps(movable_of(charts, freedom), options.pe_bound, options.box_aspect, taken / texture.area(), most_taken);
}

Placing place_with(const Refinement& run, const std::vector<Chart>& charts, const Freedoms& freedom, double good_enough,
                   const std::vector<Gap>& gaps) {
  constexpr std::size_t kLittleLess = 3;
  constexpr double kPromising = 0.99;  // of the bound
  const bool rather_move = rather_moves(run, charts.size());
  const std::size_t tries = none_bends(freedom) ? gaps.size() : rather_move ? std::min(gaps.size(), kLittleLess) : 1;
  // Charts that are to bend had better not stand in rows, which jam.
  const bool may_stand_in_rows = charts.size() > kManyCharts && !any_fixed(freedom) && !run.options.relax;
  std::optional<Placing> rows;
  if (may_stand_in_rows) rows = in_rows(run, charts, {gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(tries)});
  if (rows && !may_take_wider_gap(run, charts, gaps, *rows)) return std::move(*rows);
  std::size_t k = 0;
  while (rather_move && k + 1 < tries && takes_too_much(run, charts, freedom, gaps[k])) ++k;
  const Placing first{place(run, charts, freedom, gaps[k], good_enough), gaps[k]};
  if (holds_bound(run, first.placed, kStoredSpare)) return first;
  while (++k < tries && !(rows && gaps[k].value <= rows->gap.value) && !run.monitor.finishing()) {
    if (likely_pe(run, first.placed, freedom, first.gap, gaps[k]) < kPromising * run.options.pe_bound) continue;
    PlacedCharts closer = place(run, charts, freedom, gaps[k], run.options.pe_bound);
    if (holds_bound(run, closer, kStoredSpare)) return {std::move(closer), gaps[k]};
  }
  if (may_stand_in_rows && !rows) rows = in_rows(run, charts, {gaps_to_squeeze_with(run, charts, freedom, first, gaps).front()});
  return rows ? std::move(*rows) : first;
}

std::vector<Gap> gaps_to_squeeze_with(const Refinement& run, const std::vector<Chart>& pieces, const Freedoms& freedom,
                                      const Placing& placing, std::vector<Gap> gaps) {
  if (holds_bound(run, placing.placed, kStoredSpare)) {
    std::erase_if(gaps, [&](const Gap& gap) { return gap.value > placing.gap.value; });
    return gaps;
  }
  if (none_bends(freedom)) return gaps;
  gaps = gaps_of(run, pieces, freedom, kMostTakenBent);
  return rather_moves(run, pieces.size()) && !any_fixed(freedom) ? without_jams(run, placing, std::move(gaps)) : gaps;
}

}  // namespace atlas_refine
