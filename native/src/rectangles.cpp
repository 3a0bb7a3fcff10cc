// The three steps of the paper, one after the other.
#include "rectangles.h"

#include <algorithm>
#include <cmath>

#include "align/align.h"
#include "cut/boundary_places.h"
#include "cut/restore_faces.h"
#include "layout/place_pieces.h"
#include "layout/search_layout.h"
#include "layout/trail_paths.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "pack/place_charts.h"
#include "rectangle_pictures.h"
#include "reduce/goal.h"
#include "repair/re_embed.h"
#include "report/locked.h"

namespace atlas_refine {
namespace {

constexpr double kGapStep = 0.6;
constexpr int kGapSteps = 3;  // smaller automatic gaps tried before extra corners
// Until faces are restored pieces are kept so much further apart than the gap, which leaves room for the last steps.
constexpr double kFirstGap = 1.02;
// Relative change of E_d at which the reduction before that ends, and the one after (the paper: 1e-4 for several iterations).
constexpr double kFirstChange = 5e-4;
constexpr double kLastChange = 2e-5;
constexpr double kSpread = 1.01;  // what pieces are put further apart by before the reduction, as a factor on their places

using AlignedCharts = std::vector<AxisAlignedChart>;

LayoutOptions layout_options(const Refinement& run) {
  const RefineOptions& options = run.options;
  LayoutOptions layout{.pe_bound = options.pe_bound,
                       .box_aspect = options.box_aspect,
                       .gaps = {options.gap.value_or(Gap{})},
                       .rectangles = options.rectangles,
                       .seed = options.seed,
                       .threads = run.threads};
  for (int k = 0; !options.gap && k < kGapSteps; ++k) {
    Gap smaller = layout.gaps.back();
    smaller.value *= kGapStep;
    layout.gaps.push_back(smaller);
  }
  return layout;
}

void embed(const Refinement& run, int c, std::vector<Chart>& charts, std::vector<int>& embedded) {
  charts[c] = re_embed(charts[c], charts[c].number, run.threads, run.monitor);
  run.journal.repairs.push_back({.what = "overlapped or touched itself, embedded anew", .charts = {charts[c].number}});
  embedded.push_back(c);
}

/// Charts may overlap themselves here, but every triangle must be positive.
void embed_broken_polygons(const Refinement& run, const Freedoms& freedom, std::vector<Chart>& charts,
                           std::vector<int>& embedded) {
  for (const FaceDefect& defect : run.input.set.defects) {
    const Validity validity = certify_charts({charts[defect.chart]});
    if (validity.flipped_faces == 0) continue;  // mended with another of its faces
    if (!bends(freedom, defect.chart)) refuse_kept_shape(charts[defect.chart].number, validity);
    embed(run, defect.chart, charts, embedded);
  }
}

/// Charts that only move are packed by their bounding box: turned so that it is small.
void turn_kept(const Refinement& run, const Freedoms& freedom, std::vector<Chart>& charts) {
  const PlaceOptions options{.rotate = run.options.rotate, .align_axes = run.options.align_axes};
  for (std::size_t c = 0; c < charts.size(); ++c) {
    if (!bends(freedom, c)) charts[c] = place_charts({charts[c]}, options, run.monitor).front();
  }
}

/// Axis-aligned charts at their wanted densities. Those that are left as they are lie in the layout as they are: they must not
/// overlap themselves.
AlignedCharts align(const Refinement& run, const Freedoms& freedom, std::vector<Chart>& charts, std::vector<int>& embedded) {
  const AlignOptions options{run.options.rectangles.sigma, run.threads, freedom};
  AlignedCharts aligned = align_charts(charts, options, run.monitor);
  for (int c = 0; c < static_cast<int>(charts.size()); ++c) {
    if (aligned[c].way != AxisAlignedChart::Way::AsItIs) continue;
    const Validity validity = certify_charts({charts[c]});
    if (validity.valid()) continue;
    if (!bends(freedom, c)) refuse_kept_shape(charts[c].number, validity);
    embed(run, c, charts, embedded);
    set_density(charts, wanted_density(run.input.set.charts, run.options.density), run.options.density);
    aligned[c] = std::move(align_charts({charts[c]}, options, run.monitor).front());
  }
  const std::vector<double> wanted = wanted_density(run.input.set.charts, run.options.density);
  for (std::size_t c = 0; c < aligned.size(); ++c) {
    for (Vec2& uv : aligned[c].mesh.uvs) uv *= wanted[c];
  }
  return aligned;
}

RectangleReport report_of(const AlignedCharts& aligned, const Layout& layout) {
  RectangleReport report{.extra_corners = layout.extra_corners, .packed_pe = layout.pe};
  for (const AxisAlignedChart& chart : aligned) {
    report.tutte_charts += chart.way == AxisAlignedChart::Way::Rectangle;
    report.boxed_charts += chart.way == AxisAlignedChart::Way::AsItIs;
    report.holes_cut += chart.holes_cut;
  }
  for (const auto& trails : layout.trails) report.trails += static_cast<int>(trails.size());
  return report;
}

/// What is told of the cuts; only once they are the result.
void tell(const Refinement& run, const Freedoms& freedom, const AlignedCharts& aligned, const Layout& layout,
          const RectangleReport& report) {
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
  if (!run.options.gap && layout.gap.value < Gap{}.value)
    journal.warnings.push_back("the gap was reduced from " + number_text("%g", Gap{}.value) + " to " +
                               number_text("%g", layout.gap.value) +
                               " of the box diagonal: no layout holds the bound with a larger one");
}

/// Charts divided along the trails and taken apart, where the axis-aligned charts lie.
CutAtlas cut_along_trails(const Refinement& run, const AlignedCharts& aligned, const std::vector<Chart>& charts,
                          const Layout& layout) {
  TracedTrails traced = trace_trails(aligned, layout.trails);
  const auto points = space_points(run.input.atlas, run.input.set);
  match_boundaries(traced.meshes, points);
  return cut_along(divided_atlas(traced.meshes, charts, points), charts, traced.paths);
}

/// The pieces where the layout wants them, a little further apart as far as the bound allows: pieces that touch block each
/// other's first steps.
void place(const Refinement& run, const Layout& layout, CutAtlas& cut) {
  const std::vector<Chart> packed = place_pieces(layout, meshes_of(cut), charts_of(cut));
  run.journal.show("packed", packed);
  const double factor = std::max(1.0, std::min(kSpread, std::sqrt(layout.pe / (1.01 * run.options.pe_bound))));
  for (std::size_t p = 0; p < packed.size(); ++p) {
    const Vec2 shift = (factor - 1) * uv_box({packed[p]}).min;
    cut.pieces[p].mesh.uvs = packed[p].uvs;
    for (Vec2& uv : cut.pieces[p].mesh.uvs) uv += shift;
  }
}

/// The objective of the charts as they come: where the paper stops.
double energy_of_input(const Refinement& run, const std::vector<Chart>& charts) {
  const Objective objective = goal_of(run.input.set.charts, whole_atlas(charts), run.options);
  const std::vector<Chart> start = charts;
  return reduce_distortion({.charts = start, .objective = objective, .max_iterations = 0}).energy;
}

/// Moves the pieces to less distortion under the bound.
ReduceResult reduce(const Refinement& run, const Gap& gap, double least_change, double enough, CutAtlas& cut) {
  const std::vector<Chart> pieces = meshes_of(cut);
  const Freedoms of_charts = freedom_of(run.input.set, run.options);
  Freedoms freedom;
  for (const Piece& piece : cut.pieces) {
    if (!of_charts.empty()) freedom.push_back(of_charts[piece.chart]);
  }
  const ReduceProblem problem{.charts = pieces,
                              .objective = goal_of(run.input.set.charts, cut, run.options),
                              .gap = gap,
                              .box_aspect = run.options.box_aspect,
                              .pe_target = run.options.pe_bound,
                              .enough_distortion = enough,
                              .least_change = 0,
                              .negligible = least_change,
                              .max_distortion = run.options.max_distortion.value_or(0),
                              .threads = run.threads,
                              .freedom = freedom};
  ReduceResult reduced = reduce_distortion(
      problem, [&](const ReduceProgress& progress) { run.monitor.report(1 - 1 / (1 + 0.1 * progress.iteration), progress.pe); });
  run.journal.iterations += reduced.iterations;
  cut = with_uvs(std::move(cut), reduced.uvs);
  return reduced;
}

/// Takes out the vertices that only served the deformation.
void restore(const std::vector<Chart>& charts, const Freedoms& freedom, CutAtlas& cut) {
  const double scale = dirichlet_sums(meshes_of(cut)).best_scale();
  for (Piece& piece : cut.pieces) {
    if (bends(freedom, piece.chart)) restore_faces(piece, charts[piece.chart], scale);
  }
}

/// Why this road is not taken with charts that are not to be touched; empty where it is.
std::string obstacle(const Refinement& run, const Freedoms& freedom) {
  if (any_fixed(freedom)) return "some are locked, and rectangles cannot be packed around them";
  const bool kept = std::find(freedom.begin(), freedom.end(), Freedom::Moves) != freedom.end();
  if (kept && run.options.rotate == Rotate::None) return "some keep their shapes, and must not be turned";
  return "";
}

}  // namespace

Attempt refine_by_rectangles(const Refinement& run, const ProgressRange& range) {
  const RefineOptions& options = run.options;
  Journal& journal = run.journal;
  const Freedoms freedom = freedom_of(run.input.set, options);
  if (std::string why = obstacle(run, freedom); !why.empty()) return {.failure = std::move(why)};
  Solution out{.intervention = Intervention::Cut};
  std::vector<Chart> charts = run.input.set.charts;
  journal.begin_stage("embed", range.part(0, 0.03));
  embed_broken_polygons(run, freedom, charts, out.re_embedded);
  set_density(charts, wanted_density(run.input.set.charts, options.density), options.density);
  const double enough = options.rectangles.until_input ? energy_of_input(run, charts) : 0;

  journal.begin_stage("align", range.part(0.03, 0.35));  // section 3.1
  turn_kept(run, freedom, charts);
  const AlignedCharts aligned = align(run, freedom, charts, out.re_embedded);

  journal.begin_stage("layout", range.part(0.35, 0.45));  // section 3.2
  const Layout layout = search_layout(aligned, charts, layout_options(run), run.monitor);
  out.atlas = cut_along_trails(run, aligned, charts, layout);
  if (out.atlas.seams.empty()) return {.needless = true};
  if (journal.draws()) {
    for (const auto& picture : rectangle_pictures(charts, aligned, layout.trails, options.rectangles.sigma))
      journal.show(picture);
  }
  place(run, layout, out.atlas);
  const Validity start = certify_charts(meshes_of(out.atlas));
  if (!start.valid()) return {.failure = "in their layout " + start.problem};

  journal.begin_stage("reduce", range.part(0.45, 1));  // section 3.3
  Gap wide = layout.gap;
  wide.value *= kFirstGap;
  ReduceResult reduced = reduce(run, wide, kFirstChange, enough, out.atlas);
  if (reduced.reached && reduced.within_limit) {
    restore(charts, freedom, out.atlas);
    reduced = reduce(run, layout.gap, kLastChange, enough, out.atlas);
  }
  if (!reduced.within_limit) return {.failure = "cut, their distortion stays above the largest allowed"};
  if (!reduced.reached) return {.failure = "cut, they do not reach the bound"};
  out.gap = layout.gap;
  out.ended = ended_of(reduced.status);
  out.price = reduced.price;
  out.rectangles = report_of(aligned, layout);
  tell(run, freedom, aligned, layout, *out.rectangles);
  return {.solution = std::move(out)};
}

}  // namespace atlas_refine
