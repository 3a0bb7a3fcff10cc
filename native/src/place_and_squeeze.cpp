// Rigid placement, then the squeeze from the best starts.
#include "place_and_squeeze.h"

#include "atlas_refine/error.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "pack/place_charts.h"
#include "reduce/goal.h"
#include "reduce/squeeze.h"

namespace atlas_refine {
namespace {

constexpr double kRoughly = 0.75;       // of the bound: a packing good enough to compare with
constexpr double kNearly = 0.95;        // of the bound: good enough for parts that go on to their optimum, E_d ends the same
constexpr double kRounding = 1 + 1e-6;  // storing single precision must not lose the bound

double packing_efficiency(const std::vector<Chart>& charts, double aspect) {
  return uv_area(charts) / box_of_aspect(uv_box(charts), aspect).area();
}

bool gap_kept(const std::vector<Chart>& charts, const Gap& gap, double aspect) {
  return gap_between_charts(charts) >= kStartGap * gap.length(box_of_aspect(uv_box(charts), aspect).size());
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

Squeezed squeezed(const Refinement& run, const CutAtlas& atlas, const std::vector<std::vector<Chart>>& starts,
                  const std::vector<Gap>& gaps, double max_distortion) {
  const SqueezeOptions options{.pe_bound = run.options.pe_bound,
                               .box_aspect = run.options.box_aspect,
                               .gaps = gaps,
                               .max_distortion = max_distortion,
                               .threads = run.threads};
  Squeezed best = squeeze(starts, goal_of(run.input.set.charts, atlas, run.options), options, run.monitor);
  run.journal.iterations += best.iterations;
  return best;
}

}  // namespace

bool holds_bound(const Refinement& run, const std::vector<Chart>& placed, double spare) {
  const RefineOptions& options = run.options;
  const bool allowed = !options.max_distortion || dirichlet_sums(placed).best_energy() <= *options.max_distortion;
  return allowed && packing_efficiency(placed, options.box_aspect) >= spare * options.pe_bound;
}

Solution place_and_squeeze(const Refinement& run, const CutAtlas& atlas, bool keeps_place, const ProgressRange& range) {
  const RefineOptions& options = run.options;
  const std::vector<Chart> pieces = meshes_of(atlas);
  run.journal.begin_stage("pack", range.part(0, 0.25));
  const std::vector<Gap> gaps = gaps_of(run, pieces);
  const double good_enough = options.relax && !atlas.seams.empty() ? kNearly * options.pe_bound : options.pe_bound;
  const std::vector<Chart> placed = place(run, pieces, gaps.front(), good_enough);
  if (const Validity valid = certify_charts(placed); !valid.valid())
    throw RefineError(ErrorCode::BadInput, "pack", "charts could not be placed apart: " + valid.problem, valid.chart, valid.face);
  run.journal.show("placed", placed);
  Solution out{.atlas = with_uvs(atlas, uvs_of(placed)), .gap = gaps.front()};
  if (holds_bound(run, placed, kRounding) && !options.relax) {
    warn_of_gap(run, out.gap, kNoRoom);
    return out;
  }

  run.journal.begin_stage("squeeze", range.part(0.25, 1));
  const Squeezed best = squeezed(run, out.atlas, starts_of(run, pieces, keeps_place, placed, gaps.front()), gaps,
                                 options.max_distortion.value_or(0));
  out.intervention = Intervention::Squeezed;
  out.atlas = with_uvs(std::move(out.atlas), best.outcome.uvs);
  out.gap = best.gap;
  out.ended = ended_of(best.outcome.status);
  out.price = best.outcome.price;
  warn_of_gap(run, best.gap, best.gap_note);
  return out;
}

std::optional<double> squeezed_distortion(const Refinement& run, const CutAtlas& atlas, bool keeps_place, double most) {
  const std::vector<Chart> pieces = meshes_of(atlas);
  const std::vector<Gap> gaps = gaps_of(run, pieces);
  // The artist's layout spares a packing.
  const bool own = keeps_place && gap_kept(pieces, gaps.front(), run.options.box_aspect);
  const std::vector<Chart> start = own ? pieces : place(run, pieces, gaps.front(), kRoughly * run.options.pe_bound);
  const ReduceResult result = squeezed(run, atlas, {start}, gaps, most).outcome;
  if (!result.reached || !result.within_limit) return std::nullopt;
  return result.distortion;
}

}  // namespace atlas_refine
