// Charts that overlap themselves are embedded anew; then all are placed and squeezed.
#include "whole.h"

#include "measure/certificate.h"
#include "place_and_squeeze.h"
#include "reduce/goal.h"
#include "repair/re_embed.h"

namespace atlas_refine {
namespace {

/// Charts that overlap themselves, or hold polygons that do, are embedded anew.
std::vector<int> embed_where_needed(const Refinement& run, std::vector<Chart>& charts) {
  std::vector<int> embedded;
  for (int c = 0; c < static_cast<int>(charts.size()); ++c) {
    run.monitor.report(static_cast<double>(c) / static_cast<double>(charts.size()));
    if (certify_charts({charts[c]}).valid()) continue;
    charts[c] = re_embed(charts[c], charts[c].number, run.threads, run.monitor);
    run.journal.repairs.push_back({.what = "overlapped or touched itself, embedded anew", .charts = {charts[c].number}});
    embedded.push_back(c);
  }
  return embedded;
}

/// True where the relative scales of the charts changed.
bool set_wanted_density(const Refinement& run, std::vector<Chart>& charts) {
  const Density density = run.options.density;
  return set_density(charts, wanted_density(run.input.set.charts, density), density);
}

}  // namespace

Solution refine_whole(const Refinement& run, const ProgressRange& range) {
  std::vector<Chart> charts = run.input.set.charts;
  run.journal.begin_stage("embed", range.part(0, 0.2));
  std::vector<int> embedded = embed_where_needed(run, charts);
  const bool own_is_valid = embedded.empty() && certify_charts(charts).valid();
  const bool scaled = set_wanted_density(run, charts);
  Solution out = place_and_squeeze(run, whole_atlas(charts), own_is_valid && !scaled, range.part(0.2, 1));
  out.re_embedded = std::move(embedded);
  return out;
}

std::optional<double> distortion_without_cuts(const Refinement& run, double most) {
  std::vector<Chart> charts = run.input.set.charts;
  for (const Chart& chart : charts) {
    if (!certify_charts({chart}).valid()) return std::nullopt;
  }
  const bool scaled = set_wanted_density(run, charts);
  return squeezed_distortion(run, whole_atlas(charts), !scaled && certify_charts(charts).valid(), most);
}

}  // namespace atlas_refine
