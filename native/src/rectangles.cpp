// Faces divided where trails cross them: pieces are rectangles (sections 3.2 "Cutting" and 3.3).
#include "rectangles.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "atlas_refine/error.h"
#include "cut/boundary_places.h"
#include "cut_along_edges.h"
#include "cut_plan.h"
#include "geometry/guards.h"
#include "layout/trail_paths.h"
#include "place_and_squeeze.h"
#include "placing.h"
#include "rectangle_pictures.h"
#include "reduce_pieces.h"
#include "report/locked.h"
#include "report/wished_edges.h"

namespace atlas_refine {
namespace {

/// What is told of the cuts; only once they are the result.
void tell(const Refinement& run, const CutPlan& plan, const CutAtlas& cut, const RectangleReport& report) {
  const auto& [aligned, layout, freedom] = std::tie(plan.aligned, plan.layout, plan.freedom);
  std::vector<int> opened, saved, boxed;
  for (int c = 0; c < static_cast<int>(aligned.size()); ++c) {
    const int number = run.input.set.charts[c].number;
    if (aligned[c].holes_cut > 0) opened.push_back(number);
    if (aligned[c].way == AxisAlignedChart::Way::Rectangle) saved.push_back(number);
    if (aligned[c].way == AxisAlignedChart::Way::AsItIs && bends(freedom, c)) boxed.push_back(number);
  }
  Journal& journal = run.journal;
  if (!opened.empty())
    journal.repairs.push_back({.what = std::to_string(report.holes_cut) + (report.holes_cut == 1 ? " hole" : " holes") +
                                       " cut open along shortest paths",
                               .charts = opened});
  if (!saved.empty())
    journal.fallbacks.push_back(charts_named(saved) + ": could not be deformed to the axes; embedded onto a rectangle");
  if (!boxed.empty())
    journal.fallbacks.push_back(charts_named(boxed) + ": not deformed to the axes; packed by the bounding box as it is");
  if (layout.extra_corners > 0)
    journal.fallbacks.push_back("the bound was missed with the charts' own corners; " + std::to_string(layout.extra_corners) +
                                " were added to each chart");
  if (!any_fixed(freedom) && !run.options.gap && layout.gap.value < Gap{}.value)
    journal.warnings.push_back("the gap was reduced from " + number_text("%g", Gap{}.value) + " to " +
                               number_text("%g", layout.gap.value) +
                               " of the box diagonal: no layout holds the bound with a larger one");
  warn_of_forbidden_edges(plan.prices, plan.sources, cut, journal);
}

/// Charts divided along the trails and taken apart, where the axis-aligned charts lie.
CutAtlas cut_along_trails(const Refinement& run, const CutPlan& plan, const Layout& layout) {
  TracedTrails traced = trace_trails(plan.aligned, layout.trails);
  const auto& points = run.input.set.points;
  follow_divided(match_boundaries(traced.meshes, points), traced.paths);
  return cut_along(divided_atlas(traced.meshes, plan.sources, points), plan.sources, traced.paths);
}

/// Why this road is not taken with charts that are not to be touched; empty where it is.
std::string obstacle(const Refinement& run) {
  const Freedoms freedom = freedom_of(run.input.set, run.options);
  const bool kept = std::find(freedom.begin(), freedom.end(), Freedom::Moves) != freedom.end();
  if (kept && run.options.cut == Cut::Split && run.options.rotate == Rotate::None)
    return "some keep their shapes, and must not be turned";
  return "";
}

/// A layout of rectangles has no place for charts that are locked in the texture: the pieces are placed around them by their
/// outlines, and squeezed.
Attempt place_around_locked(const Refinement& run, const CutPlan& plan, CutAtlas cut, const ProgressRange& range) {
  for (Piece& piece : cut.pieces) {
    for (int v = 0; v < piece.mesh.vertex_count() && is_fixed(plan.freedom, piece.chart); ++v)
      piece.mesh.uvs[v] = value_at(piece.supports[v], run.input.set.charts[piece.chart].uvs);
    drop_broken_guards(piece.mesh);
  }
  restore_pieces(plan.sources, plan.freedom, cut);
  std::optional<Solution> out = place_and_squeeze_cut(run, cut, range);
  if (!out) return {.failure = "cut and placed around the locked ones, they do not reach the bound"};
  out->re_embedded = plan.mended;
  out->rectangles = report_of(plan);
  tell(run, plan, out->atlas, *out->rectangles);
  return {.solution = std::move(*out)};
}

/// Nothing where the charts cannot be cut so, or would be left whole: these are squeezed.
std::optional<ReducedPieces> reduced_in(const Refinement& run, const CutPlan& plan, const Layout& layout) {
  const CutAtlas cut = cut_along_trails(run, plan, layout);
  if (cut.seams.empty()) return std::nullopt;
  try {
    return reduce_pieces(run, plan, layout, cut);
  } catch (const RefineError& error) {
    if (error.code() != ErrorCode::NotCertified) throw;
    return std::nullopt;
  }
}

/// Of the layouts that eq. (11) likes best the one whose pieces have the least distortion for their seams.
ReducedPieces reduced_in_best_layout(const Refinement& run, const CutPlan& plan, const CutAtlas& cut) {
  ReducedPieces best = reduce_pieces(run, plan, plan.layout, cut);
  const bool one_is_enough = plan.enough > 0 || limits_of(run.options).any() || cut.pieces.size() > kHundredsOfPieces;
  for (const Layout& layout : plan.others) {
    if (run.monitor.finishing() || (one_is_enough && best.holds())) break;
    auto trial = reduced_in(run, plan, layout);
    if (trial && trial->better_than(best)) best = std::move(*trial);
  }
  return best;
}

Attempt cut_across_faces(const Refinement& run, CutPlan plan, const ProgressRange& range) {
  CutAtlas cut = cut_along_trails(run, plan, plan.layout);
  if (cut.seams.empty()) return {.needless = true};
  if (any_fixed(plan.freedom)) return place_around_locked(run, plan, std::move(cut), range);
  run.journal.begin_stage("reduce", range);
  ReducedPieces pieces = reduced_in_best_layout(run, plan, cut);
  plan.layout = pieces.layout;
  if (pieces.holds()) finish_pieces(run, plan, pieces);
  run.journal.show("packed", pieces.packed);
  if (!pieces.failure.empty()) return {.failure = std::move(pieces.failure)};
  const ReduceResult& reduced = pieces.result;
  if (!reduced.within_limit) return {.failure = "cut, they stay above the largest distortion or stretch allowed"};
  if (!reduced.reached) return {.failure = "cut, they do not reach the bound"};
  Solution out{.intervention = Intervention::Cut, .atlas = std::move(pieces.atlas)};
  out.gap = plan.layout.gap;
  out.ended = ended_of(reduced.status);
  out.price = reduced.price;
  out.re_embedded = plan.mended;
  out.rectangles = report_of(plan);
  tell(run, plan, out.atlas, *out.rectangles);
  return {.solution = std::move(out)};
}

/// Before charts are cut there is nothing to keep: whole, they have a valid atlas sooner.
std::optional<CutPlan> plan_unless_finishing(const Refinement& run, const ProgressRange& range) {
  const Monitor::Worthless plan(run.monitor);
  try {
    return plan_cuts(run, range);
  } catch (const Monitor::GivenUp&) {
    return std::nullopt;
  }
}

}  // namespace

Attempt refine_by_rectangles(const Refinement& run, const ProgressRange& range) {
  const bool along_edges = run.options.cut == Cut::Edges;
  if (std::string why = obstacle(run); !why.empty()) return {.failure = std::move(why)};
  std::optional<CutPlan> plan = plan_unless_finishing(run, range.part(0, 0.45));
  if (!plan) return {.failure = "the work was stopped before"};
  if (run.journal.draws()) {
    for (const auto& picture : rectangle_pictures(plan->charts, plan->aligned, plan->layout.trails, run.options.rectangles.sigma))
      run.journal.show(picture);
  }
  std::vector<int> uncut = uncut_charts(*plan);
  Attempt out = along_edges ? cut_along_edges(run, std::move(*plan), range.part(0.45, 1))
                            : cut_across_faces(run, std::move(*plan), range.part(0.45, 1));
  out.uncut = std::move(uncut);
  return out;
}

}  // namespace atlas_refine
