// Projected Newton on E_d + lambda * alignment.
#include "align/deform.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/collision.h"
#include "geometry/plane.h"
#include "geometry/predicates.h"
#include "measure/distortion.h"
#include "solve/block_ldlt.h"
#include "solve/symmetric_dirichlet.h"

namespace atlas_refine {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;
constexpr double kTurned = 0.05;   // largest angle off its target (rad) at which edges are drawn to their axis instead of turned
constexpr double kGrowth = 4;      // of lambda while edges turn
constexpr double kAxisGrowth = 8;  // and while they are drawn to their axis
constexpr double kLengthWeight = 0.02;  // of the length term of eq. (8), fixed
constexpr double kMostLambda = 1e13;
constexpr int kTurnRounds = 14;
constexpr int kTurnIterations = 2;    // Newton iterations of one round
constexpr double kShortOf = 0.9;      // part of the way to the first flip that a step may go
constexpr double kShrunken = 0.02;    // an edge with so little of its length left along its axis is in the way
constexpr int kMostSlides = 12;       // rounds of corners moving along the boundary
constexpr double kSlideLambda = 1e3;  // to turn edges with that have got a new direction
constexpr double kFlatEnough = 1e-3;  // flattening may change E_d - 1 by this much, relative

class Deformation {
 public:
  Deformation(const Chart& chart, const AlignTarget& target) : boundary_(target.boundary), turns_(target.quarter_turns) {
    double surface = 0;
    for (const RestTriangle& rest : chart.surface) surface += rest.area;
    scale_ = dirichlet_sums(chart).best_scale() / std::sqrt(surface);
    for (const Vec2& uv : chart.uvs) x_.push_back(scale_ * uv);
    triangles_ = chart.triangles;
    rest_.assign(chart.surface.begin(), chart.surface.end());
    for (RestTriangle& rest : rest_) {
      rest.inverse_edges *= std::sqrt(surface);
      rest.area /= surface;
    }
    perimeter_ = boundary_.perimeter();
    angle_ = boundary_.angle_rad;
    std::vector<std::pair<int, int>> edges;
    for (const Triangle& t : triangles_) {
      for (int k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
    }
    matrix_.analyse(static_cast<int>(x_.size()), edges);
    for (const Triangle& t : triangles_) {
      triangle_slots_.push_back({matrix_.slot(t[0], t[1]), matrix_.slot(t[1], t[2]), matrix_.slot(t[2], t[0])});
    }
  }

  std::optional<AlignedShape> run(const std::function<void()>& poll) {
    lambda_ = std::clamp(distortion(x_) / std::max(alignment(x_, angle_), 1e-12), 1.0, 100.0);
    for (int slide = 0; slide <= kMostSlides; ++slide) {
      if (!turn(poll)) return std::nullopt;
      if (const auto flat = draw(poll)) return AlignedShape{*flat, turns_};
      if (!slide_corners()) return std::nullopt;
      to_axis_ = false;
      lambda_ = kSlideLambda;
    }
    return std::nullopt;
  }

 private:
  /// Turns the edges towards their directions with a growing lambda; false where they do not follow.
  bool turn(const std::function<void()>& poll) {
    for (int round = 0; round < kTurnRounds && largest_turn() > kTurned; ++round) {
      for (int k = 0; k < kTurnIterations && largest_turn() > kTurned; ++k) {
        poll();
        if (!iterate()) return false;
      }
      lambda_ *= kGrowth;
    }
    return largest_turn() < 1;
  }

  /// Draws the edges to their axes until they can be laid flat; nothing where one is in the way.
  std::optional<std::vector<Vec2>> draw(const std::function<void()>& poll) {
    to_axis_ = true;
    for (lambda_ = std::max(lambda_, 100.0); lambda_ < kMostLambda; lambda_ *= kAxisGrowth) {
      poll();
      if (!iterate()) return std::nullopt;
      if (auto flat = flat_result()) return flat;
      if (shrunken_edge() >= 0) return std::nullopt;
    }
    return std::nullopt;
  }

  /// An edge that has next to no length left along its axis, -1 where there is none.
  int shrunken_edge() const {
    for (int i = 0; i < static_cast<int>(angle_.size()); ++i) {
      if (direction(i).dot(x_[edge_end(i)] - x_[edge_start(i)]) < kShrunken * input_length(i)) return i;
    }
    return -1;
  }

  /// Shrunken edges beside a corner take the direction on its other side; false where none can.
  bool slide_corners() {
    const int n = static_cast<int>(turns_.size());
    bool any = false;
    for (int i = 0; i < n; ++i) {
      if (direction(i).dot(x_[edge_end(i)] - x_[edge_start(i)]) >= kShrunken * input_length(i)) continue;
      const int before = i > 0 ? turns_[i - 1] : turns_[n - 1] - 4, after = i + 1 < n ? turns_[i + 1] : turns_[0] + 4;
      int best = turns_[i];
      for (const int label : {before, after}) {
        const bool allowed = label - before <= 1 && after - label <= 1 && label - before >= -2 && after - label >= -2;
        if (label == turns_[i] || !allowed) continue;
        if (best == turns_[i] || std::abs(angle_[i] - kQuarter * label) < std::abs(angle_[i] - kQuarter * best)) best = label;
      }
      any = any || best != turns_[i];
      turns_[i] = best;
    }
    return any;
  }

  int edge_start(int i) const { return boundary_.vertices[i]; }
  int edge_end(int i) const { return boundary_.vertices[(i + 1) % boundary_.size()]; }

  double distortion(const std::vector<Vec2>& x) const {
    double sum = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const Triangle& v = triangles_[t];
      sum += rest_[t].area * symmetric_dirichlet(jacobian(rest_[t].inverse_edges, x[v[0]], x[v[1]], x[v[2]]));
    }
    return sum;
  }

  /// Polar angles at `x`, continued from the present ones: no edge turns by more than pi in one step.
  std::vector<double> angles_at(const std::vector<Vec2>& x) const {
    std::vector<double> out(angle_.size());
    for (int i = 0; i < static_cast<int>(out.size()); ++i) {
      const Vec2 before = x_[edge_end(i)] - x_[edge_start(i)], after = x[edge_end(i)] - x[edge_start(i)];
      out[i] = angle_[i] + std::atan2(cross(before, after), before.dot(after));
    }
    return out;
  }

  double largest_turn() const {
    double largest = 0;
    for (std::size_t i = 0; i < angle_.size(); ++i) {
      largest = std::max(largest, std::abs(angle_[i] - kQuarter * turns_[i]));
    }
    return largest;
  }

  double share(int i) const { return boundary_.lengths[i] / perimeter_; }
  double input_length(int i) const { return scale_ * boundary_.lengths[i]; }
  /// Of the target axis.
  Vec2 direction(int i) const {
    const int d = ((turns_[i] % 4) + 4) % 4;
    const double sign = d < 2 ? 1 : -1;
    return d % 2 == 0 ? Vec2(sign, 0) : Vec2(0, sign);
  }
  /// Across its target axis.
  Vec2 normal(int i) const { return turns_[i] % 2 == 0 ? Vec2(0, 1) : Vec2(1, 0); }

  /// Eq. (8) without lambda; in its second form the deviation from the axis stands for the angle.
  double alignment(const std::vector<Vec2>& x, const std::vector<double>& angles) const {
    double sum = 0;
    for (int i = 0; i < static_cast<int>(angles.size()); ++i) {
      const Vec2 edge = x[edge_end(i)] - x[edge_start(i)];
      const double off = to_axis_ ? normal(i).dot(edge) / input_length(i) : angles[i] - kQuarter * turns_[i];
      sum += 0.5 * share(i) * off * off;
    }
    return sum;
  }
  double length_term(const std::vector<Vec2>& x) const {
    double sum = 0;
    for (int i = 0; i < static_cast<int>(angle_.size()); ++i) {
      const double off = (x[edge_end(i)] - x[edge_start(i)]).norm() / input_length(i) - 1;
      sum += 0.5 * kLengthWeight * share(i) * off * off;
    }
    return sum;
  }
  double objective(const std::vector<Vec2>& x) const {
    return distortion(x) + length_term(x) + lambda_ * alignment(x, angles_at(x));
  }

  void assemble() {
    matrix_.set_zero();
    gradient_.assign(x_.size(), Vec2::Zero());
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const Triangle& v = triangles_[t];
      const double weight = rest_[t].area;
      const auto d = symmetric_dirichlet_derivatives(rest_[t].inverse_edges, x_[v[0]], x_[v[1]], x_[v[2]]);
      for (int k = 0; k < 3; ++k) {
        gradient_[v[k]] += weight * d.gradient[k];
        matrix_.diagonal[v[k]] += weight * d.diagonal[k];
        const Mat2 block = weight * d.off_diagonal[k];
        Mat2& slot = matrix_.off_diagonal[triangle_slots_[t][k]];
        if (v[k] < v[(k + 1) % 3])
          slot += block;
        else
          slot += block.transpose();
      }
    }
    for (int i = 0; i < static_cast<int>(angle_.size()); ++i) add_edge(i);
  }

  /// Residuals r with weight w: gradient w r dr, Gauss-Newton Hessian w dr dr^T.
  void add_edge(int i) {
    const int a = edge_start(i), b = edge_end(i);
    const Vec2 edge = x_[b] - x_[a];
    const double length = edge.norm();
    const auto add = [&](double weight, double residual, const Vec2& slope) {
      const Mat2 stiff = weight * slope * slope.transpose();
      gradient_[b] += weight * residual * slope;
      gradient_[a] -= weight * residual * slope;
      matrix_.diagonal[a] += stiff;
      matrix_.diagonal[b] += stiff;
      matrix_.off_diagonal[matrix_.slot(a, b)] -= stiff;
    };
    add(kLengthWeight * share(i), length / input_length(i) - 1, edge / (length * input_length(i)));
    if (to_axis_)
      add(lambda_ * share(i), normal(i).dot(edge) / input_length(i), normal(i) / input_length(i));
    else
      add(lambda_ * share(i), angle_[i] - kQuarter * turns_[i], Vec2(-edge.y(), edge.x()) / (length * length));
  }

  /// One Newton step with a line search; false where none reduces the objective.
  bool iterate() {
    assemble();
    for (double damping = 1e-9; !factor_damped(damping); damping *= 100) {
      if (damping > 1e3) return false;
      assemble();
    }
    std::vector<Vec2> step = gradient_;
    matrix_.solve(step);
    double slope = 0;
    for (std::size_t v = 0; v < step.size(); ++v) {
      step[v] = -step[v];
      slope += gradient_[v].dot(step[v]);
    }
    const double limit = longest_step(step);
    const double before = objective(x_);
    for (double fraction = limit; fraction > 1e-8; fraction *= 0.5) {
      std::vector<Vec2> trial = x_;
      for (std::size_t v = 0; v < trial.size(); ++v) trial[v] += fraction * step[v];
      if (!(objective(trial) <= before + 1e-4 * fraction * slope)) continue;
      angle_ = angles_at(trial);
      x_ = std::move(trial);
      return true;
    }
    return slope > -1e-9 * std::abs(before);  // at the minimum already
  }

  /// Short of the first flip; and while edges are drawn to their axis, of the first that would run against its direction.
  double longest_step(const std::vector<Vec2>& step) const {
    double limit = 1;
    for (const Triangle& t : triangles_) {
      const auto moving = [&](int k) { return Moving{x_[t[k]], step[t[k]]}; };
      limit = std::min(limit, kShortOf * flip_time(moving(0), moving(1), moving(2)));
    }
    for (int i = 0; to_axis_ && i < static_cast<int>(angle_.size()); ++i) {
      const double along = direction(i).dot(x_[edge_end(i)] - x_[edge_start(i)]);
      const double change = direction(i).dot(step[edge_end(i)] - step[edge_start(i)]);
      if (change < 0) limit = std::min(limit, kShortOf * along / -change);
    }
    return limit;
  }
  bool factor_damped(double damping) {
    for (Mat2& block : matrix_.diagonal) block.diagonal().array() += damping;
    return matrix_.factor();
  }

  std::optional<std::vector<Vec2>> flat_result() const {
    std::vector<Vec2> flat = flattened(x_, {boundary_, turns_});
    for (const Triangle& t : triangles_) {
      if (orientation(flat[t[0]], flat[t[1]], flat[t[2]]) <= 0) return std::nullopt;
    }
    for (int i = 0; i < static_cast<int>(angle_.size()); ++i) {
      if (!(direction(i).dot(flat[edge_end(i)] - flat[edge_start(i)]) > 0)) return std::nullopt;
    }
    const double energy = distortion(x_), flat_energy = distortion(flat);
    if (!(flat_energy - energy <= kFlatEnough * (energy - 1) + 1e-6)) return std::nullopt;
    return flat;
  }

  const BoundaryAngles& boundary_;
  std::vector<int> turns_;
  std::vector<Vec2> x_;
  std::vector<Triangle> triangles_;
  std::vector<RestTriangle> rest_;
  std::vector<std::array<int, 3>> triangle_slots_;
  std::vector<double> angle_;
  std::vector<Vec2> gradient_;
  BlockLdlt matrix_;
  double perimeter_ = 0, scale_ = 1, lambda_ = 1;
  bool to_axis_ = false;
};

}  // namespace

std::vector<Vec2> flattened(const std::vector<Vec2>& uvs, const AlignTarget& target) {
  const int n = target.boundary.size();
  std::vector<Vec2> out = uvs;
  for (int axis = 0; axis < 2; ++axis) {
    // Runs of edges that keep this coordinate; start after an edge that does not.
    int start = 0;
    while (start < n && (target.quarter_turns[start] % 2 == 0) == (axis == 1)) ++start;
    for (int i = 1; i <= n; ++i) {
      const auto keeps = [&](int k) { return (target.quarter_turns[(start + k) % n] % 2 == 0) == (axis == 1); };
      if (!keeps(i) || keeps(i - 1)) continue;
      int end = i;
      double sum = 0, weight = 0;
      for (; keeps(end); ++end) {
        const int a = target.boundary.vertices[(start + end) % n], b = target.boundary.vertices[(start + end + 1) % n];
        const double length = (uvs[b] - uvs[a]).norm();
        sum += 0.5 * length * (uvs[a][axis] + uvs[b][axis]);
        weight += length;
      }
      for (int k = i; k <= end; ++k) out[target.boundary.vertices[(start + k) % n]][axis] = sum / weight;
    }
  }
  return out;
}

std::optional<AlignedShape> deform_to_axes(const Chart& chart, const AlignTarget& target, const std::function<void()>& poll) {
  return Deformation(chart, target).run(poll);
}

}  // namespace atlas_refine
