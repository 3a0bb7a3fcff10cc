// Repair, place, squeeze.
#include "whole.h"

#include "atlas_refine/error.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "pack/place_charts.h"
#include "reduce/goal.h"
#include "reduce/squeeze.h"
#include "repair/part_touching.h"
#include "report/note_repairs.h"

namespace atlas_refine {
namespace {

constexpr double kRoughly = 0.75;       // of the bound: a packing good enough to compare with
constexpr double kRounding = 1 + 1e-6;  // storing single precision must not lose the bound

double packing_efficiency(const std::vector<Chart>& charts, double aspect) {
  return uv_area(charts) / box_of_aspect(uv_box(charts), aspect).area();
}

bool gap_kept(const std::vector<Chart>& charts, const Gap& gap, double aspect) {
  return gap_between_charts(charts) >= kStartGap * gap.length(box_of_aspect(uv_box(charts), aspect).size());
}

/// Borders that touch at a vertex (a pinch) may stay so where charts are but moved; no barrier can start from contact.
bool part_pinches(const Refinement& run, std::vector<Chart>& charts) {
  std::vector<int> parted;
  for (Chart& chart : charts) {
    if (certify_charts({chart}).valid()) continue;
    if (auto apart = part_touching(chart)) chart = std::move(*apart);
    parted.push_back(chart.number);
  }
  if (parted.empty()) return false;
  run.journal.repairs.push_back({.what = "touched itself at a vertex, parted there", .charts = parted});
  return true;
}

bool holds(const Refinement& run, const std::vector<Chart>& placed) {
  const RefineOptions& options = run.options;
  const bool allowed = !options.max_distortion || dirichlet_sums(placed).best_energy() <= *options.max_distortion;
  return allowed && packing_efficiency(placed, options.box_aspect) >= kRounding * options.pe_bound;
}

/// The packer's layout and, where it is a valid start, the artist's: of a large atlas only the tighter one is tried.
std::vector<std::vector<Chart>> starts_of(const Refinement& run, const std::vector<Chart>& own, bool own_is_valid,
                                          const std::vector<Chart>& placed, const Gap& gap) {
  constexpr std::size_t kLarge = 30000;
  const double aspect = run.options.box_aspect;
  if (!own_is_valid || !gap_kept(own, gap, aspect)) return {placed};
  std::size_t triangles = 0;
  for (const Chart& chart : own) triangles += chart.triangles.size();
  if (triangles <= kLarge) return {placed, own};
  return {packing_efficiency(own, aspect) > packing_efficiency(placed, aspect) ? own : placed};
}

std::vector<std::vector<Vec2>> uvs_of(const std::vector<Chart>& charts) {
  std::vector<std::vector<Vec2>> out;
  out.reserve(charts.size());
  for (const Chart& chart : charts) out.push_back(chart.uvs);
  return out;
}

std::vector<Chart> place(const Refinement& run, const std::vector<Chart>& charts, const Gap& gap, double good_enough) {
  const PlaceOptions options{gap, run.options.box_aspect, good_enough, run.options.seed, run.threads};
  return place_charts(charts, options, run.monitor);
}

std::vector<Gap> gaps_of(const Refinement& run, const std::vector<Chart>& charts) {
  const RefineOptions& options = run.options;
  if (options.gap) return {*options.gap};
  return automatic_gaps(charts, options.pe_bound, options.box_aspect);
}

void warn_of_gap(const Refinement& run, const Gap& gap, const std::string& why) {
  if (run.options.gap || gap.value >= Gap{}.value) return;
  run.journal.warnings.push_back("the gap was reduced from " + number_text("%g", Gap{}.value) + " to " +
                                 number_text("%g", gap.value) + " of the box diagonal: " + why);
}

void squeeze_into(const Refinement& run, const std::vector<std::vector<Chart>>& starts, const std::vector<Gap>& gaps,
                  Solution& out) {
  const SqueezeOptions options{.pe_bound = run.options.pe_bound,
                               .box_aspect = run.options.box_aspect,
                               .gaps = gaps,
                               .max_distortion = run.options.max_distortion.value_or(0),
                               .threads = run.threads};
  const Objective objective = goal_of(run.input.set.charts, out.atlas, run.options);
  Squeezed best = squeeze(starts, objective, options, run.monitor);
  run.journal.iterations += best.iterations;
  out.intervention = Intervention::Squeezed;
  out.atlas = with_uvs(std::move(out.atlas), best.outcome.uvs);
  out.gap = best.gap;
  out.ended = ended_of(best.outcome.status);
  out.price = best.outcome.price;
  warn_of_gap(run, best.gap, best.gap_note);
}

}  // namespace

Solution refine_whole(const Refinement& run, const ProgressRange& range) {
  const RefineOptions& options = run.options;
  run.journal.begin_stage("repair", range.part(0, 0.2));
  RepairedCharts repaired = repair_charts(run.input.set.charts, repair_options(run), run.monitor);
  Solution out{.re_embedded = note_repairs(run, repaired)};
  std::vector<Chart> charts = meshes_of(repaired.atlas);
  const auto points = points_in_space(repaired.atlas, run.input.set.points);
  bool own_is_valid = certify_charts(charts, points).valid();

  run.journal.begin_stage("pack", range.part(0.2, 0.4));
  const bool scaled = set_density(charts, wanted_density(run.input.set.charts, options.density), options.density);
  const std::vector<Gap> gaps = gaps_of(run, charts);
  std::vector<Chart> placed = place(run, charts, gaps.front(), options.pe_bound);
  if (const Validity valid = certify_charts(placed, points); !valid.valid())
    throw RefineError(ErrorCode::BadInput, "pack", "charts could not be placed apart: " + valid.problem, valid.chart, valid.face);
  run.journal.show("placed", placed);
  out.atlas = with_uvs(std::move(repaired.atlas), uvs_of(placed));
  out.gap = gaps.front();
  if (holds(run, placed) && !options.relax) {
    warn_of_gap(run, out.gap, kNoRoom);
    return out;
  }

  if (part_pinches(run, charts)) {
    placed = place(run, charts, gaps.front(), options.pe_bound);
    own_is_valid = own_is_valid && certify_charts(charts).valid();
  }
  run.journal.begin_stage("squeeze", range.part(0.4, 1));
  squeeze_into(run, starts_of(run, charts, own_is_valid && !scaled, placed, gaps.front()), gaps, out);
  return out;
}

std::optional<double> distortion_without_cuts(const Refinement& run, double most) {
  std::vector<Chart> charts = run.input.set.charts;
  for (const Chart& chart : charts) {
    if (!certify_charts({chart}).valid()) return std::nullopt;
  }
  const bool scaled = set_density(charts, wanted_density(charts, run.options.density), run.options.density);
  const std::vector<Gap> gaps = gaps_of(run, charts);
  // The artist's layout spares a packing.
  const bool own = !scaled && certify_charts(charts).valid() && gap_kept(charts, gaps.front(), run.options.box_aspect);
  const std::vector<Chart> start = own ? charts : place(run, charts, gaps.front(), kRoughly * run.options.pe_bound);
  const SqueezeOptions options{.pe_bound = run.options.pe_bound,
                               .box_aspect = run.options.box_aspect,
                               .gaps = gaps,
                               .max_distortion = most,
                               .threads = run.threads};
  const Objective objective = goal_of(run.input.set.charts, whole_atlas(charts), run.options);
  const Squeezed squeezed = squeeze({start}, objective, options, run.monitor);
  run.journal.iterations += squeezed.iterations;
  const ReduceResult& result = squeezed.outcome;
  if (!result.reached || !result.within_limit) return std::nullopt;
  return result.distortion;
}

}  // namespace atlas_refine
