// The squeeze: all starts and gaps on coarse charts, only the best of them on the fine ones.
#include <algorithm>
#include <cmath>
#include <utility>

#include "coarsen/coarse_atlas.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "reduce/squeeze.h"

namespace atlas_refine {
namespace {

// What slides slowly slides on the coarse charts, where that costs little: fine ones would stop short of it.
constexpr double kLeastChange = 2e-5;
constexpr double kNegligible = 2e-7;

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

/// The best result goes on on the coarse charts, with patience: which one is best is clear before.
void slide(const CoarseAtlas& coarse, const PlacedCharts& start, const SqueezeOptions& options, Squeezed& out, Monitor& monitor) {
  if (start.charts.size() >= kThousands) return;  // that takes as long as all the rest, for 1e-4 of E_d
  const PlacedCharts end = with_uvs_of(start, out.outcome);
  ReduceProblem problem = problem_at(end, coarse.objective, out.gap, options);
  problem.warm = out.outcome.end;
  problem.least_change = kLeastChange;
  problem.negligible = kNegligible;
  ReduceResult result = reduce_distortion(problem, [&](const ReduceProgress& progress) {
    monitor.report(0.96, progress.pe);
    return !monitor.finishing();
  });
  out.iterations += result.iterations;
  if (result.holds() && result.energy <= out.outcome.energy) out.outcome = std::move(result);
}

/// The charts from where the coarse ones have ended; nothing where they cannot go on from there.
std::optional<Squeezed> squeeze_finely(const CoarseAtlas& coarse, const std::vector<Chart>& charts, const Objective& objective,
                                       Squeezed out, const SqueezeOptions& options, Monitor& monitor) {
  const auto start = carried_over(coarse, charts, objective, out.outcome);
  if (!start) return std::nullopt;
  ReduceResult result = squeeze_on(*start, objective, out.gap, warm_start(coarse, charts, out.outcome.end), options, monitor);
  const bool stopped = result.status == ReduceStatus::Stopped;  // with no time for a direct squeeze
  if (!result.holds() && !stopped) return std::nullopt;
  // Borders that turned to face each other on the way may have come nearer than those of a direct squeeze do, which has lost
  // nearly as much itself.
  constexpr double kNearer = 0.75;
  const PlacedCharts end = with_uvs_of(*start, result);
  const Box box = uv_box(end.charts);
  const double gap = out.gap.length(end.has_frame() ? end.frame : box.size()) / box.diagonal();
  if (!stopped && gap_within(end.charts, kNearer * gap) < kNearer * gap_within(charts, gap)) return std::nullopt;
  out.iterations += result.iterations;
  out.rough_energy = out.outcome.energy;
  out.outcome = std::move(result);
  return out;
}

std::optional<Squeezed> squeeze_coarsely(const std::vector<PlacedCharts>& starts, const Objective& objective,
                                         const SqueezeOptions& options, Monitor& monitor) {
  const std::vector<Chart>& charts = starts.front().charts;
  const auto coarse = coarsen(charts, objective, options.freedom);
  if (!coarse) return std::nullopt;
  const std::vector<PlacedCharts> rough = restricted(*coarse, starts);
  Squeezed out = squeeze_directly(rough, coarse->objective, options, monitor);
  if (!out.outcome.holds() && !monitor.finishing()) return std::nullopt;
  if (out.outcome.holds()) slide(*coarse, rough.front(), options, out, monitor);
  return squeeze_finely(*coarse, charts, objective, std::move(out), options, monitor);
}

/// Of a triangle with this energy whose area is as it should be.
double stretch_of(double energy) { return std::sqrt(energy + std::sqrt(std::max(0.0, energy * energy - 1))); }

Forecast forecast_of(const std::vector<Chart>& charts, const std::optional<CoarseAtlas>& coarse, const Objective& objective,
                     Squeezed squeezed) {
  Forecast out{.end = std::move(squeezed)};
  const ReduceResult& end = out.end.outcome;
  std::vector<StretchedArea> stretched;
  std::size_t element = 0;
  for (int c = 0; c < static_cast<int>(charts.size()); ++c) {
    const bool is_coarse = coarse && coarse->charts[c];
    const Chart& mesh = is_coarse ? coarse->charts[c]->mesh : charts[c];
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      std::array<int, 3> corners = mesh.triangles[t];
      if (is_coarse) {
        for (int& v : corners) v = coarse->charts[c]->kept[v];
      }
      const double weight = objective.weight[element + t], energy = end.triangle_energy[c][t];
      out.losses.push_back({c, corners, weight * (energy - 1)});
      stretched.push_back({stretch_of(energy), weight});
    }
    element += mesh.triangles.size() + mesh.guards.size();
  }
  if (!stretched.empty()) out.stretch = stretch_99(std::move(stretched));
  return out;
}

/// What a forecast may take: cuts that leave charts jammed for longer are not those that pay.
SqueezeOptions briefly(SqueezeOptions options) {
  constexpr int kForecastIterations = 150;
  options.max_iterations = kForecastIterations;
  return options;
}

Squeezed squeeze_once(const std::vector<PlacedCharts>& starts, const Objective& objective, const SqueezeOptions& options,
                      Monitor& monitor) {
  // Under a limit of distortion charts hold their PE until they have relaxed: that is for the fine ones to find out.
  if (!options.limits.any()) {
    if (auto out = squeeze_coarsely(starts, objective, options, monitor)) return std::move(*out);
  }
  return squeeze_directly(starts, objective, options, monitor);
}

/// Those of the charts that bent only move from now on; how many these are.
int hold(const std::vector<int>& charts, Freedoms& freedom) {
  int count = 0;
  for (const int c : charts) count += std::exchange(freedom[c], Freedom::Moves) == Freedom::Bends;
  return count;
}

}  // namespace

Squeezed squeeze(const std::vector<PlacedCharts>& starts, const Objective& objective, const SqueezeOptions& options,
                 Monitor& monitor) {
  constexpr int kMostTimes = 8;  // others grow then: of 28 atlases of stiff pipes six took twice, one three times, one four
  Squeezed best = squeeze_once(starts, objective, options, monitor);
  SqueezeOptions holding = options;
  holding.freedom.resize(starts.front().charts.size(), Freedom::Bends);
  int iterations = best.iterations;
  std::vector<int> outgrown = best.outcome.outgrown;
  for (int k = 0, held = 0; k < kMostTimes && !best.outcome.holds(); ++k) {
    const int more = hold(outgrown, holding.freedom);
    if (more == 0 || none_bends(holding.freedom) || monitor.finishing()) break;
    held += more;
    Squeezed next = squeeze_once(starts, objective, holding, monitor);
    iterations += next.iterations;
    outgrown = next.outcome.outgrown;
    if (!is_better(next.outcome, best.outcome)) continue;
    best = std::move(next);
    best.held = held;
  }
  best.iterations = iterations;
  return best;
}

ReduceResult squeeze_on(const PlacedCharts& start, const Objective& objective, const Gap& gap, const WarmStart& warm,
                        const SqueezeOptions& options, Monitor& monitor) {
  ReduceProblem problem = problem_at(start, objective, gap, options);
  problem.warm = warm;
  problem.negligible = options.negligible;
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

Forecast forecast_squeeze(const std::vector<Chart>& charts, const Objective& objective, const Placer& place,
                          const SqueezeOptions& options, Monitor& monitor) {
  const auto coarse = coarsen(charts, objective, options.freedom);
  const Objective& own = coarse ? coarse->objective : objective;
  const PlacedCharts rough = coarse ? restricted(*coarse, {.charts = charts}) : PlacedCharts{.charts = charts};
  const PlacedCharts start = place(rough.charts, own);
  return forecast_of(charts, coarse, own, squeeze_directly({start}, own, briefly(options), monitor));
}

std::optional<Squeezed> squeeze_as_forecast(const std::vector<Chart>& charts, const Objective& objective,
                                            const Forecast& forecast, const SqueezeOptions& options, Monitor& monitor) {
  if (!forecast.end.outcome.holds()) return std::nullopt;
  const auto coarse = coarsen(charts, objective, options.freedom);
  if (!coarse) return forecast.end;
  return squeeze_finely(*coarse, charts, objective, forecast.end, options, monitor);
}

Forecast forecast_squeeze_on(const PlacedCharts& start, const Objective& objective, const Gap& gap, const WarmStart& warm,
                             const SqueezeOptions& options, Monitor& monitor) {
  const auto coarse = coarsen(start.charts, objective, options.freedom);
  const Objective& own = coarse ? coarse->objective : objective;
  const PlacedCharts rough = coarse ? restricted(*coarse, start) : start;
  return forecast_of(start.charts, coarse, own,
                     {.gap = gap, .outcome = squeeze_on(rough, own, gap, warm, briefly(options), monitor)});
}

}  // namespace atlas_refine
