// The squeeze from coarse to fine: all starts and gaps on coarse charts, only the best of them on the fine ones.
#include "coarsen/coarse_atlas.h"
#include "reduce/squeeze.h"
#include <cstdio>
#include <ctime>
#include <cstdlib>

namespace atlas_refine {
namespace {

// Coarse charts need not come nearer to their optimum than it is to the fine one:
constexpr double kCoarseChange = 2e-3;
constexpr double kCoarseNegligible = 1e-6;
static double env(const char* n, double d) { const char* s = getenv(n); return s ? atof(s) : d; }
static double now() { return double(clock()) / CLOCKS_PER_SEC; }

bool holds(const ReduceResult& result) { return result.reached && result.within_limit; }

/// The fine charts from where the coarse ones have ended.
std::optional<ReduceResult> polish(const std::vector<Chart>& charts, const Objective& objective, const CoarseAtlas& coarse,
                                   const Squeezed& squeezed, const SqueezeOptions& options, Monitor& monitor) {
  auto uvs = prolonged(coarse, charts, objective, squeezed.outcome.uvs);
  if (!uvs) return std::nullopt;
  std::vector<Chart> start = charts;
  for (std::size_t c = 0; c < start.size(); ++c) start[c].uvs = std::move((*uvs)[c]);
  const ReduceProblem problem{.charts = start,
                              .objective = objective,
                              .gap = squeezed.gap,
                              .box_aspect = options.box_aspect,
                              .pe_target = options.pe_bound,
                              .least_change = options.least_change,
                              .negligible = options.negligible,
                              .threads = options.threads,
                              .freedom = options.freedom,
                              .frame = squeezed.outcome.frame,
                              .warm = WarmStart{squeezed.outcome.box, squeezed.outcome.price}};
  ReduceResult result = reduce_distortion(problem, [&](const ReduceProgress& progress) { monitor.report(0.97, progress.pe); if (getenv("CTRACE")) fprintf(stderr, "  pol %d pe %.6f E %.7f price %.4f frac %.3f\n", progress.iteration, progress.pe, progress.energy, progress.price, progress.fraction);});
  fprintf(stderr, "CTF polish its %d reached %d E %.6f first %.6f status %d t %.3f\n", result.iterations, result.reached, result.energy, result.first_energy, (int)result.status, now());
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
  { size_t a = 0, b = 0; for (auto& c : charts) a += c.triangles.size(); for (auto& c : coarse_starts[0].charts) b += c.triangles.size();
  fprintf(stderr, "CTF tris %zu -> %zu t0 %.3f mesh %.3f\n", a, b, t0, now() - t0); }
  SqueezeOptions roughly = options;
  roughly.least_change = env("CCHANGE", kCoarseChange);
  roughly.negligible = env("CNEG", kCoarseNegligible);
  const double t1 = now();
  Squeezed out = squeeze_directly(coarse_starts, coarse->objective, roughly, monitor);
  fprintf(stderr, "CTF coarse its %d reached %d E %.6f gap %g t %.3f\n", out.iterations, out.outcome.reached, out.outcome.energy, out.gap.value, now() - t1);
  if (!holds(out.outcome)) return std::nullopt;
  auto result = polish(charts, objective, *coarse, out, options, monitor);
  if (!result) return std::nullopt;
  out.iterations += result->iterations;
  out.outcome = std::move(*result);
  return out;
}

}  // namespace

Squeezed squeeze(const std::vector<PlacedCharts>& starts, const Objective& objective, const SqueezeOptions& options,
                 Monitor& monitor) {
  // Under a limit of distortion charts hold their PE until they have relaxed: that is for the fine ones to find out.
  if (options.max_distortion == 0 && !getenv("NOCTF")) {
    if (auto out = squeeze_coarsely(starts, objective, options, monitor)) return std::move(*out);
  }
  return squeeze_directly(starts, objective, options, monitor);
}

}  // namespace atlas_refine
