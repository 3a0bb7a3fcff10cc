// The engine's loop: one Newton step on objective + barrier with the multiplier of log PE, again and again.
#include "reduce/reduce.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "reduce/contact_set.h"
#include "reduce/kept_density.h"
#include "reduce/model.h"
#include "reduce/schedule.h"
#include "support/parallel.h"
#include "support/profile.h"

namespace atlas_refine {
namespace {

constexpr double kNegligible = 1e-8;  // a change of E_d that nobody can measure
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr int kStallIterations = 12;
constexpr double kBackOff = 0.8;      // in a box: the floor of a gap is mostly overstepped by little
constexpr double kFarBelow = 3;       // log PE below the target where charts that climb too slowly are given up,
constexpr int kTrialIterations = 60;  // after so many iterations
constexpr double kMostGain = 0.1;     // of log PE in one iteration, with or without a price
constexpr double kOnTarget = 1e-4;    // log PE about the target where the bound counts as held,
constexpr double kTelling = 1;        // damping up to which a rise of the objective is the price of PE
constexpr double kCrushed = 0.5;      // a rise under heavy damping that is not waited out
constexpr int kHundreds = 100;        // so many charts ride with the box: of fewer hardly any step is cut short
constexpr int kPace = 30;             // iterations over which a pace is taken
constexpr double kQuickening = 3;     // a pace may grow by so much
constexpr double kWorthOfPace = 5;    // times the least change: what so many iterations have to bring,
constexpr double kWorthOfSlide = 20;  // and times what is negligible: charts that slide along each other do so for hundreds,
constexpr double kWorthOfJam = 5e-6;  // and where charts press against each other

/// Where the iteration is.
struct Iterate {
  ReduceState state;
  double energy = 0;
  double used_limits = 0;  ///< of distortion; above 1 one is exceeded
  double outgrown = 0;     ///< used_by_outgrown()
  double pe = 0;
  double price = 0;
  double fraction = 1;  ///< of the last step that was taken
};

struct Step {
  std::vector<Vec2> direction;
  double slope = 0;  ///< of the merit along it
  double price = 0;
  double predicted_gain = 0;  ///< of log PE
};

/// Iterations in a row of one kind.
struct Counters {
  int calm = 0, idle = 0, expensive = 0, distorted = 0;
  int unrewarded = 0;              ///< since the objective at the bound has last fallen by what is worth a pace
  double rewarded_at = kInfinite;  ///< the objective then
  double least_energy = kInfinite;
  double pace_energy = kInfinite;  ///< the objective where the present pace began
};

/// The problem with what its tests need.
struct Task {
  const ReduceProblem& problem;
  ReduceModel& model;

  bool bounded() const { return model.has_box; }
  bool holds_bound(const Iterate& at) const { return !bounded() || at.pe >= problem.pe_target; }
  bool within_limit(const Iterate& at) const { return at.used_limits <= 1; }
  /// Densities may be outgrown on the way: PE that climbs costs more than PE that has come to rest.
  bool within_all(const Iterate& at) const { return within_limit(at) && at.outgrown <= 1; }
  /// log of target / PE, positive while the bound does not hold.
  double deficit(const Iterate& at, double margin) const {
    return bounded() ? std::log(problem.pe_target * (1 + kTargetSlack + margin) / at.pe) : 0;
  }
  ScheduleView view(const Iterate& at, double margin) const { return {bounded(), deficit(at, margin), at.energy, model.range}; }
};

void measure(const Task& task, Iterate& at) {
  if (task.bounded()) at.pe = tight_pe(task.model, at.state);
  const DistortionLimits& limits = task.problem.limits;
  if (limits.any()) at.used_limits = used_limits(task.problem.charts, limits, task.model, at.state.x);
  const std::vector<double>& wanted = task.problem.wanted_areas;
  if (!wanted.empty()) at.outgrown = used_by_outgrown(piece_areas(task.model, at.state.x), wanted);
}

Iterate first_iterate(const Task& task) {
  Iterate at{.state = task.model.start, .price = task.problem.warm ? task.problem.warm->price : 0};
  at.energy = model_energy(task.model, at.state.x);
  measure(task, at);
  return at;
}

/// Gradient of objective + stiffness * barrier and its projected Hessian. The pattern is analysed anew only where a contact asks.
void assemble(ReduceModel& model, const ReduceState& state, double stiffness, TriangleSlots& slots, BlockSystem& system) {
  const PhaseScope scope(Phase::Assemble);
  const ContactSet contacts = find_contacts(model, state);
  note_near_borders(state, contacts, model);
  if (model.has_box && model.first_vertex.size() > kHundreds) ride_along(state, model);
  const bool anew = !covers(system.matrix, model, contacts);
  if (anew) {
    auto pairs = triangle_sides(model.triangles);
    const auto coupled = coupled_nodes(model, state, contacts);
    pairs.insert(pairs.end(), coupled.begin(), coupled.end());
    system.matrix.set_pattern(model.node_count(), std::move(pairs), model.has_box ? model.box_node() : -1);
  }
  const auto add_all = [&] {
    if (anew) slots = triangle_slots(system.matrix, model.triangles);
    system.set_zero();
    for (int v = 0; v < model.vertex_count(); ++v) {
      if (model.node[v] != v) system.matrix.diagonal[v] += Mat2::Identity();  // an empty equation
    }
    add_dirichlet(model.objective, model.triangles, slots, state.x, model.threads, system);
    add_contacts(model, state, contacts, stiffness, system);
    if (model.has_box) add_walls(model, state, stiffness, system);
  };
  if (anew)
    side_by_side(model.threads, {[&] { system.matrix.analyse_pattern(); }, add_all});
  else
    add_all();
}

/// The price at which log PE gains what it should; 0 where the bound does not bind.
double price_of_gain(const Task& task, const Iterate& at, const Schedule& schedule, double own_gain, double gain_per_price) {
  const double deficit = task.deficit(at, schedule.margin);
  // Too distorted: hold the PE and relax before climbing on.
  const double climb = task.within_limit(at) ? largest_climb(deficit) : 0;
  double price = std::max(0.0, (std::min(deficit, climb) - own_gain) / gain_per_price);
  if (!schedule.relaxing) return price;
  const double fall = largest_fall(at.energy, task.problem.enough_distortion);
  return std::max(price, std::min(dearest_price(schedule, at.energy), (-fall - own_gain) / gain_per_price));
}

void shorten(Step& step, double part) {
  for (Vec2& d : step.direction) d *= part;
  step.slope *= part;
  step.predicted_gain *= part;
}

/// Solves for the step and its price; nothing where no damping makes the matrix positive definite.
std::optional<Step> compute_step(const Task& task, const Iterate& at, Schedule& schedule, TriangleSlots& slots,
                                 BlockSystem& system) {
  assemble(task.model, at.state, schedule.stiffness, slots, system);
  const auto damping = factor_damped(
      system, task.model.masses, {schedule.damping, 10, task.bounded() ? kMostDamping : kMostDampingAlone}, task.model.threads);
  if (!damping) return std::nullopt;
  schedule.damping = *damping;
  Step step;
  if (task.bounded()) {
    const std::vector<Vec2> gradient = pe_gradient(task.model, at.state);
    std::vector<Vec2> climb = gradient;
    step.direction = newton_direction(system, climb);
    const double own_gain = dot(gradient, step.direction), gain_per_price = dot(gradient, climb);
    step.price = price_of_gain(task, at, schedule, own_gain, gain_per_price);
    step.predicted_gain = own_gain + step.price * gain_per_price;
    for (std::size_t i = 0; i < climb.size(); ++i) step.direction[i] += step.price * climb[i];
    step.slope = -step.price * dot(gradient, step.direction);
  } else {
    step.direction = newton_direction(system);
  }
  step.slope += dot(system.gradient, step.direction);
  // A box that nothing touches would collapse: what charts sweep then takes minutes to search, and none of it is free.
  if (step.predicted_gain > kMostGain) shorten(step, kMostGain / step.predicted_gain);
  spread(task.model, step.direction);
  return step;
}

/// Backtracks along the step from its largest part free of flips and collisions.
void advance(const Task& task, const Step& step, const Schedule& schedule, Iterate& at) {
  const ReduceModel& model = task.model;
  at.price = step.price;
  StepBounds bounds = free_step(model, at.state, step.direction);
  const double limit = bounds.least();
  std::vector<Vec2> swept(step.direction.begin(), step.direction.begin() + model.vertex_count());
  for (Vec2& s : swept) s *= limit;
  const ContactSet contacts = find_contacts(model, at.state, swept);
  const auto merit = [&](const ReduceState& state, double energy, double barrier) {
    return energy + schedule.stiffness * barrier - (task.bounded() ? step.price * std::log(box_pe(model, state)) : 0);
  };
  const double before = merit(at.state, at.energy, barrier(model, at.state, contacts));
  if (limit <= 0) {
    at.fraction = 0;
    return;
  }
  for (double& part : bounds.of_piece) part /= limit;
  Iterate trial;
  const auto merit_at = [&](double fraction) {
    trial.state = moved(model, at.state, step.direction, bounds, fraction);
    if (task.bounded() && !(trial.state.box.minCoeff() > 0)) return kInfinite;
    const double pressure = barrier(model, trial.state, contacts);
    if (!std::isfinite(pressure)) return kInfinite;
    trial.energy = model_energy(model, trial.state.x);
    return merit(trial.state, trial.energy, pressure);
  };
  at.fraction = line_search(limit, before, step.slope, merit_at, task.bounded() ? kBackOff : 0.5);
  if (at.fraction == 0) return;
  at.state = std::move(trial.state);
  at.energy = trial.energy;
  measure(task, at);
}

/// What one iteration changed.
struct Change {
  double energy, used_limits, pe;
};

/// Above the largest distortion, and losing it so slowly that the limit is out of reach.
bool hopeless(const Iterate& at, const Change& change) {
  constexpr double kSlow = 0.05;  // of the way to the limit in one iteration
  return at.fraction > 0.5 && -change.used_limits < kSlow * (at.used_limits - 1);
}

/// So far below the bound that at the pace so far no iteration that is left reaches it.
bool too_far(const Task& task, const Iterate& at, const Schedule& schedule, double first_pe, int iteration) {
  const double deficit = task.deficit(at, schedule.margin);
  if (iteration < kTrialIterations || deficit < kFarBelow) return false;
  return std::log(at.pe / first_pe) / iteration * (task.problem.max_iterations - iteration) < deficit;
}

/// The same without a box, where all that counts is the objective.
bool too_slow(const Task& task, const Iterate& at, int iteration, Counters& counters) {
  const double useful = task.problem.most_energy;
  if (useful == 0 || iteration % kPace != 0) return false;
  const double before = std::exchange(counters.pace_energy, at.energy);
  const double paces = static_cast<double>(task.problem.max_iterations - iteration) / kPace;
  return std::isfinite(before) && kQuickening * paces * std::log(before / at.energy) < std::log(at.energy / useful);
}

/// Where iterations at the bound, or next to it, go on and on, yet bring next to nothing.
void count_unrewarded(const Task& task, const Iterate& at, const Schedule& schedule, Counters& counters) {
  const bool on_target = task.holds_bound(at) || task.deficit(at, schedule.margin) < kOnTarget;
  if (!on_target || !task.within_limit(at)) return;
  const ReduceProblem& problem = task.problem;
  const double worth = kWorthOfPace * problem.least_change * (at.energy - 1) +
                       std::max(kWorthOfSlide * problem.negligible, schedule.damping > kTelling ? kWorthOfJam : 0);
  const bool rewarded = !(at.energy > counters.rewarded_at - worth);
  counters.unrewarded = rewarded ? 0 : counters.unrewarded + 1;
  if (rewarded) counters.rewarded_at = at.energy;
}

Counters counted(const Task& task, const Change& change, const Iterate& at, const Schedule& schedule, Counters counters) {
  const ReduceProblem& problem = task.problem;
  const double deficit = task.deficit(at, schedule.margin);
  const bool on_target = !task.bounded() || std::abs(deficit) < kOnTarget || (task.holds_bound(at) && at.price == 0);
  // What PE gained or lost has its price.
  const double moved = std::abs(change.energy - (at.pe > 0 ? at.price * change.pe / at.pe : 0));
  const bool quiet = moved < problem.least_change * (at.energy - 1) + problem.negligible && at.fraction > 0.1;
  const bool calm =
      on_target && quiet && schedule.damping <= kTelling && settled(schedule, task.view(at, schedule.margin), at.price);
  counters.calm = calm ? counters.calm + 1 : 0;
  counters.least_energy = std::min(counters.least_energy, at.energy);
  // Under heavy damping distortion tells of a collision, which may come apart again; with thousands of charts that takes minutes.
  const double crushed = problem.charts.size() < kThousands ? kInfinite : kCrushed;
  const double most_rise = schedule.damping <= kTelling ? problem.max_rise : crushed;
  counters.expensive = at.energy > (1 + most_rise) * counters.least_energy ? counters.expensive + 1 : 0;
  const bool above = !task.within_limit(at);
  counters.distorted = above && hopeless(at, change) ? counters.distorted + 2 : above && quiet ? counters.distorted + 1 : 0;
  const bool progress = moved > 1e-5 * (at.energy - 1) + 0.1 * kNegligible || change.pe > 1e-5 * at.pe;
  counters.idle = progress ? 0 : counters.idle + 1;
  count_unrewarded(task, at, schedule, counters);
  return counters;
}

std::optional<ReduceStatus> ended(const Task& task, const Iterate& at, const Schedule& schedule, const Counters& counters,
                                  double first_energy) {
  const ReduceProblem& problem = task.problem;
  const bool holds = task.holds_bound(at);
  const ReduceStatus at_rest = task.within_all(at) ? ReduceStatus::Converged : ReduceStatus::TooDistorted;
  if (holds && counters.calm >= 2) return at_rest;
  if (holds && problem.enough_distortion > 0 && at.energy <= problem.enough_distortion) return ReduceStatus::Enough;
  if (holds && task.within_limit(at) && counters.unrewarded >= kPace) return at_rest;
  if (counters.distorted >= 4) return ReduceStatus::TooDistorted;
  if (!holds && problem.max_rise > 0 && counters.expensive >= 3) return ReduceStatus::TooExpensive;
  if (counters.idle >= kStallIterations || wedged(schedule, at.energy, first_energy)) return ReduceStatus::Stalled;
  return std::nullopt;
}

/// True where `a` is a better result than `b`; `least`: energy so far.
bool better(const Task& task, const Iterate& a, const Iterate& b, double least) {
  const bool a_within = task.within_all(a), b_within = task.within_all(b);
  if (a_within != b_within) return a_within;
  if (!a_within) return std::max(a.used_limits, a.outgrown) < std::max(b.used_limits, b.outgrown);
  const bool a_holds = task.holds_bound(a), b_holds = task.holds_bound(b);
  if (a_holds != b_holds) return a_holds;
  if (a_holds) return a.energy < b.energy;
  return worth_below_target(a.pe, a.energy, least) > worth_below_target(b.pe, b.energy, least);
}

/// Of every triangle of every piece, those that do not bend too.
std::vector<double> energy_of_triangles(const Task& task, const std::vector<Vec2>& x) {
  const ReduceModel& model = task.model;
  if (model.freedom.empty()) return triangle_energies(model.objective, model.triangles, x);
  const Objective all = task.problem.objective ? *task.problem.objective : make_objective(task.problem.charts);
  return triangle_energies(all, model.surface_triangles, x);
}

ReduceResult result_of(const Task& task, const Iterate& best, ReduceStatus status, double stiffness, int iterations) {
  const ReduceModel& model = task.model;
  ReduceResult out{.uvs = by_piece(model, best.state.x, model.objective.unit), .status = status};
  out.end = {.box = model.objective.unit * best.state.box,
             .range = model.objective.unit * model.range,
             .price = best.price,
             .far_arc = model.objective.unit * model.far_arc,
             .near_borders = model.near_borders};
  for (NearBorder& near : out.end.near_borders)
    near = {model.boundary.vertex[near.vertex], model.boundary.vertex[near.edge], near.floor};
  if (task.problem.frame.x() > 0) out.frame = out.end.box;
  out.reached = task.holds_bound(best);
  out.within_limit = task.within_all(best);
  out.used_limits = std::max(best.used_limits, best.outgrown);
  out.pe = best.pe;
  out.energy = best.energy;
  out.distortion = surface_distortion(task.problem.charts, model, best.state.x);
  out.price = best.price;
  out.iterations = iterations;
  const std::vector<double> energies = energy_of_triangles(task, best.state.x);
  auto next = energies.begin();
  for (const Chart& chart : task.problem.charts) {
    out.triangle_energy.emplace_back(next, next + static_cast<std::ptrdiff_t>(chart.triangles.size()));
    next += static_cast<std::ptrdiff_t>(chart.triangles.size() + chart.guards.size());
  }
  out.contact_forces = by_piece(model, contact_forces(model, best.state, find_contacts(model, best.state), stiffness), 1);
  return out;
}

}  // namespace

ReduceResult reduce_distortion(const ReduceProblem& problem, const ReduceMonitor& monitor) {
  ReduceModel model = make_model(problem);
  const Task task{problem, model};
  Iterate at = first_iterate(task);
  Iterate best = at;
  const double first_energy = at.energy, first_pe = at.pe;
  const bool relaxing = task.bounded() && !problem.warm && at.pe > problem.pe_target;
  Schedule schedule = problem.warm ? warm_schedule(problem.warm->price, task.view(at, 0))
                                   : first_schedule(relaxing, task.view(at, relaxing ? kMostMargin : 0),
                                                    relaxing ? least_slack(model, at.state) : 1);
  if (!std::isfinite(at.energy) || !std::isfinite(barrier(model, at.state, find_contacts(model, at.state)))) {
    ReduceResult out = result_of(task, best, ReduceStatus::Stalled, 0, 0);
    out.first_energy = out.least_energy = first_energy;
    return out;
  }
  Counters counters;
  TriangleSlots slots;
  BlockSystem system;
  ReduceStatus status = ReduceStatus::OutOfTime;
  int iteration = 0;
  for (; iteration < problem.max_iterations; ++iteration) {
    if (monitor && !monitor({iteration, at.pe, at.energy, at.price, at.fraction})) {
      status = ReduceStatus::Stopped;
      break;
    }
    if (const auto end = ended(task, at, schedule, counters, first_energy)) {
      status = *end;
      break;
    }
    if (too_far(task, at, schedule, first_pe, iteration) || too_slow(task, at, iteration, counters)) break;
    const auto step = compute_step(task, at, schedule, slots, system);
    if (!step) {
      status = ReduceStatus::Stalled;
      break;
    }
    const double energy = at.energy, used = at.used_limits, pe = at.pe;
    advance(task, *step, schedule, at);
    account_step(at.fraction);
    if (relaxing) adapt_margin(schedule, std::abs(std::log(at.pe / pe) - at.fraction * step->predicted_gain));
    adapt(schedule, task.view(at, schedule.margin), at.price, at.fraction);
    counters = counted(task, {at.energy - energy, at.used_limits - used, at.pe - pe}, at, schedule, counters);
    if (better(task, at, best, std::min(first_energy, counters.least_energy))) best = at;
  }
  ReduceResult out = result_of(task, best, status, schedule.stiffness, iteration);
  if (!out.holds() && at.outgrown > 1) out.outgrown = outgrown_charts(piece_areas(model, at.state.x), problem.wanted_areas);
  out.first_energy = first_energy;
  out.least_energy = std::min(counters.least_energy, first_energy);
  return out;
}

}  // namespace atlas_refine
