// Rectangles, needed seams or whole charts, each certified; what is done where a road leads nowhere.
#include "take_road.h"

#include <algorithm>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "atlas_refine/error.h"
#include "needed/cut_as_needed.h"
#include "placing.h"
#include "rectangles.h"
#include "reduce/goal.h"
#include "report/locked.h"
#include "report/note_repairs.h"
#include "report/shortfall.h"
#include "report/texture.h"
#include "whole.h"

namespace atlas_refine {
namespace {

/// Where it is single precision that a chart has no result in, the others may have one without it. Instead of rectangles whole
/// charts are tried first.
CertifiedAtlas certified_or_unmended(const Refinement& run, const CutAtlas& atlas, const Gap& gap) {
  try {
    return certify(run.input, atlas, gap, run.asked);
  } catch (const RefineError& error) {
    const bool falls_back = run.options.seams == Seams::Rectangles && !atlas.seams.empty();
    if (error.code() != ErrorCode::NotCertified || falls_back) throw;
    UnmendedCharts lost;
    for (const int chart : charts_lost_to_rounding(run.input, atlas, run.asked))
      lost.charts.push_back({chart, "has faces that are too small to be stored with an area"});
    if (lost.charts.empty()) throw;
    throw lost;
  }
}

}  // namespace

Gap at_size(const InputAtlas& input, Gap packed) {
  packed.value /= input.spare;
  return packed;
}

CertifiedSolution certified(const Refinement& run, Solution solution, const ProgressRange& range) {
  run.journal.begin_stage("certify", range.part(0.96, 0.98));
  if (run.monitor.finishing()) solution.ended = Ended::Stopped;
  restore_shapes(run.input.set.charts, freedom_of(run.input.set, run.options), solution.atlas);
  // Of the whole texture, where the gap was that of the box within its border.
  solution.gap = at_size(run.input, border_of(run.asked) > 0 ? *run.asked.gap : solution.gap);
  CertifiedAtlas atlas = certified_or_unmended(run, solution.atlas, solution.gap);
  return {std::move(solution), std::move(atlas)};
}

namespace {

/// What the charts reach without cuts, if that is less than `most`; that they cannot be placed is no reason against the cuts.
std::optional<double> distortion_of_whole(const Refinement& run, double most) {
  try {
    return distortion_without_cuts(run, most);
  } catch (const RefineError& error) {
    if (error.code() == ErrorCode::Cancelled) throw;
    return std::nullopt;
  }
}

/// Where the charts would have been better off without cuts at the same bound, the warnings say so. Where the cuts have made them
/// worse than they came as well, they were made for nothing: returns that.
std::string compare_with_whole(const Refinement& run, const CertifiedSolution& cut, const ProgressRange& range) {
  constexpr double kWorthTelling = 1e-4;  // of E_d
  if (run.monitor.finishing()) return "";
  run.journal.begin_stage("compare", range.part(0.98, 1));
  const double own = cut.atlas.after.distortion;
  const auto whole = distortion_of_whole(run, own - kWorthTelling);
  if (!whole) return "";
  const std::string figures = "E_d " + number_text("%.4f", *whole) + " against " + number_text("%.4f", own);
  if (own > run.input.measures.distortion + kWorthTelling)
    return "cut, they are more distorted than they came, and than they are whole: " + figures;
  run.journal.warnings.push_back("without cuts the charts hold the same bound with less distortion: " + figures);
  return "";
}
/// What the road of rectangles came to; without a solution charts are better left whole, which the journal says unless it is
/// `needless` to cut.
struct CutAttempt {
  std::optional<CertifiedSolution> solution = {};
  bool needless = false;
  std::vector<int> uncut = {};  ///< Attempt::uncut
};

CutAttempt solve_with_cuts(const Refinement& run, const ProgressRange& range) {
  Journal& journal = run.journal;
  const Journal::Mark before = journal.mark();
  std::string failure;
  CutAttempt out;
  try {
    Attempt attempt = refine_by_rectangles(run, range.part(0, 0.96));
    out.needless = attempt.needless;
    out.uncut = std::move(attempt.uncut);
    if (attempt.solution) {
      CertifiedSolution result = certified(run, std::move(*attempt.solution), range);
      if (!run.options.rectangles.until_input) failure = compare_with_whole(run, result, range);
      if (failure.empty()) {
        out.solution = std::move(result);
        return out;
      }
    } else {
      failure = attempt.failure;
    }
  } catch (const RefineError& error) {
    if (error.code() != ErrorCode::NotCertified) throw;
    failure = error.what();
  }
  journal.back_to(before);
  if (!out.needless) journal.fallbacks.push_back("charts were not cut into rectangles: " + failure);
  return out;
}

bool holds(const Refinement& run, const CertifiedSolution& result) {
  const Measures& after = result.atlas.after;
  return after.pe_fixed_aspect >= run.asked.pe_bound && within_limits(run.asked, after);
}

/// Whether cuts across these charts should be looked for: the bound or a limit is missed, or they have become worse than they
/// came.
bool have_lost(const Refinement& run, const CertifiedSolution& result, const std::vector<int>& charts) {
  constexpr double kLoss = 0.01;  // of E_d
  double area = 0, lost = 0;
  for (const ChartReport& chart : result.atlas.charts) area += chart.area;
  for (const int c : charts) {
    const ChartReport& chart = result.atlas.charts[c];
    lost += chart.area * std::max(0.0, chart.distortion_after - chart.distortion_before);
  }
  return !charts.empty() && (!holds(run, result) || lost > kLoss * area);
}

/// Charts that are cut across necks, where that is better.
std::optional<CertifiedSolution> cut_across_necks(const Refinement& run, const CertifiedSolution& present,
                                                  const ProgressRange& range) {
  const auto rank = [&](const CertifiedSolution& s) { return std::pair(!holds(run, s), s.atlas.after.distortion); };
  try {
    CertifiedSolution out = certified(run, cut_as_needed(run, range.part(0, 0.96)), range);
    if (out.solution.intervention == Intervention::Cut && rank(out) < rank(present)) return out;
  } catch (const RefineError& error) {
    if (error.code() == ErrorCode::Cancelled) throw;
  } catch (const UnmendedCharts&) {
    return std::nullopt;  // only whole they cannot be made valid
  }
  return std::nullopt;
}

CertifiedSolution solve_whole(const Refinement& run, const ProgressRange& range) {
  return certified(run, refine_whole(run, range.part(0, 0.96)), range);
}

/// Trails start at corners of charts that are aligned to the axes. Of those that have none the layout knows no cut, though there
/// may be necks.
CertifiedSolution solve_by_rectangles(const Refinement& run, const ProgressRange& range) {
  Journal& journal = run.journal;
  const Journal::Mark before = journal.mark();
  auto [best, needless, uncut] = solve_with_cuts(run, range);
  if (!best) {
    RefineOptions options = run.options;
    options.relax = goes_on(run, run.input.set.charts.size());  // also where charts are not cut
    best = solve_whole({run.input, options, run.monitor, journal, run.threads, run.asked}, range);
  }
  const bool lost = have_lost(run, *best, uncut);
  if (needless) journal.warnings.emplace_back(lost ? "no cuts were found that help" : "no chart needs a cut");
  if (!lost || run.monitor.finishing()) return std::move(*best);
  const auto told = std::tuple(journal.repairs, journal.fallbacks, journal.warnings);
  journal.back_to(before);
  if (auto other = cut_across_necks(run, *best, range)) {
    journal.fallbacks.emplace_back(
        "cut across necks, as with needed seams: aligned to the axes some charts have no corner to cut from");
    return std::move(*other);
  }
  std::tie(journal.repairs, journal.fallbacks, journal.warnings) = told;
  return std::move(*best);
}

CertifiedSolution solve(const Refinement& run, const ProgressRange& range) {
  switch (run.options.seams) {
    case Seams::Rectangles:
      return solve_by_rectangles(run, range);
    case Seams::Needed:
      return certified(run, cut_as_needed(run, range.part(0, 0.96)), range);
    case Seams::None:
      break;
  }
  return solve_whole(run, range);
}

}  // namespace

/// Most of the surface may lose stretch while E_d rises, and the other way round, so the engine is held back by a limit of
/// stretch only where the best without it is above.
CertifiedSolution take_road(const Refinement& run, const ProgressRange& range) {
  if (!run.options.max_stretch || run.options.seams == Seams::Needed) return solve(run, range);
  RefineOptions options = run.options;
  options.max_stretch.reset();
  const Journal::Mark before = run.journal.mark();
  const Refinement free{run.input, options, run.monitor, run.journal, run.threads, run.asked};
  CertifiedSolution result = solve(free, range.part(0, 0.5));
  if (within_limits(run.asked, result.atlas.after)) return result;
  run.journal.back_to(before);
  return solve(run, range.part(0.5, 1));
}

}  // namespace atlas_refine
