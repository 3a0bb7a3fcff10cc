// Repairs in words.
#include "report/note_repairs.h"

#include <algorithm>
#include <cmath>

#include "cut/open_closed.h"
#include "input/price_sides.h"
#include "measure/distortion.h"
#include "report/locked.h"

namespace atlas_refine {
namespace {

/// What seams cost where charts are opened, which is along edges whatever Cut says; nothing where all charts fit the plane.
std::vector<SidePrices> opening_prices(const Refinement& run) {
  const std::vector<Chart>& charts = run.input.set.charts;
  if (!run.options.open_closed || std::all_of(charts.begin(), charts.end(), fits_plane)) return {};
  RefineOptions along_edges = run.options;
  along_edges.cut = Cut::Edges;
  return price_sides(run.input.atlas, run.input.set, along_edges);
}

}  // namespace

RepairOptions repair_options(const Refinement& run) {
  return {.space_points = &run.input.set.points,
          .freedom = freedom_of(run.input.set, run.options),
          .open_closed = run.options.open_closed,
          .prices = opening_prices(run),
          .threads = run.threads};
}

std::vector<int> note_repairs(const Refinement& run, const RepairedCharts& repaired) {
  const auto number_of = [&](int chart) { return repaired.atlas.pieces[chart].mesh.number; };
  if (!repaired.unmended.empty()) {
    UnmendedCharts unmended;
    for (const UnmendedChart& chart : repaired.unmended) unmended.charts.push_back({number_of(chart.chart), chart.reason});
    throw unmended;
  }
  std::vector<int> changed;
  for (const ChartRepair& repair : repaired.repairs) {
    run.journal.repairs.push_back({.what = in_words(repair),
                                   .charts = {number_of(repair.chart)},
                                   .faces = repair.faces,
                                   .distortion_to_input = repair.distortion_to_input});
    changed.push_back(repair.chart);
  }
  return changed;
}

Chart made_valid(const Refinement& run, const Chart& chart) {
  const RepairOptions options{.open_closed = run.options.open_closed, .threads = run.threads};
  const RepairedCharts repaired = repair_charts({chart}, options, run.monitor);
  note_repairs(run, repaired);
  Chart out = repaired.atlas.pieces.front().mesh;
  const double scale = std::sqrt(uv_area(chart) / uv_area(out));
  for (Vec2& uv : out.uvs) uv *= scale;
  return out;
}

}  // namespace atlas_refine
