// Place, squeeze.
#include "place_and_squeeze.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "atlas_refine/error.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "pack/room_for_gap.h"
#include "placing.h"
#include "reduce/goal.h"
#include "reduce/relax_apart.h"
#include "reduce/specks.h"
#include "reduce/squeeze.h"
#include "report/locked.h"
#include "report/note_repairs.h"
#include "report/stored.h"
#include "report/texture.h"

namespace atlas_refine {
namespace {

constexpr double kRoughly = 0.75;  // of the bound: a packing good enough to compare with
constexpr double kNearly = 0.95;   // of the bound: good enough for parts that go on to their optimum, E_d ends the same

/// The artist's layout, which is valid, at the size that the charts have in `charts`; nothing where it is no start.
std::optional<PlacedCharts> own_layout(const Refinement& run, const std::vector<Chart>& charts, const Freedoms& freedom,
                                       const Gap& gap) {
  const double aspect = run.options.box_aspect;
  PlacedCharts own{.charts = charts};
  if (any_fixed(freedom)) {
    own.charts = run.input.set.charts;
    if (!lies_in_texture(own.charts, freedom, aspect)) return std::nullopt;
    const double scale = std::sqrt(uv_area(movable_of(charts, freedom)) / uv_area(movable_of(own.charts, freedom)));
    own.frame = scale * Vec2(aspect, 1);
    for (Chart& chart : own.charts) {
      for (Vec2& uv : chart.uvs) uv *= scale;
    }
  }
  if (!gap_kept(run, own, freedom, gap)) return std::nullopt;
  return own;
}

/// The packer's layout and, where it is a valid start, the artist's: of a large atlas only the tighter one is tried.
std::vector<PlacedCharts> starts_of(const Refinement& run, std::optional<PlacedCharts> own, PlacedCharts placed) {
  constexpr std::size_t kLarge = 30000;
  std::vector<PlacedCharts> out;
  out.push_back(std::move(placed));
  if (!own) return out;
  std::size_t triangles = 0;
  for (const Chart& chart : own->charts) triangles += chart.triangles.size();
  const double aspect = run.options.box_aspect;
  if (triangles <= kLarge)
    out.push_back(std::move(*own));
  else if (packing_efficiency(*own, aspect) > packing_efficiency(out.front(), aspect))
    out.front() = std::move(*own);
  return out;
}

void warn_of_gap(const Refinement& run, const Gap& gap, const std::string& why) {
  if (run.options.gap || gap.value >= Gap{}.value) return;
  run.journal.warnings.push_back("the gap was reduced from " + number_text("%g", Gap{}.value) + " to " +
                                 number_text("%g", gap.value) + " of the box diagonal: " + why);
}

SqueezeOptions squeeze_options(const Refinement& run, const CutAtlas& atlas, const Freedoms& freedom,
                               const std::vector<Gap>& gaps, const DistortionLimits& limits = {}) {
  return {.pe_bound = run.options.pe_bound,
          .box_aspect = run.options.box_aspect,
          .gaps = gaps,
          .limits = limits,
          .wanted_areas = kept_areas(run.input.set.charts, atlas, run.options, freedom),
          .threads = run.threads,
          .freedom = with_specks_held(atlas, freedom, gaps.front(), run.options.pe_bound, run.options.box_aspect),
          .stored = run.options.stored};
}

Squeezed squeeze_from(const Refinement& run, const CutAtlas& atlas, const std::vector<PlacedCharts>& starts,
                      const Freedoms& freedom, const std::vector<Gap>& gaps, const DistortionLimits& limits) {
  const SqueezeOptions options = squeeze_options(run, atlas, freedom, gaps, limits);
  Squeezed squeezed = squeeze(starts, goal_of(run.input.set.charts, atlas, run.options), options, run.monitor);
  run.journal.iterations += squeezed.iterations;
  return squeezed;
}

void squeeze_into(const Refinement& run, const std::vector<PlacedCharts>& starts, const Freedoms& freedom,
                  const std::vector<Gap>& gaps, Solution& out) {
  const Squeezed best = squeeze_from(run, out.atlas, starts, freedom, gaps, limits_of(run.options));
  if (!none_bends(freedom)) out.intervention = Intervention::Squeezed;
  out.atlas = with_uvs(std::move(out.atlas), best.outcome.uvs);
  out.atlas.frame = best.outcome.frame;
  out.gap = best.gap;
  out.ended = ended_of(best.outcome.status);
  out.price = best.outcome.price;
  out.rough_energy = best.rough_energy;
  if (best.held == 0) out.end = best.outcome.end;  // else charts would grow from there
  out.held = best.held;
  out.outgrown = static_cast<int>(best.outcome.outgrown.size());
  warn_of_gap(run, best.gap, best.gap_note);
}

/// What is reduced is E_d on the surface.
bool reduces_distortion(const RefineOptions& options) {
  return options.density == Density::Equal && options.reference == Reference::Surface && options.importance.empty();
}

/// So much more distortion than `most` on the coarse charts, that the fine ones need not be asked; false where there are none.
bool is_far_above(const Refinement& run, const CutAtlas& atlas, const PlacedCharts& start, const Freedoms& freedom,
                  const std::vector<Gap>& gaps, double most) {
  constexpr double kFar = 3e-3;  // what a forecast may be wrong by, and more
  if (!reduces_distortion(run.options)) return false;
  const Objective objective = goal_of(run.input.set.charts, atlas, run.options);
  const auto forecast = squeeze_coarse_charts({start}, objective, squeeze_options(run, atlas, freedom, gaps), run.monitor);
  return forecast && forecast->outcome.holds() && forecast->outcome.energy > most + kFar;
}

/// What the squeeze needs to go on where `laid` lies, which was cut out of what `from` ended with.
struct InPlace {
  PlacedCharts start;
  Objective objective;
  WarmStart warm;
  SqueezeOptions options;
};

InPlace in_place(const Refinement& run, const CutAtlas& laid, const Solution& from) {
  InPlace out{.start = {.charts = meshes_of(laid), .frame = laid.frame},
              .objective = goal_of(run.input.set.charts, laid, run.options),
              .warm = from.end,
              .options = squeeze_options(run, laid, freedom_of_pieces(freedom_of(run.input.set, run.options), laid), {from.gap})};
  out.warm.near_borders.clear();  // of other vertices
  return out;
}

Solution cut_solution(const CutAtlas& atlas, const ReduceResult& result, const Gap& gap) {
  Solution out{.intervention = Intervention::Cut,
               .atlas = with_uvs(atlas, result.uvs),
               .gap = gap,
               .ended = ended_of(result.status),
               .price = result.price,
               .end = result.end};
  out.atlas.frame = result.frame;
  return out;
}

/// Borders that touch at a vertex (a pinch) may stay so where charts are but moved; no barrier can start from contact. Parts them
/// in `charts`, and gives back the charts as they were, by their place there.
std::map<std::size_t, Chart> part_pinches(const Refinement& run, const Freedoms& freedom, std::vector<Chart>& charts) {
  std::map<std::size_t, Chart> whole;
  for (std::size_t c = 0; c < charts.size(); ++c) {
    if (!bends(freedom, c) || certify_charts({charts[c]}).valid()) continue;
    whole.emplace(c, std::exchange(charts[c], made_valid(run, charts[c])));
  }
  return whole;
}

/// Puts pinched charts back, as they were, where they lie parted, if they are valid and the gap apart there too; in a frame they
/// may be out of it.
bool stay_whole(const Refinement& run, const std::map<std::size_t, Chart>& pinched, const std::vector<std::vector<int>>& points,
                const Freedoms& freedom, std::vector<Chart>& charts, Placing& placing) {
  if (placing.placed.has_frame()) return false;
  PlacedCharts whole = placing.placed;
  for (const auto& [c, chart] : pinched) {
    whole.charts[c] = chart;
    whole.charts[c].uvs = moved_likewise(chart.uvs, charts[c].uvs, placing.placed.charts[c].uvs);
  }
  const bool holds = holds_bound(run, whole, kStoredSpare) && gap_kept(run, whole, freedom, placing.gap);
  if (!holds || !certify_charts(whole.charts, points, freedom).valid()) return false;
  for (const auto& [c, chart] : pinched) charts[c] = chart;
  placing.placed = std::move(whole);
  return true;
}

/// Slits that would close where they are stored are parted: nothing bends these charts any more.
bool part_slits(const Refinement& run, const PlacedCharts& placed, const std::vector<std::vector<int>>& points,
                const Freedoms& freedom, std::vector<Chart>& charts) {
  const auto stored = stored_uvs(placed.charts, placed.frame, run.input.origin, run.options);
  bool parted = false;
  for (std::size_t c = 0; c < charts.size(); ++c) {
    if (is_fixed(freedom, c)) continue;
    const auto broken = broken_as_stored(placed.charts[c], points[c], stored[c], run.options.box_aspect);
    if (!broken) continue;
    charts[c] = made_valid(run, *broken);
    parted = true;
  }
  return parted;
}

void require_no_needles(const std::vector<Chart>& pieces) {
  UnmendedCharts needles;
  for (const Needle& needle : needles_among(pieces)) needles.charts.push_back({pieces[needle.chart].number, needle.words});
  if (!needles.charts.empty()) throw needles;
}

/// Refuses at once what bending cannot bring: charts of about their areas have no room for the gap at the bound.
void require_room_for_gap(const Refinement& run, const std::vector<Chart>& pieces, const Freedoms& freedom) {
  constexpr double kAreasChange = 1.05;  // as charts bend
  const RefineOptions& options = run.options;
  if (!options.gap || options.box_aspect == 0 || options.best_effort || any_fixed(freedom) || pieces.size() == 1) return;
  const double most = RoomForGap(pieces, *options.gap, options.box_aspect).most_pe();
  if (options.pe_bound <= kAreasChange * most) return;
  const double of_asked = run.asked.pe_bound / options.pe_bound;  // of the whole texture
  throw RefineError(ErrorCode::BoundNotReached, "pack",
                    "the gap leaves no room for " + std::to_string(pieces.size()) + " charts at the bound " +
                        number_text("%g", run.asked.pe_bound) + ": with it they cover less than " +
                        number_text("%.2f", of_asked * most));
}

}  // namespace

Solution place_and_squeeze(const Refinement& run, const CutAtlas& atlas, bool keeps_place, const ProgressRange& range) {
  const RefineOptions& options = run.options;
  const Freedoms freedom = freedom_of_pieces(freedom_of(run.input.set, run.options), atlas);
  const auto points = points_in_space(atlas, run.input.set.points);
  std::vector<Chart> pieces = meshes_of(atlas);
  run.journal.begin_stage("pack", range.part(0, 0.25));
  require_no_needles(pieces);
  require_room_for_gap(run, pieces, freedom);
  std::vector<Gap> gaps = gaps_of(run, pieces, freedom);
  const double good_enough = options.relax && !atlas.seams.empty() ? kNearly * options.pe_bound : options.pe_bound;
  const Journal::Mark before = run.journal.mark();
  const auto pinched = part_pinches(run, freedom, pieces);
  Placing placing = place_with(run, pieces, freedom, good_enough, gaps);
  PlacedCharts& placed = placing.placed;
  const auto only_moves = [&] { return holds_bound(run, placed, kStoredSpare) && !(options.relax && !none_bends(freedom)); };
  if (!pinched.empty() && only_moves() && stay_whole(run, pinched, points, freedom, pieces, placing)) run.journal.back_to(before);
  if (const Validity valid = certify_charts(placed.charts, points, freedom); !valid.valid())
    throw RefineError(ErrorCode::BadInput, "pack", "charts could not be placed apart: " + valid.problem, valid.chart, valid.face);
  if (holds_bound(run, placed, kStoredSpare) && part_slits(run, placed, points, freedom, pieces))
    placing = place_with(run, pieces, freedom, good_enough, gaps);
  run.journal.show("placed", placed.charts);
  Solution out{.atlas = with_uvs(atlas, uvs_of(placed.charts)), .gap = placing.gap};
  out.atlas.frame = placed.frame;
  if (only_moves()) {
    const bool spares_bending = !none_bends(freedom) && out.gap.value < gaps.front().value;
    warn_of_gap(run, out.gap, spares_bending ? "with a larger one charts would have to be bent" : kNoRoom);
    return out;
  }

  gaps = gaps_to_squeeze_with(run, pieces, freedom, placing, gaps);
  // A wider gap than is to be kept would only be more to be squeezed.
  if (rather_moves(run, pieces.size()) && placing.gap.value != gaps.front().value)
    placed = place(run, pieces, freedom, gaps.front(), good_enough);
  run.journal.begin_stage("squeeze", range.part(0.25, 1));
  std::optional<PlacedCharts> own;
  if (keeps_place && !options.align_axes && certify_charts(pieces, {}, freedom).valid())
    own = own_layout(run, pieces, freedom, gaps.front());
  pieces = {};  // a million triangles' copies are a good part of the memory
  squeeze_into(run, starts_of(run, std::move(own), std::move(placed)), freedom, gaps, out);
  return out;
}

std::optional<Solution> place_and_squeeze_cut(const Refinement& run, const CutAtlas& cut, const ProgressRange& range) {
  RefineOptions options = run.options;
  options.relax = goes_on(run, cut.pieces.size());
  Solution out = place_and_squeeze({run.input, options, run.monitor, run.journal, run.threads, run.asked}, cut, false, range);
  const bool holds = holds_bound(run, {.charts = meshes_of(out.atlas), .frame = out.atlas.frame});
  if (!holds && !run.monitor.finishing()) return std::nullopt;
  out.intervention = Intervention::Cut;
  return out;
}

std::optional<double> squeezed_distortion(const Refinement& run, const CutAtlas& atlas, bool keeps_place, double most) {
  const Freedoms freedom = freedom_of_pieces(freedom_of(run.input.set, run.options), atlas);
  const std::vector<Chart> pieces = meshes_of(atlas);
  const std::vector<Gap> gaps = gaps_of(run, pieces, freedom, kMostTakenBent);
  // The artist's layout spares a packing.
  std::optional<PlacedCharts> start;
  if (keeps_place) start = own_layout(run, pieces, freedom, gaps.front());
  if (!start) start = place(run, pieces, freedom, gaps.front(), kRoughly * run.options.pe_bound);
  if (is_far_above(run, atlas, *start, freedom, gaps, most)) return std::nullopt;
  const ReduceResult result = squeeze_from(run, atlas, {*start}, freedom, gaps, {.distortion = most}).outcome;
  if (!result.holds()) return std::nullopt;
  return result.distortion;
}

std::optional<Solution> squeeze_in_place(const Refinement& run, const CutAtlas& laid, const Solution& from) {
  const auto [start, objective, warm, options] = in_place(run, laid, from);
  const ReduceResult result = squeeze_on(start, objective, from.gap, warm, options, run.monitor);
  run.journal.iterations += result.iterations;
  if (!result.holds()) return std::nullopt;
  return cut_solution(laid, result, from.gap);
}

std::optional<Forecast> forecast_in_place(const Refinement& run, const CutAtlas& laid, const Solution& from) {
  const auto [start, objective, warm, options] = in_place(run, laid, from);
  Forecast out = forecast_squeeze_on(start, objective, from.gap, warm, options, run.monitor);
  if (!out.end.outcome.holds()) return std::nullopt;
  return out;
}

std::optional<Forecast> forecast_anew(const Refinement& run, const CutAtlas& atlas) {
  const Freedoms freedom = freedom_of_pieces(freedom_of(run.input.set, run.options), atlas);
  const std::vector<Chart> pieces = meshes_of(atlas);
  const std::vector<Gap> gaps = gaps_of(run, pieces, freedom, kMostTakenBent);
  // What was bent to make room for a part that has been cut off is packed with the shape that it has without that. How well it
  // is packed then matters less than how many sets of cuts are looked at.
  const auto placer = [&](const std::vector<Chart>& charts, const Objective& objective) {
    const std::vector<Chart> shapes =
        any_fixed(freedom) ? charts : relaxed_apart(charts, objective, gaps.front(), freedom, run.monitor);
    return place(run, shapes, freedom, gaps.front(), kNearly * run.options.pe_bound, PackSearch::Fair);
  };
  const SqueezeOptions options = squeeze_options(run, atlas, freedom, gaps);
  Forecast out = forecast_squeeze(pieces, goal_of(run.input.set.charts, atlas, run.options), placer, options, run.monitor);
  if (!out.end.outcome.holds()) return std::nullopt;
  return out;
}

std::optional<Solution> squeeze_as_forecast(const Refinement& run, const CutAtlas& atlas, const Forecast& forecast) {
  const Freedoms freedom = freedom_of_pieces(freedom_of(run.input.set, run.options), atlas);
  const auto end = squeeze_as_forecast(meshes_of(atlas), goal_of(run.input.set.charts, atlas, run.options), forecast,
                                       squeeze_options(run, atlas, freedom, {forecast.end.gap}), run.monitor);
  if (!end || !end->outcome.holds()) return std::nullopt;
  run.journal.iterations += end->outcome.iterations;
  warn_of_gap(run, end->gap, end->gap_note);
  return cut_solution(atlas, end->outcome, end->gap);
}

}  // namespace atlas_refine
