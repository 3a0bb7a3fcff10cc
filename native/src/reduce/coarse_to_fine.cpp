// The squeeze: all starts and gaps on coarse charts, only the best of them on the fine ones.
#include <algorithm>

#include "coarsen/coarse_atlas.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "reduce/squeeze.h"

namespace atlas_refine {
namespace {

// What slides slowly slides on the coarse charts, where that costs little: fine ones would stop short of it.
constexpr double kLeastChange = 2e-5;
constexpr double kNegligible = 1e-9;

/// The fine charts from where the coarse ones have ended.
std::optional<PlacedCharts> carried_over(const CoarseAtlas& coarse, std::vector<Chart> charts, const Objective& objective,
                                         const ReduceResult& end) {
  auto uvs = prolonged(coarse, charts, objective, end.uvs);
  if (!uvs) return std::nullopt;
  for (std::size_t c = 0; c < charts.size(); ++c) charts[c].uvs = std::move((*uvs)[c]);
  return PlacedCharts{.charts = std::move(charts), .frame = end.frame};
}

/// The end of the coarse charts, told by the fine ones' vertices.
WarmStart warm_start(const CoarseAtlas& coarse, const std::vector<Chart>& charts, WarmStart end) {
  std::vector<int> fine;  // of each coarse vertex
  int first = 0;
  for (std::size_t c = 0; c < charts.size(); ++c) {
    const int count = coarse.charts[c] ? static_cast<int>(coarse.charts[c]->kept.size()) : charts[c].vertex_count();
    for (int v = 0; v < count; ++v) fine.push_back(first + (coarse.charts[c] ? coarse.charts[c]->kept[v] : v));
    first += charts[c].vertex_count();
  }
  for (NearBorder& near : end.near_borders) near = {fine[near.vertex], fine[near.edge], near.floor};
  return end;
}

std::vector<PlacedCharts> restricted(const CoarseAtlas& coarse, const std::vector<PlacedCharts>& starts) {
  std::vector<PlacedCharts> out;
  for (const PlacedCharts& start : starts) out.push_back(restricted(coarse, start));
  return out;
}

/// The gap within charts as a fraction of their box' diagonal, at most `most`.
double gap_within(const std::vector<Chart>& charts, double most) {
  return std::min(most, gap_within(charts, dirichlet_sums(charts).best_scale(), most));
}

std::optional<Squeezed> squeeze_coarsely(const std::vector<PlacedCharts>& starts, const Objective& objective,
                                         const SqueezeOptions& options, Monitor& monitor) {
  const std::vector<Chart>& charts = starts.front().charts;
  const auto coarse = coarsen(charts, objective, options.freedom);
  if (!coarse) return std::nullopt;
  SqueezeOptions patiently = options;
  patiently.least_change = kLeastChange;
  patiently.negligible = kNegligible;
  Squeezed out = squeeze_directly(restricted(*coarse, starts), coarse->objective, patiently, monitor);
  if (!out.outcome.holds() && !monitor.finishing()) return std::nullopt;
  const auto start = carried_over(*coarse, charts, objective, out.outcome);
  if (!start) return std::nullopt;
  ReduceResult result = squeeze_on(*start, objective, out.gap, warm_start(*coarse, charts, out.outcome.end), options, monitor);
  const bool stopped = result.status == ReduceStatus::Stopped;  // with no time for a direct squeeze
  if (!result.holds() && !stopped) return std::nullopt;
  // Borders that turned to face each other on the way may have come nearer than those of a direct squeeze do.
  constexpr double kNearer = 0.8;
  const PlacedCharts end = with_uvs_of(*start, result);
  const Box box = uv_box(end.charts);
  const double gap = out.gap.length(end.has_frame() ? end.frame : box.size()) / box.diagonal();
  if (!stopped && gap_within(end.charts, kNearer * gap) < kNearer * gap_within(charts, gap)) return std::nullopt;
  out.iterations += result.iterations;
  out.outcome = std::move(result);
  return out;
}

}  // namespace

Squeezed squeeze(const std::vector<PlacedCharts>& starts, const Objective& objective, const SqueezeOptions& options,
                 Monitor& monitor) {
  // Under a limit of distortion charts hold their PE until they have relaxed: that is for the fine ones to find out.
  if (options.max_distortion == 0) {
    if (auto out = squeeze_coarsely(starts, objective, options, monitor)) return std::move(*out);
  }
  return squeeze_directly(starts, objective, options, monitor);
}

ReduceResult squeeze_on(const PlacedCharts& start, const Objective& objective, const Gap& gap, const WarmStart& warm,
                        const SqueezeOptions& options, Monitor& monitor) {
  ReduceProblem problem = problem_at(start, objective, gap, options);
  problem.warm = warm;
  return reduce_distortion(problem, [&](const ReduceProgress& progress) {
    monitor.report(0.97, progress.pe);
    return !monitor.finishing();
  });
}

std::optional<Squeezed> squeeze_coarse_charts(const std::vector<PlacedCharts>& starts, const Objective& objective,
                                              const SqueezeOptions& options, Monitor& monitor) {
  const auto coarse = coarsen(starts.front().charts, objective, options.freedom);
  if (!coarse) return std::nullopt;
  return squeeze_directly(restricted(*coarse, starts), coarse->objective, options, monitor);
}

Squeezed forecast_squeeze(const std::vector<PlacedCharts>& starts, const Objective& objective, const SqueezeOptions& options,
                          Monitor& monitor) {
  auto coarse = squeeze_coarse_charts(starts, objective, options, monitor);
  return coarse ? std::move(*coarse) : squeeze_directly(starts, objective, options, monitor);
}

ReduceResult forecast_squeeze_on(const PlacedCharts& start, const Objective& objective, const Gap& gap, const WarmStart& warm,
                                 const SqueezeOptions& options, Monitor& monitor) {
  const auto coarse = coarsen(start.charts, objective, options.freedom);
  if (!coarse) return squeeze_on(start, objective, gap, warm, options, monitor);
  return squeeze_on(restricted(*coarse, start), coarse->objective, gap, warm, options, monitor);
}

}  // namespace atlas_refine
