// The squeeze: charts bend inside a shrinking box until the bound holds; several starts, the best result wins.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reduce/reduce.h"
#include "support/monitor.h"

namespace atlas_refine {

struct SqueezeOptions {
  double pe_bound = 0.8;
  double box_aspect = 0;
  std::vector<Gap> gaps;                  ///< to be tried in this order: the asked one, then smaller ones where that is allowed
  DistortionLimits limits = {};           ///< of the surface
  std::vector<double> wanted_areas = {};  ///< ReduceProblem::wanted_areas
  int threads = 1;
  Freedoms freedom = {};       ///< of the charts; fixed ones need starts in a frame
  double least_change = 5e-4;  ///< ReduceProblem::least_change: the last 1e-5 of E_d took a third of all iterations
  double negligible = 1e-6;    ///< ReduceProblem::negligible
  int max_iterations = ReduceProblem::kMostIterations;  ///< of each reduction
  Stored stored = Stored::Double;
};

/// Within its limits, then at the bound, then of less objective, or worth more below the bound.
bool is_better(const ReduceResult& a, const ReduceResult& b);

/// What to aim at so that the gap is kept when the UVs are brought to their texture and stored: charts that only move jam at the
/// very gap they are given.
Gap beyond_rounding(Gap gap, Stored stored);

/// Why the first of automatic_gaps() may be smaller than the default.
inline constexpr const char* kNoRoom = "a larger one leaves the charts no room at the bound";

struct Squeezed {
  Gap gap;                  ///< that was kept
  ReduceResult outcome;     ///< the best result
  double rough_energy = 0;  ///< the objective that the coarse charts ended with, where there were such
  int iterations = 0;       ///< over all starts and gaps
  int held = 0;             ///< how many charts were only moved, as bent they outgrow the densities they keep
  std::string gap_note;     ///< why the gaps before it were given up, in words; empty for the first
};

/// The part of what the bound leaves free that gaps may take where charts have to bend: beyond it they jam, or pay for each
/// other's corners. Rectangles that are only moved may take all. Measured on ten atlases of 120 to 4740 charts at 0.8: up to 0.66
/// the gap was kept at a price below 0.6, from 0.75 on it was given up or cost 2 % of E_d and more.
inline constexpr double kMostTakenBent = 0.725;

/// The gaps that an automatic one may take: the default and smaller ones, down to a sixtieth. Those that the charts' borders
/// alone leave no room for at the bound are left out, but for the last: charts grown by half the gap would take more than
/// `most_taken` of what is free. `fixed_share` of the box is covered by other charts.
std::vector<Gap> automatic_gaps(const std::vector<Chart>& charts, double pe_bound, double box_aspect, double fixed_share = 0,
                                double most_taken = 1);

/// Where the result has them.
PlacedCharts with_uvs_of(PlacedCharts placed, const ReduceResult& result);

/// The bound asked of the engine from one start, which the problem refers to.
ReduceProblem problem_at(const PlacedCharts& start, const Objective& objective, const Gap& gap, const SqueezeOptions& options);

/// Reduces from every start (each free of flips, crossings and nearer charts than the first gap) and keeps the result of least
/// distortion that holds the bound. Where none does, or the bound costs much distortion with this gap, the next one is tried, and
/// kept where it spares a good part of that distortion; in the end, where none holds the bound, the state that is worth the most
/// below it is returned. Starts run in parallel; the choice is by the objective, ties by index. Once the monitor is finishing,
/// each start ends with the best state it has, and no further gap is tried.
Squeezed squeeze_directly(const std::vector<PlacedCharts>& starts, const Objective& objective, const SqueezeOptions& options,
                          Monitor& monitor);

/// The same, sooner where charts have many triangles: on coarse charts, whose best result the charts themselves then go on from.
/// Where that does not hold the bound they are squeezed directly. Where charts outgrow the densities they keep, all is done
/// again with these only moved, until none does, or no more are to be held: what would grow by them has to stretch.
Squeezed squeeze(const std::vector<PlacedCharts>& starts, const Objective& objective, const SqueezeOptions& options,
                 Monitor& monitor);

/// Goes on from a start whose way to the bound lies behind it.
ReduceResult squeeze_on(const PlacedCharts& start, const Objective& objective, const Gap& gap, const WarmStart& warm,
                        const SqueezeOptions& options, Monitor& monitor);

/// All starts and gaps on the coarse charts alone; nothing where there are no such. Its UVs are theirs.
std::optional<Squeezed> squeeze_coarse_charts(const std::vector<PlacedCharts>& starts, const Objective& objective,
                                              const SqueezeOptions& options, Monitor& monitor);

/// What the squeeze of some charts comes to, roughly: their coarse charts', where there are such.
struct Forecast {
  /// Objective lost in one of the triangles that were squeezed.
  struct Loss {
    int chart;
    std::array<int, 3> corners;  ///< vertices of the charts themselves
    double amount;               ///< all together sum up to the objective - 1
  };

  Squeezed end;
  std::vector<Loss> losses = {};
  /// stretch_99() as far as energies tell it: triangles that are as much longer one way as they are shorter the other.
  double stretch = 1;
};
/// Places charts to be squeezed, which are to lose least of the objective.
using Placer = std::function<PlacedCharts(const std::vector<Chart>&, const Objective&)>;

Forecast forecast_squeeze(const std::vector<Chart>& charts, const Objective& objective, const Placer& place,
                          const SqueezeOptions& options, Monitor& monitor);
/// The same of squeeze_on().
Forecast forecast_squeeze_on(const PlacedCharts& start, const Objective& objective, const Gap& gap, const WarmStart& warm,
                             const SqueezeOptions& options, Monitor& monitor);
/// The charts themselves squeezed on from where the forecast has ended; nothing where they cannot.
std::optional<Squeezed> squeeze_as_forecast(const std::vector<Chart>& charts, const Objective& objective,
                                            const Forecast& forecast, const SqueezeOptions& options, Monitor& monitor);

}  // namespace atlas_refine
