// Projected Newton on E_d + lambda * alignment.
#include "align/deform.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/plane.h"
#include "geometry/predicates.h"
#include "measure/distortion.h"
#include "solve/newton.h"

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
constexpr Damping kDamping = {1e-9, 100, 1e3};

/// A boundary edge on its way to its target. Lengths are such that the surface has area 1.
struct Edge {
  int from, to;
  double share;   // of the boundary's length
  double length;  // in the input
  int quarter_turns;
  double angle_rad;  // at present

  double off_target() const { return angle_rad - kQuarter * quarter_turns; }
  Vec2 direction() const {
    const int d = ((quarter_turns % 4) + 4) % 4;
    const double sign = d < 2 ? 1 : -1;
    return d % 2 == 0 ? Vec2(sign, 0) : Vec2(0, sign);
  }
  /// Across its target axis.
  Vec2 normal() const { return quarter_turns % 2 == 0 ? Vec2(0, 1) : Vec2(1, 0); }
  Vec2 vector(const std::vector<Vec2>& x) const { return x[to] - x[from]; }
  /// What is left of it along its target axis.
  double along(const std::vector<Vec2>& x) const { return direction().dot(vector(x)); }
  bool is_shrunken(const std::vector<Vec2>& x) const { return along(x) < kShrunken * length; }
};

std::vector<Edge> edges_of(const AlignTarget& target, double scale) {
  const BoundaryAngles& boundary = target.boundary;
  const double perimeter = boundary.perimeter();
  std::vector<Edge> edges;
  for (int i = 0; i < boundary.size(); ++i) {
    edges.push_back({.from = boundary.vertices[i],
                     .to = boundary.vertices[(i + 1) % boundary.size()],
                     .share = boundary.lengths[i] / perimeter,
                     .length = scale * boundary.lengths[i],
                     .quarter_turns = target.quarter_turns[i],
                     .angle_rad = boundary.angle_rad[i]});
  }
  return edges;
}

std::vector<int> quarter_turns_of(const std::vector<Edge>& edges) {
  std::vector<int> turns;
  for (const Edge& edge : edges) turns.push_back(edge.quarter_turns);
  return turns;
}

double largest_turn(const std::vector<Edge>& edges) {
  double largest = 0;
  for (const Edge& edge : edges) largest = std::max(largest, std::abs(edge.off_target()));
  return largest;
}

/// Shrunken edges beside a corner take the direction on its other side; false where none can.
bool slide_corners(std::vector<Edge>& edges, const std::vector<Vec2>& x) {
  const int n = static_cast<int>(edges.size());
  bool any = false;
  for (int i = 0; i < n; ++i) {
    Edge& edge = edges[i];
    if (!edge.is_shrunken(x)) continue;
    const int before = i > 0 ? edges[i - 1].quarter_turns : edges[n - 1].quarter_turns - 4;
    const int after = i + 1 < n ? edges[i + 1].quarter_turns : edges[0].quarter_turns + 4;
    const int own = edge.quarter_turns;
    const auto off = [&](int label) { return std::abs(edge.angle_rad - kQuarter * label); };
    for (const int label : {before, after}) {
      const bool allowed = label - before <= 1 && after - label <= 1 && label - before >= -2 && after - label >= -2;
      if (label == own || !allowed) continue;
      if (edge.quarter_turns == own || off(label) < off(edge.quarter_turns)) edge.quarter_turns = label;
    }
    any = any || edge.quarter_turns != own;
  }
  return any;
}

/// Polar angle of an edge at `x`, continued from the present one at `before`: no edge turns by more than pi in one step.
double angle_at(const Edge& edge, const std::vector<Vec2>& before, const std::vector<Vec2>& x) {
  const Vec2 old = edge.vector(before), present = edge.vector(x);
  return edge.angle_rad + std::atan2(cross(old, present), old.dot(present));
}

/// How the boundary is pulled: eq. (8)'s angle term, or in its place the deviation from the axis.
struct Pull {
  double lambda = 1;
  bool to_axis = false;
};

/// Eq. (8) without lambda.
double alignment(const std::vector<Edge>& edges, bool to_axis, const std::vector<Vec2>& before, const std::vector<Vec2>& x) {
  double sum = 0;
  for (const Edge& edge : edges) {
    const double off =
        to_axis ? edge.normal().dot(edge.vector(x)) / edge.length : angle_at(edge, before, x) - kQuarter * edge.quarter_turns;
    sum += 0.5 * edge.share * off * off;
  }
  return sum;
}

double length_term(const std::vector<Edge>& edges, const std::vector<Vec2>& x) {
  double sum = 0;
  for (const Edge& edge : edges) {
    const double off = edge.vector(x).norm() / edge.length - 1;
    sum += 0.5 * kLengthWeight * edge.share * off * off;
  }
  return sum;
}

/// Residuals r with weight w: gradient w r dr, Gauss-Newton Hessian w dr dr^T.
void add_edge(const Edge& edge, const Pull& pull, const std::vector<Vec2>& x, BlockSystem& system) {
  const Vec2 vector = edge.vector(x);
  const double length = vector.norm();
  const auto add_residual = [&](double weight, double residual, const Vec2& slope) {
    const Mat2 stiff = weight * slope * slope.transpose();
    system.gradient[edge.to] += weight * residual * slope;
    system.gradient[edge.from] -= weight * residual * slope;
    system.matrix.diagonal[edge.from] += stiff;
    system.matrix.diagonal[edge.to] += stiff;
    system.matrix.off_diagonal[system.matrix.slot(edge.from, edge.to)] -= stiff;
  };
  add_residual(kLengthWeight * edge.share, length / edge.length - 1, vector / (length * edge.length));
  if (pull.to_axis)
    add_residual(pull.lambda * edge.share, edge.normal().dot(vector) / edge.length, edge.normal() / edge.length);
  else
    add_residual(pull.lambda * edge.share, edge.off_target(), Vec2(-vector.y(), vector.x()) / (length * length));
}

/// Short of the first edge that would run against its direction.
double forward_fraction(const std::vector<Edge>& edges, const std::vector<Vec2>& x, const std::vector<Vec2>& step, double limit) {
  for (const Edge& edge : edges) {
    const double change = edge.along(step);
    if (change < 0) limit = std::min(limit, kShortOf * edge.along(x) / -change);
  }
  return limit;
}

/// The chart while it is deformed, in units in which its surface has area 1.
class Deformation {
 public:
  Deformation(const Chart& chart, const AlignTarget& target)
      : boundary_(target.boundary), triangles_(chart.triangles), objective_(make_objective({chart})) {
    const double scale = dirichlet_sums(chart).best_scale() / objective_.unit;
    for (const Vec2& uv : chart.uvs) x_.push_back(scale * uv);
    edges_ = edges_of(target, scale);
    masses_.assign(x_.size(), 1);
    system_.matrix.analyse(static_cast<int>(x_.size()), triangle_sides(triangles_));
    slots_ = triangle_slots(system_.matrix, triangles_);
  }

  std::optional<AlignedShape> run(const std::function<void()>& poll) {
    pull_.lambda = std::clamp(distortion(x_) / std::max(alignment(edges_, false, x_, x_), 1e-12), 1.0, 100.0);
    for (int slide = 0; slide <= kMostSlides; ++slide) {
      if (!turn(poll)) return std::nullopt;
      if (auto flat = draw(poll)) return AlignedShape{std::move(*flat), quarter_turns_of(edges_)};
      if (!slide_corners(edges_, x_)) return std::nullopt;
      pull_ = {kSlideLambda, false};
    }
    return std::nullopt;
  }

 private:
  double distortion(const std::vector<Vec2>& x) const { return dirichlet_energy(objective_, triangles_, x); }

  /// Turns the edges towards their directions with a growing lambda; false where they do not follow.
  bool turn(const std::function<void()>& poll) {
    for (int round = 0; round < kTurnRounds && largest_turn(edges_) > kTurned; ++round) {
      for (int k = 0; k < kTurnIterations && largest_turn(edges_) > kTurned; ++k) {
        poll();
        if (!iterate()) return false;
      }
      pull_.lambda *= kGrowth;
    }
    return largest_turn(edges_) < 1;
  }

  /// Draws the edges to their axes until they can be laid flat; nothing where one is in the way.
  std::optional<std::vector<Vec2>> draw(const std::function<void()>& poll) {
    for (pull_ = {std::max(pull_.lambda, 100.0), true}; pull_.lambda < kMostLambda; pull_.lambda *= kAxisGrowth) {
      poll();
      if (!iterate()) return std::nullopt;
      if (auto flat = flat_result()) return flat;
      if (std::any_of(edges_.begin(), edges_.end(), [&](const Edge& edge) { return edge.is_shrunken(x_); })) return std::nullopt;
    }
    return std::nullopt;
  }

  double merit(const std::vector<Vec2>& x) const {
    return distortion(x) + length_term(edges_, x) + pull_.lambda * alignment(edges_, pull_.to_axis, x_, x);
  }

  /// One Newton step with a line search; false where none reduces the objective.
  bool iterate() {
    system_.set_zero();
    add_dirichlet(objective_, triangles_, slots_, x_, 1, system_);
    for (const Edge& edge : edges_) add_edge(edge, pull_, x_, system_);
    if (!factor_damped(system_, masses_, kDamping)) return false;
    const std::vector<Vec2> step = newton_direction(system_);
    const double slope = dot(system_.gradient, step);
    double limit = flip_free_fraction(triangles_, x_, step, 1, kShortOf);
    if (pull_.to_axis) limit = forward_fraction(edges_, x_, step, limit);
    std::vector<Vec2> trial;
    const auto merit_at = [&](double fraction) {
      trial = x_;
      for (std::size_t v = 0; v < trial.size(); ++v) trial[v] += fraction * step[v];
      return merit(trial);
    };
    const double before = merit(x_);
    if (line_search(limit, before, slope, merit_at) == 0) return slope > -1e-9 * std::abs(before);  // at the minimum already
    for (Edge& edge : edges_) edge.angle_rad = angle_at(edge, x_, trial);
    x_ = std::move(trial);
    return true;
  }

  /// The chart with its boundary laid flat, if that is next to nothing more.
  std::optional<std::vector<Vec2>> flat_result() const {
    std::vector<Vec2> flat = flattened(x_, {boundary_, quarter_turns_of(edges_)});
    for (const Triangle& t : triangles_) {
      if (orientation(flat[t[0]], flat[t[1]], flat[t[2]]) <= 0) return std::nullopt;
    }
    for (const Edge& edge : edges_) {
      if (!(edge.along(flat) > 0)) return std::nullopt;
    }
    const double energy = distortion(x_), flat_energy = distortion(flat);
    if (!(flat_energy - energy <= kFlatEnough * (energy - 1) + 1e-6)) return std::nullopt;
    return flat;
  }

  const BoundaryAngles& boundary_;
  const std::vector<Triangle>& triangles_;
  Objective objective_;
  std::vector<Edge> edges_;
  std::vector<Vec2> x_;
  std::vector<double> masses_;  // for the damping
  TriangleSlots slots_;
  BlockSystem system_;
  Pull pull_;
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
