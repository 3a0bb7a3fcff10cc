// Repair, alignment, layout.
#include "cut_plan.h"

#include <algorithm>
#include <cmath>

#include "input/price_sides.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "pack/place_charts.h"
#include "reduce/goal.h"
#include "reduce/reduce.h"
#include "report/locked.h"
#include "report/note_repairs.h"

namespace atlas_refine {
namespace {

constexpr double kGapStep = 0.6;
constexpr int kGapSteps = 3;  // smaller automatic gaps tried before extra corners

/// Charts may overlap themselves here, but every triangle must be positive.
RepairedCharts with_positive_triangles(const Refinement& run) {
  RepairOptions options = repair_options(run);
  options.may_overlap = true;
  return repair_charts(run.input.set.charts, options, run.monitor);
}

/// Charts that only move are packed by their bounding box: turned so that it is small.
void turn_kept(const Refinement& run, const Freedoms& freedom, std::vector<Chart>& charts) {
  const PlaceOptions options{.rotate = run.options.rotate, .align_axes = run.options.align_axes};
  for (std::size_t c = 0; c < charts.size(); ++c) {
    if (!bends(freedom, c) && !is_fixed(freedom, c) && needles_among({charts[c]}).empty())
      charts[c] = place_charts({charts[c]}, options, run.monitor).front();
  }
}

/// Axis-aligned charts at their wanted densities. Those that are left as they are lie in the layout as they are: they must not
/// overlap themselves.
void align(const Refinement& run, CutPlan& plan) {
  const AlignOptions options{run.options.rectangles.sigma, run.threads, plan.freedom, plan.prices};
  const std::vector<double> wanted = wanted_density(run.input.set.charts, run.options.density);
  plan.aligned = align_charts(plan.charts, options, run.monitor);
  for (int c = 0; c < static_cast<int>(plan.charts.size()); ++c) {
    const bool as_it_is = plan.aligned[c].way == AxisAlignedChart::Way::AsItIs;
    if (!as_it_is || !bends(plan.freedom, c) || certify_charts({plan.charts[c]}).valid()) continue;
    plan.charts[c] = made_valid(run, plan.charts[c]);
    plan.mended.push_back(c);
    set_density(plan.charts, wanted, run.options.density, plan.freedom);
    const AlignOptions alone{options.sigma, options.threads, {}, {plan.prices[c]}};
    plan.aligned[c] = std::move(align_charts({plan.charts[c]}, alone, run.monitor).front());
  }
  for (std::size_t c = 0; c < plan.aligned.size(); ++c) {
    for (Vec2& uv : plan.aligned[c].mesh.uvs) uv *= wanted[c];
  }
}

/// Locked charts are as large in the layout as they will be: all others together are to cover what the bound leaves them of the
/// texture.
void scale_fixed(const Refinement& run, CutPlan& plan) {
  if (!any_fixed(plan.freedom)) return;
  constexpr double kLeastShare = 0.01;
  const Box texture{Vec2::Zero(), Vec2(run.options.box_aspect, 1)};
  double taken = 0, others = 0;
  for (std::size_t c = 0; c < plan.charts.size(); ++c) {
    if (is_fixed(plan.freedom, c)) {
      taken += area_within(plan.charts[c], texture);
    } else {
      others += uv_area(plan.charts[c]);
    }
  }
  const double free = std::max(kLeastShare * texture.area(), run.options.pe_bound * texture.area() - taken);
  for (std::size_t c = 0; c < plan.charts.size(); ++c) {
    if (!is_fixed(plan.freedom, c)) continue;
    plan.aligned[c].mesh.uvs = plan.charts[c].uvs;
    for (Vec2& uv : plan.aligned[c].mesh.uvs) uv *= std::sqrt(others / free);
  }
}

/// The meshes' vertices told by those of the input's charts, no longer of `atlas`; a chart that was opened has more there.
void refer_to_input(const CutAtlas& atlas, std::vector<AxisAlignedChart>& aligned) {
  for (std::size_t c = 0; c < aligned.size(); ++c) {
    for (Support& support : aligned[c].mesh.supports) {
      for (int& v : support.vertices) v = v >= 0 ? atlas.pieces[c].vertices[v] : v;
    }
  }
}

/// What divided meshes are parts of: the charts, or the input's where one was opened.
std::vector<Chart> charts_before_opening(const Refinement& run, const CutAtlas& repaired, std::vector<Chart> charts) {
  for (const Seam& seam : repaired.seams) charts[seam.chart] = run.input.set.charts[seam.chart];
  return charts;
}

/// The objective of the charts as they come: where the paper stops.
double energy_of_input(const Refinement& run, const CutAtlas& repaired, const std::vector<Chart>& charts) {
  const Objective objective = goal_of(run.input.set.charts, repaired, run.options);
  const std::vector<Chart> start = charts;
  return reduce_distortion({.charts = start, .objective = &objective, .max_iterations = 0}).energy;
}

}  // namespace

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

CutPlan plan_cuts(const Refinement& run, const ProgressRange& range) {
  const RefineOptions& options = run.options;
  run.journal.begin_stage("repair", range.part(0, 0.07));
  RepairedCharts repaired = with_positive_triangles(run);
  CutPlan plan{.freedom = freedom_of(run.input.set, options), .mended = note_repairs(run, repaired)};
  plan.charts = meshes_of(repaired.atlas);
  set_density(plan.charts, wanted_density(run.input.set.charts, options.density), options.density, plan.freedom);
  if (options.rectangles.until_input) plan.enough = energy_of_input(run, repaired.atlas, plan.charts);

  run.journal.begin_stage("align", range.part(0.07, 0.78));  // section 3.1
  // Along edges parts are packed by their outlines, which turns them as is best.
  if (options.cut == Cut::Split) turn_kept(run, plan.freedom, plan.charts);
  plan.prices = price_sides(run.input.atlas, run.input.set, options);
  align(run, plan);
  scale_fixed(run, plan);
  plan.sources = charts_before_opening(run, repaired.atlas, plan.charts);
  plan.atlas = with_uvs(std::move(repaired.atlas), uvs_of(plan.charts));

  run.journal.begin_stage("layout", range.part(0.78, 1));  // section 3.2
  LayoutOptions layout = layout_options(run);
  if (options.cut == Cut::Split) layout.prices = plan.prices;  // along edges, paths beside the trails find their own way
  plan.others = search_layouts(plan.aligned, plan.charts, layout, run.monitor);
  plan.layout = std::move(plan.others.front());
  plan.others.erase(plan.others.begin());
  refer_to_input(plan.atlas, plan.aligned);
  return plan;
}

RectangleReport report_of(const CutPlan& plan) {
  RectangleReport report{.extra_corners = plan.layout.extra_corners, .packed_pe = plan.layout.pe};
  for (const AxisAlignedChart& chart : plan.aligned) {
    report.tutte_charts += chart.way == AxisAlignedChart::Way::Rectangle;
    report.boxed_charts += chart.way == AxisAlignedChart::Way::AsItIs;
    report.holes_cut += chart.holes_cut;
  }
  for (const auto& trails : plan.layout.trails) report.trails += static_cast<int>(trails.size());
  return report;
}

std::vector<int> uncut_charts(const CutPlan& plan) {
  std::vector<int> out;
  for (int c = 0; c < static_cast<int>(plan.aligned.size()); ++c) {
    if (plan.layout.trails[c].empty() && bends(plan.freedom, c)) out.push_back(c);
  }
  return out;
}

}  // namespace atlas_refine
