// The squeeze: all starts and gaps on coarse charts, only the best of them on the fine ones.
#include "reduce/coarse_to_fine.h"

#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "coarsen/coarse_atlas.h"
#include "reduce/squeeze.h"

namespace atlas_refine {
namespace {

constexpr double kCoarseChange = 2e-3;
constexpr double kCoarseNegligible = 1e-6;
static double env(const char* n, double d) {
  const char* s = getenv(n);
  return s ? atof(s) : d;
}
static double now() { return double(clock()) / CLOCKS_PER_SEC; }

bool holds(const ReduceResult& result) { return result.reached && result.within_limit; }

/// The fine charts from where the coarse ones have ended.
std::optional<std::vector<Chart>> carried_over(const CoarseAtlas& coarse, std::vector<Chart> charts, const Objective& objective,
                                               const std::vector<std::vector<Vec2>>& coarse_uvs) {
  auto uvs = prolonged(coarse, charts, objective, coarse_uvs);
  if (!uvs) return std::nullopt;
  for (std::size_t c = 0; c < charts.size(); ++c) charts[c].uvs = std::move((*uvs)[c]);
  return charts;
}

std::optional<ReduceResult> polish(const std::vector<Chart>& start, const Objective& objective, const Squeezed& squeezed,
                                   const SqueezeOptions& options, Monitor& monitor) {
  const ReduceProblem problem{.charts = start,
                              .objective = objective,
                              .gap = squeezed.gap,
                              .box_aspect = options.box_aspect,
                              .pe_target = options.pe_bound,
                              .threads = options.threads,
                              .freedom = options.freedom,
                              .frame = squeezed.outcome.frame,
                              .warm = squeezed.outcome.end};
  ReduceResult result = reduce_distortion(problem, [&](const ReduceProgress& progress) {
    monitor.report(0.97, progress.pe);
    if (getenv("CTRACE"))
      fprintf(stderr, "  pol %d pe %.6f E %.7f price %.4f frac %.3f\n", progress.iteration, progress.pe, progress.energy,
              progress.price, progress.fraction);
  });
  if (getenv("CTRACE"))
    fprintf(stderr, "CTF polish its %d reached %d E %.6f first %.6f status %d t %.3f\n", result.iterations, result.reached,
            result.energy, result.first_energy, (int)result.status, now());
  if (!holds(result)) return std::nullopt;
  return result;
}

std::optional<Squeezed> squeeze_coarsely(const std::vector<PlacedCharts>& starts, const Objective& objective,
                                         const SqueezeOptions& options, Monitor& monitor) {
  const std::vector<Chart>& charts = starts.front().charts;
  const double t0 = now();
  const auto coarse = coarsen(charts, objective, options.freedom);
  if (!coarse) return std::nullopt;
  std::vector<PlacedCharts> coarse_starts;
  for (const PlacedCharts& start : starts) coarse_starts.push_back(restricted(*coarse, start));
  const double t1 = now();
  Squeezed out = squeeze_directly(coarse_starts, coarse->objective, options, monitor);
  if (getenv("CTRACE"))
    fprintf(stderr, "CTF mesh %.3f coarse its %d reached %d E %.6f gap %g t %.3f\n", t1 - t0, out.iterations, out.outcome.reached,
            out.outcome.energy, out.gap.value, now() - t1);
  if (!holds(out.outcome)) return std::nullopt;
  const auto start = carried_over(*coarse, charts, objective, out.outcome.uvs);
  if (!start) return std::nullopt;
  auto result = polish(*start, objective, out, options, monitor);
  if (!result) return std::nullopt;
  out.iterations += result->iterations;
  out.outcome = std::move(*result);
  return out;
}

}  // namespace

std::optional<std::vector<Chart>> reduced_coarsely(const ReduceProblem& problem, const ReduceMonitor& monitor) {
  if (getenv("NOCTF")) return std::nullopt;
  const Objective objective = problem.objective ? *problem.objective : make_objective(problem.charts);
  const double t0 = now();
  const auto coarse = coarsen(problem.charts, objective, problem.freedom);
  if (!coarse) return std::nullopt;
  const std::vector<Chart> start = restricted(*coarse, {problem.charts}).charts;
  const ReduceProblem roughly{.charts = start,
                              .objective = coarse->objective,
                              .gap = problem.gap,
                              .least_change = env("ECHANGE", kCoarseChange),
                              .negligible = env("ENEG", kCoarseNegligible),
                              .threads = problem.threads,
                              .freedom = problem.freedom};
  const double t1 = now();
  const ReduceResult result = reduce_distortion(roughly, monitor);
  if (!(result.energy < result.first_energy)) return std::nullopt;
  auto out = carried_over(*coarse, problem.charts, objective, result.uvs);
  if (getenv("CTRACE"))
    fprintf(stderr, "CTE mesh %.3f its %d first %.4f E %.5f t %.3f carried %d status %d tris %zu\n", t1 - t0, result.iterations,
            result.first_energy, result.energy, now() - t1, (int)out.has_value(), (int)result.status, start[0].triangles.size());
  return out;
}

Squeezed squeeze(const std::vector<PlacedCharts>& starts, const Objective& objective, const SqueezeOptions& options,
                 Monitor& monitor) {
  // Under a limit of distortion charts hold their PE until they have relaxed: that is for the fine ones to find out.
  if (options.max_distortion == 0 && !getenv("NOCTF")) {
    if (auto out = squeeze_coarsely(starts, objective, options, monitor)) return std::move(*out);
  }
  return squeeze_directly(starts, objective, options, monitor);
}

}  // namespace atlas_refine
