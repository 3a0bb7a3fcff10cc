// The three steps of the paper, one after the other.
#include "rectangles.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "align/align.h"
#include "cut/boundary_places.h"
#include "cut/restore_faces.h"
#include "input/price_sides.h"
#include "layout/edge_paths.h"
#include "layout/place_pieces.h"
#include "layout/search_layout.h"
#include "layout/trail_paths.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "place_and_squeeze.h"
#include "rectangle_pictures.h"
#include "reduce/goal.h"
#include "repair/re_embed.h"

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
void embed_broken_polygons(const Refinement& run, std::vector<Chart>& charts, std::vector<int>& embedded) {
  for (const FaceDefect& defect : run.input.set.defects) {
    if (certify_charts({charts[defect.chart]}).flipped_faces == 0) continue;  // mended with another of its faces
    embed(run, defect.chart, charts, embedded);
  }
}

/// Axis-aligned charts at their wanted densities. Those that are left as they are lie in the layout as they are: they must not
/// overlap themselves.
AlignedCharts align(const Refinement& run, const std::vector<SidePrices>& prices, std::vector<Chart>& charts,
                    std::vector<int>& embedded) {
  const AlignOptions options{run.options.rectangles.sigma, run.threads, prices};
  AlignedCharts aligned = align_charts(charts, options, run.monitor);
  for (int c = 0; c < static_cast<int>(charts.size()); ++c) {
    if (aligned[c].way != AxisAlignedChart::Way::AsItIs || certify_charts({charts[c]}).valid()) continue;
    embed(run, c, charts, embedded);
    set_density(charts, wanted_density(run.input.set.charts, run.options.density), run.options.density);
    aligned[c] = std::move(align_charts({charts[c]}, {options.sigma, options.threads, {prices[c]}}, run.monitor).front());
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
void tell(const Refinement& run, const AlignedCharts& aligned, const Layout& layout, const RectangleReport& report) {
  std::vector<int> opened, saved, boxed;
  for (int c = 0; c < static_cast<int>(aligned.size()); ++c) {
    const int number = run.input.set.charts[c].number;
    if (aligned[c].holes_cut > 0) opened.push_back(number);
    if (aligned[c].way == AxisAlignedChart::Way::Rectangle) saved.push_back(number);
    if (aligned[c].way == AxisAlignedChart::Way::AsItIs) boxed.push_back(number);
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

/// How many edges that must stay whole the cuts run along or across.
int forbidden_edges_cut(const std::vector<Chart>& charts, const std::vector<SidePrices>& prices, const CutAtlas& cut) {
  using ChartEdge = std::tuple<int, int, int>;  // chart, lower and higher vertex
  std::set<ChartEdge> forbidden, hit;
  for (int c = 0; c < static_cast<int>(prices.size()); ++c) {
    for (std::size_t t = 0; t < prices[c].size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(charts[c].triangles[t][k], charts[c].triangles[t][(k + 1) % 3]);
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
  const ReduceProblem problem{.charts = pieces,
                              .objective = goal_of(run.input.set.charts, cut, run.options),
                              .gap = gap,
                              .box_aspect = run.options.box_aspect,
                              .pe_target = run.options.pe_bound,
                              .enough_distortion = enough,
                              .least_change = 0,
                              .negligible = least_change,
                              .max_distortion = run.options.max_distortion.value_or(0),
                              .threads = run.threads};
  ReduceResult reduced = reduce_distortion(
      problem, [&](const ReduceProgress& progress) { run.monitor.report(1 - 1 / (1 + 0.1 * progress.iteration), progress.pe); });
  run.journal.iterations += reduced.iterations;
  cut = with_uvs(std::move(cut), reduced.uvs);
  return reduced;
}

/// Takes out the vertices that only served the deformation.
void restore(const std::vector<Chart>& charts, CutAtlas& cut) {
  const double scale = dirichlet_sums(meshes_of(cut)).best_scale();
  for (Piece& piece : cut.pieces) restore_faces(piece, charts[piece.chart], scale);
}

bool has_trails(const Layout& layout) {
  return std::any_of(layout.trails.begin(), layout.trails.end(), [](const auto& trails) { return !trails.empty(); });
}

/// The charts that are wanted cut and are not.
std::vector<int> charts_left_whole(const Refinement& run, const Layout& layout, const CutAtlas& cut) {
  std::vector<int> pieces(layout.trails.size(), 0), out;
  for (const Piece& piece : cut.pieces) ++pieces[piece.chart];
  for (int c = 0; c < static_cast<int>(pieces.size()); ++c) {
    if (pieces[c] == 1 && !layout.trails[c].empty()) out.push_back(run.input.set.charts[c].number);
  }
  return out;
}

/// Parts of charts that overlap themselves may do so too. They keep their area.
void embed_pieces(const Refinement& run, CutAtlas& cut, std::vector<int>& embedded) {
  for (Piece& piece : cut.pieces) {
    if (certify_charts({piece.mesh}).valid()) continue;
    const int number = run.input.set.charts[piece.chart].number;
    const double area = uv_area(piece.mesh);
    piece.mesh = re_embed(piece.mesh, number, run.threads, run.monitor);
    const double scale = std::sqrt(area / uv_area(piece.mesh));
    for (Vec2& uv : piece.mesh.uvs) uv *= scale;
    if (embedded.empty() || embedded.back() != piece.chart)
      run.journal.repairs.push_back({.what = "a part overlapped or touched itself, embedded anew", .charts = {number}});
    embedded.push_back(piece.chart);
  }
}

/// What is known before the cuts.
struct CutPlan {
  std::vector<Chart> charts;  ///< free of flips, at their wanted densities
  std::vector<SidePrices> prices;
  AlignedCharts aligned;
  Layout layout;
  std::vector<int> embedded;  ///< charts
  double enough = 0;          ///< the objective where the paper stops, 0 = at the optimum
};

CutPlan plan_cuts(const Refinement& run, const ProgressRange& range) {
  const RefineOptions& options = run.options;
  CutPlan plan{.charts = run.input.set.charts};
  run.journal.begin_stage("embed", range.part(0, 0.07));
  embed_broken_polygons(run, plan.charts, plan.embedded);
  set_density(plan.charts, wanted_density(run.input.set.charts, options.density), options.density);
  if (options.rectangles.until_input) plan.enough = energy_of_input(run, plan.charts);

  run.journal.begin_stage("align", range.part(0.07, 0.78));  // section 3.1
  plan.prices = price_sides(run.input.atlas, run.input.set, options);
  plan.aligned = align(run, plan.prices, plan.charts, plan.embedded);

  run.journal.begin_stage("layout", range.part(0.78, 1));  // section 3.2
  plan.layout = search_layout(plan.aligned, plan.charts, layout_options(run), run.monitor);
  return plan;
}

/// Faces are divided where trails cross them; pieces are rectangles.
Attempt cut_across_faces(const Refinement& run, CutPlan plan, const ProgressRange& range) {
  const auto& [charts, prices, aligned, layout, embedded, enough] = plan;
  Solution out{.intervention = Intervention::Cut, .atlas = cut_along_trails(run, aligned, charts, layout)};
  if (out.atlas.seams.empty()) return {.needless = true};
  place(run, layout, out.atlas);
  const Validity start = certify_charts(meshes_of(out.atlas));
  if (!start.valid()) return {.failure = "in their layout " + start.problem};

  run.journal.begin_stage("reduce", range);  // section 3.3
  Gap wide = layout.gap;
  wide.value *= kFirstGap;
  ReduceResult reduced = reduce(run, wide, kFirstChange, enough, out.atlas);
  if (reduced.reached && reduced.within_limit) {
    restore(charts, out.atlas);
    reduced = reduce(run, layout.gap, kLastChange, enough, out.atlas);
  }
  if (!reduced.within_limit) return {.failure = "cut, their distortion stays above the largest allowed"};
  if (!reduced.reached) return {.failure = "cut, they do not reach the bound"};
  out.gap = layout.gap;
  out.ended = ended_of(reduced.status);
  out.price = reduced.price;
  out.re_embedded = embedded;
  out.rectangles = report_of(aligned, layout);
  tell(run, aligned, layout, *out.rectangles);
  if (const int cut = forbidden_edges_cut(charts, prices, out.atlas); cut > 0)
    run.journal.warnings.push_back("cuts run along or across " + std::to_string(cut) + (cut == 1 ? " edge" : " edges") +
                                   " where no seam is wanted");
  return {.solution = std::move(out)};
}

/// Cut along the edges of polygons; no face is divided. Differs from section 4.1: parts keep the shapes that they have in the
/// input's UVs instead of becoming rectangles, and are packed by their outlines.
Attempt cut_along_edges(const Refinement& run, CutPlan plan, const ProgressRange& range) {
  const auto paths =
      edge_paths(plan.aligned, plan.charts, trace_trails(plan.aligned, plan.layout.trails), plan.prices, run.threads);
  if (paths.empty()) return {.needless = !has_trails(plan.layout), .failure = "along edges no more than slivers can be cut off"};
  CutAtlas cut = cut_along(whole_atlas(plan.charts), plan.charts, paths);
  embed_pieces(run, cut, plan.embedded);
  RefineOptions options = run.options;
  options.relax = options.relax || !options.rectangles.until_input;
  Solution out = place_and_squeeze({run.input, options, run.monitor, run.journal, run.threads}, cut, false, range);
  if (!holds_bound(run, meshes_of(out.atlas))) return {.failure = "cut along edges, they do not reach the bound"};
  out.intervention = Intervention::Cut;
  out.re_embedded = std::move(plan.embedded);
  out.rectangles = report_of(plan.aligned, plan.layout);
  out.rectangles->holes_cut = 0;
  if (const std::vector<int> whole = charts_left_whole(run, plan.layout, cut); !whole.empty())
    run.journal.fallbacks.push_back(charts_named(whole) + ": along edges no more than slivers can be cut off; left whole");
  return {.solution = std::move(out)};
}

}  // namespace

Attempt refine_by_rectangles(const Refinement& run, const ProgressRange& range) {
  CutPlan plan = plan_cuts(run, range.part(0, 0.45));
  if (run.journal.draws()) {
    for (const auto& picture : rectangle_pictures(plan.charts, plan.aligned, plan.layout.trails, run.options.rectangles.sigma))
      run.journal.show(picture);
  }
  const bool along_edges = run.options.cut == Cut::Edges;
  return (along_edges ? cut_along_edges : cut_across_faces)(run, std::move(plan), range.part(0.45, 1));
}

}  // namespace atlas_refine
