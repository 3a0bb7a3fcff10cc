// Charts are mended where they must be; then all are placed and squeezed.
#include "whole.h"

#include <utility>

#include "measure/certificate.h"
#include "place_and_squeeze.h"
#include "reduce/goal.h"
#include "report/locked.h"
#include "report/note_repairs.h"

namespace atlas_refine {

bool set_wanted_density(const Refinement& run, std::vector<Chart>& charts) {
  const Density density = run.options.density;
  return set_density(charts, wanted_density(run.input.set.charts, density), density, freedom_of(run.input.set, run.options));
}

namespace {

WholeCharts at_wanted_densities(const Refinement& run, RepairedCharts repaired) {
  WholeCharts out;
  std::vector<Chart> charts = meshes_of(repaired.atlas);
  const auto points = points_in_space(repaired.atlas, run.input.set.points);
  const bool own_is_valid = certify_charts(charts, points, freedom_of(run.input.set, run.options)).valid();
  const bool scaled = set_wanted_density(run, charts);
  out.atlas = with_uvs(std::move(repaired.atlas), uvs_of(charts));
  out.keeps_place = own_is_valid && !scaled;
  return out;
}

}  // namespace

WholeCharts whole_charts(const Refinement& run, const ProgressRange& range) {
  run.journal.begin_stage("repair", range);
  RepairedCharts repaired = repair_charts(run.input.set.charts, repair_options(run), run.monitor);
  std::vector<int> mended = note_repairs(run, repaired);
  WholeCharts out = at_wanted_densities(run, std::move(repaired));
  out.mended = std::move(mended);
  return out;
}

Solution refine_whole(const Refinement& run, const ProgressRange& range) {
  WholeCharts whole = whole_charts(run, range.part(0, 0.2));
  Solution out = place_and_squeeze(run, whole.atlas, whole.keeps_place, range.part(0.2, 1));
  out.re_embedded = std::move(whole.mended);
  return out;
}

std::optional<double> distortion_without_cuts(const Refinement& run, double most) {
  RepairedCharts repaired = repair_charts(run.input.set.charts, repair_options(run), run.monitor);
  if (!repaired.unmended.empty()) return std::nullopt;
  const WholeCharts whole = at_wanted_densities(run, std::move(repaired));
  return squeezed_distortion(run, whole.atlas, whole.keeps_place, most);
}

}  // namespace atlas_refine
