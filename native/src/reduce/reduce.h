// The engine: least distortion of placed pieces under a packing efficiency target, gaps kept (section 3.3, eq. 12-14).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "atlas_refine/options.h"
#include "geometry/freedom.h"
#include "measure/distortion.h"
#include "solve/objective.h"

namespace atlas_refine {

/// The engine starts in a box that is a little larger than the charts' own, and the gap follows the box.
inline constexpr double kStartGap = 1.006;

/// From so many charts on they are in each other's way at nearly every step, and what only refines the result is not waited for.
inline constexpr std::size_t kThousands = 1000;

/// A vertex and a boundary edge of one chart, told by the vertex it starts at, that may come nearer to each other than the gap.
/// Vertices are numbered through all charts, one after the other.
struct NearBorder {
  int vertex;
  int edge;
  double floor;  ///< what is kept between them and around there, as Gap::value
};

/// What a start that ended a problem like this one brings along.
struct WarmStart {
  Vec2 box = Vec2::Zero();  ///< [0, box.x] x [0, box.y], which the charts lie in
  double range = 0;         ///< the barrier was felt so far beyond the gap
  double price = 0;         ///< as ReduceResult::price
  double far_arc = 0;       ///< borders of one chart between which its boundary is at least so long face each other
  std::vector<NearBorder> near_borders = {};
};

struct ReduceProblem {
  static constexpr int kMostIterations = 600;

  const std::vector<Chart>& charts;      ///< placed, free of flips and crossings, kStartGap times the gap apart; the start
  const Objective* objective = nullptr;  ///< of `charts`; nothing: the surface
  Gap gap = {};                  ///< smallest distance between charts; within a chart the same, or the start's own if less
  double box_aspect = 0;         ///< width / height, 0 = free
  double pe_target = 0;          ///< in (0, 1), below or above the present PE; 0 = no box: least distortion in open space
  double enough_distortion = 0;  ///< stop as soon as the bound holds and the objective is at most this; 0 = go to the optimum
  double least_change = 2e-4;    ///< at the optimum where the objective - 1 changes by less, relative, twice in a row
  double negligible = 1e-8;      ///< or by less than this; what the present price gives for a change of PE is left out
  DistortionLimits limits = {};  ///< on the surface: give up the climb once one is exceeded at its least
  std::vector<double> wanted_areas = {};  ///< per chart, whose density is kept: no result may have them outgrown
  double max_rise = 0;  ///< give up the climb where the objective exceeds its least so far by this factor - 1; 0 = no limit
  double most_energy =
      0;  ///< give up where the objective falls so slowly that it ends far above this; 0 = no limit; without a box
  int max_iterations = kMostIterations;
  int threads = 1;
  /// Charts that only move count in the objective, by what they have; fixed ones do not.
  Freedoms freedom = {};
  Vec2 frame = Vec2::Zero();           ///< PlacedCharts::frame; a problem with one has `box_aspect` and `pe_target`
  std::optional<WarmStart> warm = {};  ///< of `charts`: they start in its box, with the barrier as soft as it is at the end
};

enum class ReduceStatus {
  Converged,     ///< the target holds and the objective is at its optimum there
  Enough,        ///< the target holds and the objective is at most enough_distortion
  Stalled,       ///< no further progress; `reached` tells whether the target holds
  TooDistorted,  ///< a limit of distortion, or of kept densities, was met before the target
  TooExpensive,  ///< max_rise was met before the target
  OutOfTime,     ///< max_iterations
  Stopped,       ///< the monitor asked for the best state so far
};

struct ReduceProgress {
  int iteration;
  double pe;
  double energy;
  double price;
  double fraction;  ///< of the Newton step that was taken
};
/// Called before every iteration; false ends with the best state so far. May throw to cancel.
using ReduceMonitor = std::function<bool(const ReduceProgress&)>;

/// The best state that was found: within its limits if any was, then at the target if any was, then of the least
/// objective there, or the one that is worth the most below it (`worth_below_target`): a high PE, but not of charts that were
/// crushed for it.
struct ReduceResult {
  std::vector<std::vector<Vec2>> uvs;  ///< one array per chart, in the start's units
  Vec2 frame = Vec2::Zero();           ///< where the problem has one: what it has become
  WarmStart end;                       ///< for a problem that goes on from here
  ReduceStatus status = ReduceStatus::Converged;
  bool reached = false;  ///< PE of the frame, or of the charts' own bounding box (of the asked aspect), is at least the target
  bool within_limit = true;  ///< of distortion and of kept densities
  double used_limits = 0;    ///< the part of them that is used: above 1 one is exceeded
  bool holds() const { return reached && within_limit; }
  double pe = 0;
  double least_energy = 0;  ///< the least objective on the way, at whatever PE
  double first_energy = 0;  ///< the objective at the start
  double energy = 0;        ///< the objective at the scale the charts have
  double distortion = 0;    ///< E_d on the surface, under the one global scale that minimises it
  double price = 0;         ///< lambda: marginal objective for one unit of log PE
  int iterations = 0;
  std::vector<int> outgrown = {};  ///< where no result holds the target: charts that had outgrown their densities in the end
  /// Where the objective is lost, and what holds the charts apart: what a cut or a heat map is chosen by.
  std::vector<std::vector<double>> triangle_energy;  ///< per chart and triangle, unweighted, 1 = the wanted shape
  std::vector<std::vector<Vec2>> contact_forces;     ///< per chart and vertex: objective / length, in units of sqrt(surface area)
};

/// Minimises objective + barrier subject to log PE >= log target by projected Newton with one multiplier. From above the target
/// the iterates keep a margin to it, and may still dip below by what PE of one step was wrong by; the result never does.
/// Differs from Algorithm 2: the box sides are unknowns and PE is a constraint with a price instead of a growing scaffold box and
/// the barrier of eq. (13); the gap is exact, the bound cannot be overstepped, and the start may lie below the bound.
ReduceResult reduce_distortion(const ReduceProblem& problem, const ReduceMonitor& monitor = {});

}  // namespace atlas_refine
