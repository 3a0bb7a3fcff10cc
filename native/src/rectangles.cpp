// Faces divided where trails cross them: pieces are rectangles (sections 3.2 "Cutting" and 3.3).
#include "rectangles.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "coarsen/coarse_atlas.h"
#include "cut/boundary_places.h"
#include "cut/restore_faces.h"
#include "cut_along_edges.h"
#include "cut_plan.h"
#include "geometry/guards.h"
#include "layout/place_pieces.h"
#include "layout/trail_paths.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "place_and_squeeze.h"
#include "rectangle_pictures.h"
#include "reduce/goal.h"
#include "reduce/squeeze.h"
#include "report/locked.h"

namespace atlas_refine {
namespace {

// Until faces are restored pieces are kept so much further apart than the gap, which leaves room for the last steps.
constexpr double kFirstGap = 1.02;
// Relative change of E_d at which the reduction before that ends, and the one after (the paper: 1e-4 for several iterations).
constexpr double kFirstChange = 5e-4;
constexpr double kLastChange = 2e-5;
// From so many triangles on the first reduction is that of coarse charts. With fewer the time matters less than that another way
// may end in another optimum, by up to 6e-4 of E_d.
constexpr std::size_t kMany = 30000;
constexpr double kCoarseChange = 3e-5;   // what slides slowly slides on the coarse charts, where that costs little
constexpr double kCarriedChange = 6e-6;  // nearer to the optimum less changes at once
// Hundreds of pieces may be jammed and slide on and on, by next to nothing: each reduction ends after so many iterations.
constexpr std::size_t kHundreds = 100;
constexpr int kMostIterations = 150;
constexpr std::size_t kOtherWays = 7;   // that pieces are packed in besides, at most,
constexpr std::size_t kReduced = 6000;  // and as many as so many triangles are reduced in: some tenths of a second
constexpr double kSpread = 1.01;        // what pieces are put further apart by before the reduction, as a factor on their places

/// How many edges that must stay whole the cuts run along or across.
int forbidden_edges_cut(const CutPlan& plan, const CutAtlas& cut) {
  const std::vector<SidePrices>& prices = plan.prices;
  using ChartEdge = std::tuple<int, int, int>;  // chart, lower and higher vertex
  std::set<ChartEdge> forbidden, hit;
  for (int c = 0; c < static_cast<int>(prices.size()); ++c) {
    for (std::size_t t = 0; t < prices[c].size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(plan.sources[c].triangles[t][k], plan.sources[c].triangles[t][(k + 1) % 3]);
        if (prices[c][t][k] == kNoSeam) forbidden.insert({c, low, high});
      }
    }
  }
  const auto note = [&](int chart, const std::set<int>& vertices) {
    const ChartEdge edge{chart, *vertices.begin(), *vertices.rbegin()};
    if (vertices.size() == 2 && forbidden.contains(edge)) hit.insert(edge);
  };
  for (const Seam& seam : cut.seams) {
    std::set<int> both;
    for (int end : seam.ends) {
      std::set<int> own = {end};
      if (end < 0) own = {cut.points[~end].support.vertices.begin(), cut.points[~end].support.vertices.end()};
      own.erase(-1);
      note(seam.chart, own);
      both.insert(own.begin(), own.end());
    }
    note(seam.chart, both);
  }
  return static_cast<int>(hit.size());
}

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
    journal.fallbacks.push_back(charts_named(boxed) + ": too few triangles, or no disk; packed by the bounding box as it is");
  if (layout.extra_corners > 0)
    journal.fallbacks.push_back("the bound was missed with the charts' own corners; " + std::to_string(layout.extra_corners) +
                                " were added to each chart");
  if (!any_fixed(freedom) && !run.options.gap && layout.gap.value < Gap{}.value)
    journal.warnings.push_back("the gap was reduced from " + number_text("%g", Gap{}.value) + " to " +
                               number_text("%g", layout.gap.value) +
                               " of the box diagonal: no layout holds the bound with a larger one");
  if (const int count = forbidden_edges_cut(plan, cut); count > 0)
    journal.warnings.push_back("cuts run along or across " + std::to_string(count) + (count == 1 ? " edge" : " edges") +
                               " where no seam is wanted");
}

/// Charts divided along the trails and taken apart, where the axis-aligned charts lie.
CutAtlas cut_along_trails(const Refinement& run, const CutPlan& plan) {
  TracedTrails traced = trace_trails(plan.aligned, plan.layout.trails);
  const auto& points = run.input.set.points;
  follow_divided(match_boundaries(traced.meshes, points), traced.paths);
  return cut_along(divided_atlas(traced.meshes, plan.sources, points), plan.sources, traced.paths);
}

/// The pieces where the layout wants them, a little further apart as far as the bound allows: pieces that touch block each
/// other's first steps. Returns them as the layout has them.
std::vector<Chart> place(const Refinement& run, const Layout& layout, CutAtlas& cut) {
  std::vector<Chart> packed = place_pieces(layout, meshes_of(cut), charts_of(cut));
  const double factor = std::max(1.0, std::min(kSpread, std::sqrt(layout.pe / (1.01 * run.options.pe_bound))));
  for (std::size_t p = 0; p < packed.size(); ++p) {
    const Vec2 shift = (factor - 1) * uv_box({packed[p]}).min;
    cut.pieces[p].mesh.uvs = packed[p].uvs;
    for (Vec2& uv : cut.pieces[p].mesh.uvs) uv += shift;
    drop_broken_guards(cut.pieces[p].mesh);  // of polygons that the axes have bent
  }
  return packed;
}

/// How far the pieces are reduced.
struct Reduction {
  Gap gap;
  double negligible;  ///< ReduceProblem::negligible
  double enough;      ///< ReduceProblem::enough_distortion
};

ReduceResult reduce_charts(const Refinement& run, const std::vector<Chart>& charts, const Objective& objective,
                           const Freedoms& freedom, const Reduction& reduction) {
  const ReduceProblem problem{.charts = charts,
                              .objective = &objective,
                              .gap = beyond_rounding(reduction.gap, run.options.stored),
                              .box_aspect = run.options.box_aspect,
                              .pe_target = run.options.pe_bound,
                              .enough_distortion = reduction.enough,
                              .least_change = 0,
                              .negligible = reduction.negligible,
                              .max_distortion = run.options.max_distortion.value_or(0),
                              .max_iterations = charts.size() > kHundreds ? kMostIterations : ReduceProblem::kMostIterations,
                              .threads = run.threads,
                              .freedom = freedom};
  ReduceResult reduced = reduce_distortion(problem, [&](const ReduceProgress& progress) {
    run.monitor.report(1 - 1 / (1 + 0.1 * progress.iteration), progress.pe);
    return !run.monitor.finishing();
  });
  run.journal.iterations += reduced.iterations;
  return reduced;
}

/// Moves the pieces to less distortion under the bound.
ReduceResult reduce(const Refinement& run, const Reduction& reduction, CutAtlas& cut) {
  const Freedoms freedom = freedom_of_pieces(freedom_of(run.input.set, run.options), cut);
  ReduceResult reduced = reduce_charts(run, meshes_of(cut), goal_of(run.input.set.charts, cut, run.options), freedom, reduction);
  cut = with_uvs(std::move(cut), reduced.uvs);
  return reduced;
}

/// The same to the optimum on coarse charts, carried over to the pieces; false, and nothing has changed, where that is not to be
/// had. What stops at some distortion has to see that of the pieces.
bool reduce_coarsely(const Refinement& run, const Reduction& reduction, CutAtlas& cut) {
  std::size_t triangles = 0;
  for (const Piece& piece : cut.pieces) triangles += piece.mesh.triangles.size();
  if (triangles < kMany || run.options.max_distortion || reduction.enough > 0) return false;
  const Freedoms freedom = freedom_of_pieces(freedom_of(run.input.set, run.options), cut);
  const std::vector<Chart> pieces = meshes_of(cut);
  const Objective objective = goal_of(run.input.set.charts, cut, run.options);
  const auto coarse = coarsen(pieces, objective, freedom);
  if (!coarse) return false;
  const PlacedCharts start = restricted(*coarse, PlacedCharts{.charts = pieces});
  const ReduceResult reduced = reduce_charts(run, start.charts, coarse->objective, freedom,
                                             {.gap = reduction.gap, .negligible = kCoarseChange, .enough = 0});
  if (!reduced.holds()) return false;
  const auto uvs = prolonged(*coarse, pieces, objective, reduced.uvs);
  if (!uvs) return false;
  CutAtlas carried = with_uvs(cut, *uvs);
  if (!certify_charts(meshes_of(carried)).valid()) return false;
  cut = std::move(carried);
  return true;
}

/// Takes out the vertices that only served the deformation.
void restore(const std::vector<Chart>& charts, const Freedoms& freedom, CutAtlas& cut) {
  const double scale = dirichlet_sums(meshes_of(cut)).best_scale();
  const std::vector<bool> border_points = points_on_borders(cut);
  for (Piece& piece : cut.pieces) {
    if (bends(freedom, piece.chart)) restore_faces(piece, charts[piece.chart], scale, border_points);
  }
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
  restore(plan.sources, plan.freedom, cut);
  std::optional<Solution> out = place_and_squeeze_cut(run, cut, range);
  if (!out) return {.failure = "cut and placed around the locked ones, they do not reach the bound"};
  out->re_embedded = plan.mended;
  out->rectangles = report_of(plan);
  tell(run, plan, out->atlas, *out->rectangles);
  return {.solution = std::move(*out)};
}

/// The pieces after their first reduction.
struct FirstReduced {
  CutAtlas atlas;
  std::vector<Chart> packed;  ///< before
  std::string failure = {};   ///< why there is none
  bool carried = false;       ///< over from coarse charts
  ReduceResult result = {};   ///< else
};

FirstReduced first_reduced(const Refinement& run, const Layout& layout, const Reduction& reduction, CutAtlas cut) {
  FirstReduced out{.atlas = std::move(cut), .packed = {}};
  out.packed = place(run, layout, out.atlas);
  const Validity start = certify_charts(meshes_of(out.atlas));
  if (!start.valid()) {
    out.failure = "in their layout " + start.problem;
    return out;
  }
  out.carried = reduce_coarsely(run, reduction, out.atlas);
  if (!out.carried) out.result = reduce(run, reduction, out.atlas);
  return out;
}

/// Where few triangles are soon reduced their pieces are packed in several ways: what is best is known only then.
FirstReduced best_reduced(const Refinement& run, const Layout& layout, const Reduction& reduction, const CutAtlas& cut) {
  FirstReduced best = first_reduced(run, layout, reduction, cut);
  if (best.carried || !best.result.holds()) return best;
  std::size_t triangles = 1;
  for (const Piece& piece : cut.pieces) triangles += piece.mesh.triangles.size();
  const int ways = static_cast<int>(std::min(kOtherWays, kReduced / triangles));
  for (const Layout& other : packed_otherwise(layout, ways, layout_options(run))) {
    FirstReduced trial = first_reduced(run, other, reduction, cut);
    if (trial.failure.empty() && trial.result.holds() && trial.result.energy < best.result.energy) best = std::move(trial);
  }
  return best;
}

Attempt cut_across_faces(const Refinement& run, const CutPlan& plan, const ProgressRange& range) {
  const Gap& gap = plan.layout.gap;
  Solution out{.intervention = Intervention::Cut, .atlas = cut_along_trails(run, plan)};
  if (out.atlas.seams.empty()) return {.needless = true};
  if (any_fixed(plan.freedom)) return place_around_locked(run, plan, std::move(out.atlas), range);
  run.journal.begin_stage("reduce", range);  // section 3.3
  Reduction first{.gap = gap, .negligible = kFirstChange, .enough = plan.enough};
  first.gap.value *= kFirstGap;
  auto [atlas, packed, failure, carried, reduced] = best_reduced(run, plan.layout, first, out.atlas);
  run.journal.show("packed", packed);
  if (!failure.empty()) return {.failure = std::move(failure)};
  out.atlas = std::move(atlas);
  if (carried || reduced.holds()) {
    restore(plan.sources, plan.freedom, out.atlas);
    const double least_change = carried ? kCarriedChange : kLastChange;
    reduced = reduce(run, {.gap = gap, .negligible = least_change, .enough = plan.enough}, out.atlas);
  }
  if (!reduced.within_limit) return {.failure = "cut, their distortion stays above the largest allowed"};
  if (!reduced.reached) return {.failure = "cut, they do not reach the bound"};
  out.gap = gap;
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
  return along_edges ? cut_along_edges(run, std::move(*plan), range.part(0.45, 1))
                     : cut_across_faces(run, *plan, range.part(0.45, 1));
}

}  // namespace atlas_refine
