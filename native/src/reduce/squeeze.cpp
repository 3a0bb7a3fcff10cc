// Starts in parallel, gaps in sequence.
#include "reduce/squeeze.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "measure/distortion.h"
#include "reduce/schedule.h"
#include "support/parallel.h"

namespace atlas_refine {
namespace {

constexpr double kGapStep = 0.6;
constexpr int kGapSteps = 8;
// With several charts a smaller gap is tried where the objective has risen by more than this on the way to the bound,
constexpr double kNoticeable = 0.02;
constexpr double kMostRise = 0.06;  // at once where it has risen by more than this,
constexpr double kSpared = 0.25;    // and is kept where it spares this part of the distortion.
constexpr double kTrifle = 0.01;    // of PE, which is not worth a smaller gap where charts outgrow their densities all the same

ReduceResult reduce_from(const PlacedCharts& start, const Objective& objective, const Gap& gap, const SqueezeOptions& options,
                         int threads, Monitor& monitor) {
  double first_pe = 0;
  ReduceProblem problem = problem_at(start, objective, gap, options);
  problem.least_change = options.least_change;
  problem.negligible = options.negligible;
  problem.limits = options.limits;
  problem.max_rise = gap.value == options.gaps.back().value || start.charts.size() == 1 ? 0 : kMostRise;
  problem.threads = threads;
  return reduce_distortion(problem, [&](const ReduceProgress& progress) {
    if (progress.iteration == 0) first_pe = progress.pe;
    const double way = std::log(options.pe_bound / std::min(first_pe, 0.999 * options.pe_bound));
    monitor.report(0.95 * (1 - std::log(options.pe_bound / std::min(progress.pe, options.pe_bound)) / way), progress.pe);
    return !monitor.finishing();
  });
}

/// The next gap goes on from here, unless charts were crushed on the way.
bool usable(const ReduceResult& result) {
  constexpr double kCrushed = 1.2;
  return result.energy < kCrushed * std::max(1.0, result.first_energy);
}

/// True where a smaller gap is worth it.
bool spares(const ReduceResult& result, const ReduceResult& larger) {
  return result.holds() && result.energy - 1 < (1 - kSpared) * (larger.energy - 1);
}

/// Why a gap was given up.
std::string reason(const Gap& gap, ReduceStatus status) {
  char text[32];
  std::snprintf(text, sizeof text, "at %g ", gap.value);
  switch (status) {
    case ReduceStatus::TooExpensive:
      return std::string(text) + "the bound costs too much distortion";
    case ReduceStatus::TooDistorted:
      return std::string(text) + "a limit of distortion is exceeded";
    case ReduceStatus::OutOfTime:
      return std::string(text) + "the bound was not reached in time";
    default:
      return std::string(text) + "charts jam before the bound is reached";
  }
}

/// The best result of all starts at one gap.
ReduceResult best_at(const Gap& gap, const std::vector<PlacedCharts>& starts, const Objective& objective,
                     const SqueezeOptions& options, Monitor& monitor, int& iterations, int& best) {
  const int count = static_cast<int>(starts.size());
  std::vector<ReduceResult> results(count);
  const int inner = std::max(1, options.threads / count);
  parallel_ranges(count, options.threads, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) results[k] = reduce_from(starts[k], objective, gap, options, inner, monitor);
  });
  best = 0;
  for (int k = 0; k < count; ++k) {
    iterations += results[k].iterations;
    if (is_better(results[k], results[best])) best = k;
  }
  return std::move(results[best]);
}

}  // namespace

bool is_better(const ReduceResult& a, const ReduceResult& b) {
  if (a.within_limit != b.within_limit) return a.within_limit;
  if (!a.within_limit) return a.used_limits < b.used_limits;
  if (a.reached != b.reached) return a.reached;
  if (a.reached) return a.energy < b.energy;
  const double least = std::min(a.least_energy, b.least_energy);
  return worth_below_target(a.pe, a.energy, least) > worth_below_target(b.pe, b.energy, least);
}

std::vector<Gap> automatic_gaps(const std::vector<Chart>& charts, double pe_bound, double box_aspect, double fixed_share,
                                double most_taken) {
  constexpr double kLeastShare = 0.01;  // of the box, for the charts
  const double perimeter = uv_perimeter(charts);
  const double area = uv_area(charts);
  const Vec2 box = sides_of_area(area / std::max(kLeastShare, pe_bound - fixed_share), box_aspect);
  // Charts grown by half the gap must fit into the box grown likewise; corners add a circle's sectors at most.
  const auto leaves_room = [&](const Gap& gap) {
    const double g = gap.length(box);
    const double grown = area + 0.5 * g * perimeter + 0.25 * std::numbers::pi * g * g * static_cast<double>(charts.size());
    return grown + fixed_share * box.prod() <= (pe_bound + most_taken * (1 - pe_bound)) * (box.x() + g) * (box.y() + g);
  };
  std::vector<Gap> gaps;
  Gap gap;
  for (int k = 0; k <= kGapSteps; ++k, gap.value *= kGapStep) {
    if (k == kGapSteps || charts.size() == 1 || leaves_room(gap)) gaps.push_back(gap);
  }
  return gaps;
}

PlacedCharts with_uvs_of(PlacedCharts placed, const ReduceResult& result) {
  for (std::size_t c = 0; c < placed.charts.size(); ++c) placed.charts[c].uvs = result.uvs[c];
  placed.frame = result.frame;
  return placed;
}

Gap beyond_rounding(Gap gap, Stored stored) {
  // Of the box; single precision moves both charts by up to half a unit in the last place, on both axes.
  const double rounding = stored == Stored::Float32 ? 2e-7 : 1e-12;
  constexpr double kMost = 0.004;  // of the gap: starts are kStartGap of it apart
  gap.value += std::min(rounding, kMost * gap.value);
  return gap;
}

ReduceProblem problem_at(const PlacedCharts& start, const Objective& objective, const Gap& gap, const SqueezeOptions& options) {
  return {.charts = start.charts,
          .objective = &objective,
          .gap = beyond_rounding(gap, options.stored),
          .box_aspect = options.box_aspect,
          .pe_target = options.pe_bound,
          .wanted_areas = options.wanted_areas,
          .max_iterations = options.max_iterations,
          .threads = options.threads,
          .freedom = options.freedom,
          .frame = start.frame};
}

Squeezed squeeze_directly(const std::vector<PlacedCharts>& starts, const Objective& objective, const SqueezeOptions& options,
                          Monitor& monitor) {
  Squeezed out;
  std::string note = options.gaps.front().value < Gap{}.value ? kNoRoom : "";
  std::vector<PlacedCharts> present = starts;
  for (const Gap& gap : options.gaps) {
    int best = 0;
    ReduceResult result = best_at(gap, present, objective, options, monitor, out.iterations, best);
    const bool first = &gap == &options.gaps.front();
    const bool held = !first && out.outcome.holds();
    const bool outgrown = !result.outgrown.empty();
    // Room that a smaller gap leaves is room to grow into.
    const bool trifling = outgrown && !out.outcome.outgrown.empty() && result.pe < (1 + kTrifle) * out.outcome.pe;
    const bool done =
        result.holds() && (starts.front().charts.size() == 1 || result.energy <= (1 + kNoticeable) * result.least_energy);
    const std::string next_note = reason(gap, result.holds() ? ReduceStatus::TooExpensive : result.status);
    present = usable(result) ? std::vector<PlacedCharts>{with_uvs_of(present[best], result)} : starts;
    if (held && !spares(result, out.outcome)) break;
    if (first || (!trifling && is_better(result, out.outcome))) {
      out.gap = gap;
      out.gap_note = note;
      out.outcome = std::move(result);
    }
    if (done || monitor.finishing()) break;
    note = next_note;
  }
  return out;
}

}  // namespace atlas_refine
