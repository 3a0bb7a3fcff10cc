// The engine's loop: one Newton step on E_d + barrier with the multiplier of log PE, again and again.
#include "reduce/reduce.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reduce/system.h"

namespace atlas_refine {
namespace {

constexpr double kLeastClimb = 0.01;   // log PE gains at most this much in one iteration near the target,
constexpr double kMostClimb = 0.03;    // and this much far below it
constexpr double kTargetSlack = 2e-5;  // aim so much above the bound, relative, that rounding cannot lose it
constexpr double kNearTarget = 1e-3;   // log PE: from here on the barrier softens
constexpr double kNegligible = 1e-8;   // a change of E_d that nobody can measure
constexpr double kLeastPrice = 1e-3;   // the barrier is never softer than for this price
// Where charts start above the target and relax:
constexpr double kMostFall = 0.01;       // log PE falls so much in one iteration, unless holding it there is dear,
constexpr double kFastFall = 0.03;       // and so much while E_d - 1 is still far from what is enough:
constexpr double kFar = 2;               // that many times as much
constexpr double kMargin = 3;            // they keep off the target by so many times what the PE of a step was wrong by,
constexpr double kMostMargin = 0.006;    // at most by this
constexpr double kPressure = 1;          // the barrier is as firm as for this price per unit of E_d - 1,
constexpr double kDearest = 8;           // or for a price up to so much more,
constexpr double kMostRise = 4;          // E_d - 1 beyond so much of the start's: the charts are wedged
constexpr double kFirmness = 0.2;        // stiffness of the barrier per price and range while PE climbs,
constexpr double kSoftFirmness = 0.005;  // and at the end, when charts may come as near as the gap allows
constexpr double kSoftening = 0.5;       // from one to the other, a step per iteration on the target
constexpr double kOpenFirmness = 2;      // without a box: far from the optimum, a soft barrier grinds
constexpr double kLeastDamping = 1e-6;
constexpr double kMostDamping = 1e8;
constexpr double kArmijo = 1e-4;
constexpr int kStallIterations = 12;

double dot(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

class Reduction {
 public:
  Reduction(const ReduceProblem& problem, const ReduceMonitor& monitor)
      : problem_(problem), monitor_(monitor), system_(problem), state_(system_.start()) {
    energy_ = system_.distortion(state_.x);
    first_energy_ = energy_;
    best_ = state_;
    firmness_ = bounded() ? kFirmness : kOpenFirmness;
    update_pe();
    relaxing_ = bounded() && pe_ > problem_.pe_target;
    margin_ = relaxing_ ? kMostMargin : 0;
    if (relaxing_ && deficit() > -kNearTarget) firmness_ = kSoftFirmness;  // there already
    stiffness_ = firmness_ * least_price() * system_.range();
    if (relaxing_) stiffness_ *= system_.least_slack(state_);
  }

  ReduceResult run() {
    ReduceStatus status = ReduceStatus::OutOfTime;
    keep_if_best();
    if (!std::isfinite(energy_) || !std::isfinite(system_.barrier(state_, system_.contacts(state_, {}))))
      return result(ReduceStatus::Stalled);
    for (iteration_ = 0; iteration_ < problem_.max_iterations; ++iteration_) {
      if (monitor_) monitor_({iteration_, pe_, energy_, price_, fraction_});
      if (finished(status)) break;
      const double energy_before = energy_, pe_before = pe_;
      if (!compute_step()) {
        status = ReduceStatus::Stalled;
        break;
      }
      advance();
      keep_if_best();
      count_progress(energy_before, pe_before);
    }
    return result(status);
  }

 private:
  bool bounded() const { return system_.has_box(); }
  bool holds_bound() const { return !bounded() || pe_ >= problem_.pe_target; }
  /// log of target / PE, positive while the bound does not hold.
  double deficit() const { return bounded() ? std::log(problem_.pe_target * (1 + kTargetSlack + margin_) / pe_) : 0; }

  void update_pe() {
    if (bounded()) pe_ = system_.tight_pe(state_);
  }

  bool finished(ReduceStatus& status) const {
    if (holds_bound() && calm_ >= 2)
      status = ReduceStatus::Converged;
    else if (holds_bound() && problem_.enough_distortion > 0 && energy_ <= problem_.enough_distortion)
      status = ReduceStatus::Converged;
    else if (distorted_ >= 4)
      status = ReduceStatus::TooDistorted;
    else if (!holds_bound() && problem_.max_price > 0 && expensive_ >= 3)
      status = ReduceStatus::TooExpensive;
    else if (idle_ >= kStallIterations || (relaxing_ && energy_ - 1 > kMostRise * (first_energy_ - 1)))
      status = ReduceStatus::Stalled;
    else
      return false;
    return true;
  }

  bool within_distortion() const { return problem_.max_distortion == 0 || energy_ <= problem_.max_distortion; }

  /// Solves for the step and its price; raises the damping until the matrix is positive definite.
  bool compute_step() {
    system_.assemble(state_, system_.contacts(state_, {}), stiffness_);
    system_.damp(damping_);
    for (double extra = damping_; !system_.matrix.factor(); extra *= 10) {
      if (damping_ + extra > kMostDamping) return false;
      system_.damp(extra);
      damping_ += extra;
    }
    step_ = system_.energy_gradient;
    system_.matrix.solve(step_);
    for (Vec2& s : step_) s = -s;
    price_ = 0;
    if (!bounded()) return true;
    std::vector<Vec2> climb = system_.pe_gradient;
    system_.matrix.solve(climb);
    // Too distorted: hold the PE and relax before climbing on.
    const double climb_limit = within_distortion() ? std::clamp(0.2 * deficit(), kLeastClimb, kMostClimb) : 0;
    const double own_gain = dot(system_.pe_gradient, step_), gain_per_price = dot(system_.pe_gradient, climb);
    price_ = std::max(0.0, (std::min(deficit(), climb_limit) - own_gain) / gain_per_price);
    if (relaxing_) price_ = std::max(price_, std::min(kDearest * least_price(), (-most_fall() - own_gain) / gain_per_price));
    predicted_gain_ = own_gain + price_ * gain_per_price;
    for (std::size_t i = 0; i < step_.size(); ++i) step_[i] += price_ * climb[i];
    return true;
  }

  double merit(const ReduceState& state, double energy, double barrier) const {
    return energy + stiffness_ * barrier - (bounded() ? price_ * std::log(system_.box_pe(state)) : 0);
  }

  /// Backtracks along the step from its largest fraction free of flips and collisions.
  void advance() {
    const double limit = system_.free_step(state_, step_);
    std::vector<Vec2> swept(step_.begin(), step_.begin() + system_.vertex_count());
    for (Vec2& s : swept) s *= limit;
    const auto contacts = system_.contacts(state_, swept);
    const double merit_before = merit(state_, energy_, system_.barrier(state_, contacts));
    double slope = dot(system_.energy_gradient, step_);
    if (bounded()) slope -= price_ * dot(system_.pe_gradient, step_);
    fraction_ = 0;
    for (double fraction = limit; fraction > 1e-9; fraction *= 0.5) {
      ReduceState trial = system_.moved(state_, step_, fraction);
      if (bounded() && !(trial.box.minCoeff() > 0)) continue;
      const double barrier = system_.barrier(trial, contacts);
      if (!std::isfinite(barrier)) continue;
      const double energy = system_.distortion(trial.x);
      if (!(merit(trial, energy, barrier) <= merit_before + kArmijo * fraction * slope)) continue;
      state_ = std::move(trial);
      energy_ = energy;
      fraction_ = fraction;
      break;
    }
    const double pe_before = pe_;
    update_pe();
    if (relaxing_) {
      const double error = std::abs(std::log(pe_ / pe_before) - fraction_ * predicted_gain_);
      margin_ = std::min(kMostMargin, std::max(0.5 * margin_, kMargin * error));
    }
    adapt();
  }

  /// Damping follows the steps that succeed, the barrier's stiffness follows the price.
  void adapt() {
    if (fraction_ >= 0.5)
      damping_ = std::max(kLeastDamping, 0.5 * damping_);
    else if (fraction_ < 0.1)
      damping_ = std::min(kMostDamping, 4 * damping_);
    if (bounded() && deficit() < kNearTarget && (!relaxing_ || deficit() > -kNearTarget))
      firmness_ = std::max(kSoftFirmness, kSoftening * firmness_);
    // A relaxing barrier that followed a price of its own making would freeze.
    const double price = relaxing_ ? std::min(price_, kDearest * least_price()) : price_;
    const double wanted = firmness_ * std::max(price, least_price()) * system_.range();
    stiffness_ = std::clamp(wanted, 0.5 * stiffness_, 2 * stiffness_);
  }

  double most_fall() const { return energy_ - 1 > kFar * (problem_.enough_distortion - 1) ? kFastFall : kMostFall; }

  /// Where charts start above the bound and relax, they press on each other by the energy that they still have to lose.
  double least_price() const { return relaxing_ ? std::max(kLeastPrice, kPressure * (energy_ - 1)) : kLeastPrice; }

  /// The barrier has reached its final softness, or nothing presses on it.
  bool settled() const { return !bounded() || price_ == 0 || firmness_ == kSoftFirmness; }

  void count_progress(double energy_before, double pe_before) {
    const bool on_target = !bounded() || (std::abs(deficit()) < 1e-4 || (holds_bound() && price_ == 0));
    const bool quiet =
        std::abs(energy_ - energy_before) < problem_.least_change * (energy_ - 1) + problem_.negligible && fraction_ > 0.1;
    calm_ = on_target && quiet && settled() ? calm_ + 1 : 0;
    expensive_ = price_ > problem_.max_price ? expensive_ + 1 : 0;
    distorted_ = !within_distortion() && quiet ? distorted_ + 1 : 0;
    const bool moved =
        std::abs(energy_ - energy_before) > 1e-5 * (energy_ - 1) + 0.1 * kNegligible || pe_ - pe_before > 1e-5 * pe_;
    idle_ = moved ? 0 : idle_ + 1;
  }

  void keep_if_best() {
    if (!within_distortion()) return;
    const bool holds = holds_bound();
    if (holds && !best_holds_) best_energy_ = std::numeric_limits<double>::infinity();
    const bool better = holds ? energy_ < best_energy_ : !best_holds_ && pe_ > best_pe_;
    if (!better) return;
    best_ = state_;
    best_holds_ = holds;
    best_energy_ = energy_;
    best_pe_ = pe_;
    best_price_ = price_;
  }

  ReduceResult result(ReduceStatus status) const {
    ReduceResult out;
    out.uvs = system_.chart_uvs(best_);
    out.status = status;
    out.reached = best_holds_;
    out.pe = best_pe_;
    out.energy = best_energy_;
    out.price = best_price_;
    out.iterations = iteration_;
    return out;
  }

  const ReduceProblem& problem_;
  const ReduceMonitor& monitor_;
  ReduceSystem system_;
  ReduceState state_, best_;
  std::vector<Vec2> step_;
  double first_energy_ = 0, margin_ = 0, predicted_gain_ = 0, energy_ = 0, pe_ = 0, price_ = 0, fraction_ = 1;
  double firmness_ = 0, stiffness_ = 0, damping_ = 1e-3;
  double best_energy_ = std::numeric_limits<double>::infinity(), best_pe_ = -1, best_price_ = 0;
  bool best_holds_ = false, relaxing_ = false;
  int iteration_ = 0, calm_ = 0, idle_ = 0, expensive_ = 0, distorted_ = 0;
};

}  // namespace

ReduceResult reduce_distortion(const ReduceProblem& problem, const ReduceMonitor& monitor) {
  return Reduction(problem, monitor).run();
}

}  // namespace atlas_refine
