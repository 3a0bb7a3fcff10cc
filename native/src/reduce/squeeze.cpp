// Starts in parallel, gaps in sequence.
#include "reduce/squeeze.h"

#include <algorithm>
#include <cmath>

#include "support/parallel.h"

namespace atlas_refine {
namespace {

ReduceResult reduce_from(const std::vector<Chart>& start, const Gap& gap, const SqueezeOptions& options, int threads,
                         Monitor& monitor) {
  double first_pe = 0;
  const ReduceProblem problem{.charts = start,
                              .gap = gap,
                              .box_aspect = options.box_aspect,
                              .pe_target = options.pe_bound,
                              .max_distortion = options.max_distortion,
                              .max_price = gap.value == options.gaps.back().value ? 0 : options.max_price,
                              .threads = threads};
  return reduce_distortion(problem, [&](const ReduceProgress& progress) {
    if (progress.iteration == 0) first_pe = progress.pe;
    const double way = std::log(options.pe_bound / std::min(first_pe, 0.999 * options.pe_bound));
    monitor.report(0.95 * (1 - std::log(options.pe_bound / std::min(progress.pe, options.pe_bound)) / way), progress.pe);
  });
}

bool better(const ReduceResult& a, const ReduceResult& b) {
  if (a.reached != b.reached) return a.reached;
  return a.reached ? a.energy < b.energy : a.pe > b.pe;
}

}  // namespace

Squeezed squeeze(const std::vector<std::vector<Chart>>& starts, const SqueezeOptions& options, Monitor& monitor) {
  Squeezed out;
  std::vector<std::vector<Chart>> present = starts;
  for (const Gap& gap : options.gaps) {
    const int count = static_cast<int>(present.size());
    std::vector<ReduceResult> results(count);
    const int inner = std::max(1, options.threads / count);
    parallel_ranges(count, options.threads, 1, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) results[k] = reduce_from(present[k], gap, options, inner, monitor);
    });
    int best = 0;
    for (int k = 0; k < count; ++k) {
      out.iterations += results[k].iterations;
      if (better(results[k], results[best])) best = k;
    }
    out.gap = gap;
    out.charts = present[best];
    for (std::size_t c = 0; c < out.charts.size(); ++c) out.charts[c].uvs = results[best].uvs[c];
    out.outcome = std::move(results[best]);
    if (out.outcome.reached || out.outcome.status == ReduceStatus::TooDistorted) break;
    present = {out.charts};
  }
  return out;
}

}  // namespace atlas_refine
