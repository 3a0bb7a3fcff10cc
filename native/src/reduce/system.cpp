// Set-up of the engine's unknowns, their measures, and steps that keep them free of flips and collisions.
#include "reduce/system.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/collision.h"
#include "measure/certificate.h"
#include "solve/contact_barrier.h"
#include "solve/symmetric_dirichlet.h"

namespace atlas_refine {
namespace {

// How far the barrier is felt beyond the gap, as a fraction of the box diagonal.
constexpr double kRangeFraction = 0.0025;
// Within a chart the barrier reaches at most this share of the boundary between the two points: else corners repel themselves.
constexpr double kRangePerArc = 0.3;
// A step moves no vertex further than this fraction of the surface's size, which bounds the search for collisions.
constexpr double kLongestMove = 0.25;

Vec2 tight_size(const std::vector<Vec2>& x, Vec2* low) {
  Vec2 min = x.front(), max = x.front();
  for (const Vec2& p : x) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
  if (low) *low = min;
  return max - min;
}

Vec2 size_of_aspect(const Vec2& size, double aspect) {
  if (aspect == 0) return size;
  const double height = std::max(size.y(), size.x() / aspect);
  return {aspect * height, height};
}

}  // namespace

ReduceSystem::ReduceSystem(const ReduceProblem& problem)
    : gap_(problem.gap), aspect_(problem.box_aspect), has_box_(problem.pe_target > 0), threads_(problem.threads) {
  double surface = 0;
  int count = 0;
  for (const Chart& chart : problem.charts) {
    first_vertex_.push_back(count);
    for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
      const Triangle& local = chart.triangles[t];
      triangles_.push_back({count + local[0], count + local[1], count + local[2]});
      rest_.push_back(chart.rest[t]);
      surface += chart.rest[t].area;
    }
    count += chart.vertex_count();
  }
  scale_ = 1 / std::sqrt(surface);
  mass_.assign(count, 0);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    rest_[t].inverse_edges /= scale_;
    rest_[t].area /= surface;
    for (int v : triangles_[t]) mass_[v] += rest_[t].area / 3;
  }
  boundary_ = make_boundary(problem.charts, first_vertex_);
  for (double& arc : boundary_.arc) arc *= scale_;
  for (double& length : boundary_.loop_length) length *= scale_;
  place_start(problem);
  measure_floors();
}

void ReduceSystem::place_start(const ReduceProblem& problem) {
  for (const Chart& chart : problem.charts) {
    for (const Vec2& uv : chart.uvs) start_.x.push_back(scale_ * uv);
  }
  Vec2 low;
  const Vec2 size = size_of_aspect(tight_size(start_.x, &low), aspect_);
  range_ = kRangeFraction * size.norm();
  open_unit_ = gap_.unit == Gap::Unit::BoxDiagonal ? size.norm() : size.maxCoeff();
  const double slack = 0.5 * range_;
  for (Vec2& x : start_.x) x += Vec2::Constant(slack) - low;
  start_.box = size_of_aspect(size + Vec2::Constant(2 * slack), aspect_);
}

double ReduceSystem::gap_unit(const Vec2& box) const {
  if (!has_box_) return open_unit_;
  return gap_.unit == Gap::Unit::BoxDiagonal ? box.norm() : box.maxCoeff();
}

double ReduceSystem::far_arc_length(const Vec2& box) const { return kFarArc * (has_box_ ? box.norm() : start_.box.norm()); }

Closest ReduceSystem::closest(const std::vector<Vec2>& x, const PointEdge& pair) const {
  return closest_on_segment(x[boundary_.vertex[pair.point]], x[boundary_.vertex[pair.edge]],
                            x[boundary_.vertex[boundary_.next[pair.edge]]]);
}

void ReduceSystem::measure_floors() {
  const double unit = gap_unit(start_.box);
  own_floor_.assign(boundary_.size(), gap_.value);
  const double far_arc = far_arc_length(start_.box);
  for (const PointEdge& pair : near_pairs(boundary_, start_.x, {}, gap_.value * unit)) {
    if (boundary_.chart[pair.point] != boundary_.chart[pair.edge] || boundary_.arc_between(pair.point, pair.edge) < far_arc)
      continue;
    const Closest nearest = closest(start_.x, pair);
    if (faces_outside(boundary_, start_.x, pair, nearest)) {
      own_floor_[pair.point] = std::min(own_floor_[pair.point], 0.999 * nearest.distance / unit);
    }
  }
}

std::vector<std::vector<Vec2>> ReduceSystem::chart_uvs(const ReduceState& state) const {
  std::vector<std::vector<Vec2>> uvs(first_vertex_.size());
  for (std::size_t c = 0; c < first_vertex_.size(); ++c) {
    const int end = c + 1 < first_vertex_.size() ? first_vertex_[c + 1] : vertex_count();
    for (int v = first_vertex_[c]; v < end; ++v) uvs[c].push_back(state.x[v] / scale_);
  }
  return uvs;
}

double ReduceSystem::distortion(const std::vector<Vec2>& x) const {
  double sum = 0;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Triangle& v = triangles_[t];
    const double energy = symmetric_dirichlet(jacobian(rest_[t], x[v[0]], x[v[1]], x[v[2]]));
    if (!std::isfinite(energy)) return std::numeric_limits<double>::infinity();
    sum += rest_[t].area * energy;
  }
  return sum;
}

double ReduceSystem::area(const std::vector<Vec2>& x) const {
  double twice = 0;
  for (int e = 0; e < boundary_.size(); ++e) {
    const Vec2& a = x[boundary_.vertex[e]];
    const Vec2& b = x[boundary_.vertex[boundary_.next[e]]];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

double ReduceSystem::box_pe(const ReduceState& state) const { return area(state.x) / state.box.prod(); }

double ReduceSystem::tight_pe(const ReduceState& state) const {
  return area(state.x) / size_of_aspect(tight_size(state.x, nullptr), aspect_).prod();
}

std::vector<Contact> ReduceSystem::contacts(const ReduceState& state, const std::vector<Vec2>& step) const {
  const double unit = gap_unit(state.box);
  const double gap = gap_.value * unit;
  const double far_arc = far_arc_length(state.box);
  std::vector<Contact> found;
  for (const PointEdge& pair : near_pairs(boundary_, state.x, step, gap + range_)) {
    Contact contact{pair, gap_.value, range_};
    const Closest nearest = closest(state.x, pair);
    if (boundary_.chart[pair.point] == boundary_.chart[pair.edge]) {
      if (!faces_outside(boundary_, state.x, pair, nearest)) continue;
      const double arc = boundary_.arc_between(pair.point, pair.edge);
      contact.floor_fraction = arc < far_arc ? 0 : own_floor_[pair.point];
      contact.range = std::min(range_, kRangePerArc * arc);
      // Borders that have turned to face each other below the floor need not part again.
      if (nearest.distance <= contact.floor_fraction * unit) contact.floor_fraction = 0.9 * nearest.distance / unit;
    }
    found.push_back(contact);
  }
  return found;
}

double ReduceSystem::barrier(const ReduceState& state, const std::vector<Contact>& contacts) const {
  const double unit = gap_unit(state.box);
  double sum = 0;
  for (const Contact& contact : contacts) {
    const Closest nearest = closest(state.x, contact.pair);
    sum += log_barrier((nearest.distance - contact.floor_fraction * unit) / contact.range).value;
  }
  if (!has_box_) return sum;
  for (int v : boundary_.vertex) {
    for (int axis = 0; axis < 2; ++axis) {
      sum += log_barrier(state.x[v][axis] / range_).value + log_barrier((state.box[axis] - state.x[v][axis]) / range_).value;
    }
  }
  return sum;
}

double ReduceSystem::least_slack(const ReduceState& state) const {
  double least = 1;
  for (const Contact& contact : contacts(state, {})) {
    const Closest nearest = closest(state.x, contact.pair);
    least = std::min(least, (nearest.distance - contact.floor_fraction * gap_unit(state.box)) / contact.range);
  }
  return least;
}

double ReduceSystem::free_step(const ReduceState& state, const std::vector<Vec2>& step) const {
  double longest = 0;
  for (int v = 0; v < vertex_count(); ++v) longest = std::max(longest, step[v].norm());
  double limit = std::min(1.0, kLongestMove / std::max(longest, 1e-300));
  const auto moving = [&](int v) { return Moving{state.x[v], step[v]}; };
  for (const Triangle& t : triangles_) limit = std::min(limit, 0.95 * flip_time(moving(t[0]), moving(t[1]), moving(t[2])));
  std::vector<Vec2> scaled(vertex_count());
  for (int v = 0; v < vertex_count(); ++v) scaled[v] = limit * step[v];
  const double whole = limit;
  for (const PointEdge& pair : near_pairs(boundary_, state.x, scaled, 0)) {
    const double hit = hit_time(moving(boundary_.vertex[pair.point]), moving(boundary_.vertex[pair.edge]),
                                moving(boundary_.vertex[boundary_.next[pair.edge]]), whole);
    limit = std::min(limit, 0.95 * hit);
  }
  return limit;
}

Vec2 ReduceSystem::box_part(const Vec2& node_step) const {
  return aspect_ == 0 ? node_step : Vec2(aspect_ * node_step.x(), node_step.x());
}

ReduceState ReduceSystem::moved(const ReduceState& state, const std::vector<Vec2>& step, double fraction) const {
  ReduceState out = state;
  for (int v = 0; v < vertex_count(); ++v) out.x[v] += fraction * step[v];
  if (has_box_) out.box += fraction * box_part(step[vertex_count()]);
  return out;
}

}  // namespace atlas_refine
