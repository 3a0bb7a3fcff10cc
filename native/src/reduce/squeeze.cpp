// Starts in parallel, gaps in sequence.
#include "reduce/squeeze.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "measure/distortion.h"
#include "support/parallel.h"

namespace atlas_refine {
namespace {

constexpr double kGapStep = 0.6;
constexpr int kGapSteps = 8;

ReduceResult reduce_from(const std::vector<Chart>& start, const Objective& objective, const Gap& gap,
                         const SqueezeOptions& options, int threads, Monitor& monitor) {
  double first_pe = 0;
  const ReduceProblem problem{.charts = start,
                              .objective = objective,
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
  if (a.within_limit != b.within_limit) return a.within_limit;
  if (!a.within_limit) return a.distortion < b.distortion;
  if (a.reached != b.reached) return a.reached;
  return a.reached ? a.energy < b.energy : a.pe > b.pe;
}

/// The next gap goes on from here, unless charts have been crushed on the way.
bool usable(const ReduceResult& result) {
  constexpr double kCrushed = 1.2;
  return result.energy < kCrushed;
}

std::vector<Chart> with_uvs_of(std::vector<Chart> charts, const ReduceResult& result) {
  for (std::size_t c = 0; c < charts.size(); ++c) charts[c].uvs = result.uvs[c];
  return charts;
}

const char* reason(ReduceStatus status) {
  switch (status) {
    case ReduceStatus::TooExpensive:
      return "a larger one costs too much distortion";
    case ReduceStatus::TooDistorted:
      return "a larger one exceeds the largest distortion allowed";
    case ReduceStatus::OutOfTime:
      return "with a larger one the bound was not reached in time";
    default:
      return "with a larger one charts jam before the bound is reached";
  }
}

}  // namespace

std::vector<Gap> automatic_gaps(const std::vector<Chart>& charts, double pe_bound, double box_aspect) {
  double perimeter = 0;
  for (const Chart& chart : charts) {
    for (const auto& loop : chart.boundary_loops) {
      for (std::size_t k = 0; k < loop.size(); ++k)
        perimeter += (chart.uvs[loop[(k + 1) % loop.size()]] - chart.uvs[loop[k]]).norm();
    }
  }
  const double area = uv_area(charts), height = std::sqrt(area / pe_bound / (box_aspect > 0 ? box_aspect : 1));
  const Vec2 box(height * (box_aspect > 0 ? box_aspect : 1), height);
  // Charts grown by half the gap must fit into the box grown likewise; corners add a circle's sectors at most.
  const auto leaves_room = [&](const Gap& gap) {
    const double g = gap.length(box);
    const double grown = area + 0.5 * g * perimeter + 0.25 * std::numbers::pi * g * g * static_cast<double>(charts.size());
    return grown <= (box.x() + g) * (box.y() + g);
  };
  std::vector<Gap> gaps;
  Gap gap;
  for (int k = 0; k <= kGapSteps; ++k, gap.value *= kGapStep) {
    if (k == kGapSteps || charts.size() == 1 || leaves_room(gap)) gaps.push_back(gap);
  }
  return gaps;
}

Squeezed squeeze(const std::vector<std::vector<Chart>>& starts, const Objective& objective, const SqueezeOptions& options,
                 Monitor& monitor) {
  Squeezed out;
  std::vector<std::vector<Chart>> present = starts;
  if (options.gaps.front().value < Gap{}.value) out.gap_note = "a larger one leaves the charts no room at the bound";
  for (const Gap& gap : options.gaps) {
    const int count = static_cast<int>(present.size());
    std::vector<ReduceResult> results(count);
    const int inner = std::max(1, options.threads / count);
    parallel_ranges(count, options.threads, 1, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) results[k] = reduce_from(present[k], objective, gap, options, inner, monitor);
    });
    int best = 0;
    for (int k = 0; k < count; ++k) {
      out.iterations += results[k].iterations;
      if (better(results[k], results[best])) best = k;
    }
    if (&gap != &options.gaps.front()) out.gap_note = reason(out.outcome.status);
    out.gap = gap;
    out.outcome = std::move(results[best]);
    const bool last = &gap == &options.gaps.back();
    const bool dear = !last && out.outcome.reached && options.max_price > 0 && out.outcome.price > options.max_price;
    if (dear) out.outcome.status = ReduceStatus::TooExpensive;
    if (out.outcome.reached && out.outcome.within_limit && !dear) break;
    present = usable(out.outcome) ? std::vector<std::vector<Chart>>{with_uvs_of(present[best], out.outcome)} : starts;
  }
  return out;
}

}  // namespace atlas_refine
