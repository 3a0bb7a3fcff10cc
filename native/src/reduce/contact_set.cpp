// Search, value and derivatives of contacts and walls.
#include "reduce/contact_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "solve/contact_barrier.h"
#include "support/gathered.h"
#include "support/profile.h"

namespace atlas_refine {
namespace {

// Within a piece the barrier reaches at most this share of the boundary between the two points: else corners repel themselves.
constexpr double kRangePerArc = 0.3;
// The floor of borders that are nearer than it already, as a part of their distance.
constexpr double kOfDistance = 0.9;
// The same at the start, which has to be inside its barrier.
constexpr double kOfFirstDistance = 0.999;
// The pattern holds pairs up to this multiple of the reach, so that it changes seldom.
constexpr double kPatternReach = 1.7;
constexpr int kGrain = 1024;  // pairs

/// Vertices of the point, the edge's start and its end.
std::array<int, 3> vertices_of(const Boundary& boundary, const PointEdge& pair) {
  return {boundary.vertex[pair.point], boundary.vertex[pair.edge], boundary.vertex[boundary.next[pair.edge]]};
}

Closest closest(const Boundary& boundary, const std::vector<Vec2>& x, const PointEdge& pair) {
  const auto [point, start, end] = vertices_of(boundary, pair);
  return closest_on_segment(x[point], x[start], x[end]);
}

bool of_one_piece(const Boundary& boundary, const PointEdge& pair) {
  return boundary.chart[pair.point] == boundary.chart[pair.edge];
}

double weight(const ReduceModel& model, const PointEdge& pair) {
  return model.point_weight[pair.point] * model.edge_weight[pair.edge];
}

ContactDerivatives derivatives(const ReduceModel& model, const ReduceState& state, const Contact& contact, double unit) {
  const auto [point, start, end] = vertices_of(model.boundary, contact.pair);
  ContactDerivatives d =
      contact_derivatives(state.x[point], state.x[start], state.x[end], contact.floor_fraction * unit, contact.range);
  if (const double part = weight(model, contact.pair); part < 1) d.scale(part);
  return d;
}

/// Adds the gradient and the Hessian by a contact's vertices where their nodes, and the box that takes them along, have it.
void add_to_nodes(const ReduceModel& model, const std::array<int, 3>& vertices, const ContactDerivatives& d, double stiffness,
                  BlockSystem& system) {
  const bool with_box = !model.ride.empty() || !model.lever.empty();
  for (int i = 0; i < 3; ++i) {
    const int v = vertices[i];
    const Vec2 gradient = stiffness * d.gradient[i];
    const bool own = !hangs_on_box(model, v);
    if (own) system.gradient[model.node[v]] += gradient;
    Mat2 by_box = Mat2::Zero();
    for (int j = 0; j < 3; ++j) {
      const Mat2 block = stiffness * d.hessian[i][j];
      if (own && !hangs_on_box(model, vertices[j])) system.matrix.add(model.node[v], model.node[vertices[j]], block);
      if (with_box) by_box += block * moved_by_box(model, vertices[j]);
    }
    if (!with_box) continue;
    const Mat2 moved = moved_by_box(model, v).transpose();
    system.gradient[model.box_node()] += moved * gradient;
    system.matrix.diagonal[model.box_node()] += moved * by_box;
    if (own) system.matrix.add(model.node[v], model.box_node(), by_box);
  }
}

/// Adds what the walls do to a vertex: its own gradient and Hessian, and the Hessian by it and the box.
void add_wall(const ReduceModel& model, int vertex, const Vec2& gradient, const Mat2& own, const Mat2& coupling,
              BlockSystem& system) {
  const int node = model.node[vertex], box_node = model.box_node();
  system.gradient[node] += gradient;
  system.matrix.diagonal[node] += own;
  if (model.ride.empty()) {
    system.matrix.add(node, box_node, coupling);
    return;
  }
  const Mat2 along = moved_by_box(model, vertex);
  const Mat2 mixed = along.transpose() * coupling;
  system.gradient[box_node] += along.transpose() * gradient;
  system.matrix.diagonal[box_node] += along.transpose() * own * along + mixed + mixed.transpose();
  system.matrix.add(node, box_node, coupling + own * along);
}

/// The gap, or what is noted of the vertex and an edge around there.
double floor_between(const ReduceModel& model, const PointEdge& pair) {
  const auto by_vertex = [](const NearBorder& near, int vertex) { return near.vertex < vertex; };
  auto at = std::lower_bound(model.near_borders.begin(), model.near_borders.end(), pair.point, by_vertex);
  double floor = model.gap.value;
  for (; at != model.near_borders.end() && at->vertex == pair.point; ++at) {
    if (model.boundary.arc_between(at->edge, pair.edge) < model.far_arc) floor = std::min(floor, at->floor);
  }
  return floor;
}

/// A contact between two borders of one piece.
Contact within_piece(const ReduceModel& model, const PointEdge& pair) {
  const double arc = model.boundary.arc_between(pair.point, pair.edge);
  return {pair, arc < model.far_arc ? 0 : floor_between(model, pair), std::min(model.range, kRangePerArc * arc)};
}

/// How much nearer to each other a step may bring the two.
double longest_approach(const Boundary& boundary, const PointEdge& pair, const std::vector<Vec2>& step) {
  if (step.empty()) return 0;
  const auto [point, start, end] = vertices_of(boundary, pair);
  return std::sqrt(std::max((step[point] - step[start]).squaredNorm(), (step[point] - step[end]).squaredNorm()));
}

/// The distance from which on a contact within a piece neither is felt nor may lower a floor. Neighbours along the boundary are
/// felt at a fraction of what borders that face each other are, and are most of all pairs.
double farthest_felt(const ReduceModel& model, const Contact& contact, double unit, bool at_rest) {
  if (contact.floor_fraction == 0) return contact.range;
  if (!at_rest) return std::numeric_limits<double>::infinity();  // the unit changes with the box
  return std::max(contact.floor_fraction * unit + contact.range, model.gap.value * unit / kOfDistance);
}

/// Slack of a contact beyond its floor, in its range.
double slack(const ReduceModel& model, const ReduceState& state, const Contact& contact, double unit) {
  const Closest nearest = closest(model.boundary, state.x, contact.pair);
  return (nearest.distance - contact.floor_fraction * unit) / contact.range;
}

/// Nothing where the two are not felt now nor along the step.
std::optional<Contact> contact_of(const ReduceModel& model, const ReduceState& state, const PointEdge& pair,
                                  const std::vector<Vec2>& step, double unit) {
  if (moves_as_one(model, pair)) return std::nullopt;
  if (!of_one_piece(model.boundary, pair)) return Contact{pair, model.gap.value, model.range};
  const Closest nearest = closest(model.boundary, state.x, pair);
  Contact contact = within_piece(model, pair);
  const double least = nearest.distance - longest_approach(model.boundary, pair, step);
  if (least >= farthest_felt(model, contact, unit, step.empty())) return std::nullopt;
  if (!faces_outside(model.boundary, state.x, pair, nearest)) return std::nullopt;
  // Borders that have turned to face each other below the floor need not part again.
  if (nearest.distance <= contact.floor_fraction * unit) contact.floor_fraction = kOfDistance * nearest.distance / unit;
  return contact;
}

}  // namespace

std::vector<NearBorder> measure_near_borders(const ReduceModel& model) {
  const Boundary& boundary = model.boundary;
  const std::vector<Vec2>& x = model.start.x;
  const double unit = gap_unit(model, model.start.box);
  std::vector<NearBorder> near;
  for (const PointEdge& pair : near_pairs(boundary, x, {}, model.gap.value * unit)) {
    if (moves_as_one(model, pair) || !of_one_piece(boundary, pair) || boundary.arc_between(pair.point, pair.edge) < model.far_arc)
      continue;
    const Closest nearest = closest(boundary, x, pair);
    const double floor = kOfFirstDistance * nearest.distance / unit;
    if (floor < model.gap.value && faces_outside(boundary, x, pair, nearest)) near.push_back({pair.point, pair.edge, floor});
  }
  return near;
}

ContactSet find_contacts(const ReduceModel& model, const ReduceState& state, const std::vector<Vec2>& step) {
  const PhaseScope scope(Phase::Contacts);
  const double unit = gap_unit(model, state.box);
  const auto pairs = model.near.find(model.boundary, state.x, step, model.gap.value * unit + model.range);
  return gathered<Contact>(static_cast<int>(pairs.size()), kGrain, [&](int begin, int end, auto& found) {
    for (int k = begin; k < end; ++k) {
      if (const auto contact = contact_of(model, state, pairs[k], step, unit)) found.push_back(*contact);
    }
  });
}

void note_near_borders(const ReduceState& state, const ContactSet& contacts, ReduceModel& model) {
  const double unit = gap_unit(model, state.box), gap = model.gap.value;
  std::vector<NearBorder> near;  // ordered by vertex, as contacts are
  for (const Contact& contact : contacts) {
    if (contact.floor_fraction == 0 || !of_one_piece(model.boundary, contact.pair)) continue;
    const double floor = kOfDistance * closest(model.boundary, state.x, contact.pair).distance / unit;
    if (floor < gap) near.push_back({contact.pair.point, contact.pair.edge, std::max(floor, contact.floor_fraction)});
  }
  model.near_borders = std::move(near);
}

double barrier(const ReduceModel& model, const ReduceState& state, const ContactSet& contacts) {
  const double unit = gap_unit(model, state.box);
  // Most are too far apart to be felt.
  const auto felt = gathered<double>(static_cast<int>(contacts.size()), kGrain, [&](int begin, int end, auto& values) {
    for (int k = begin; k < end; ++k) {
      const double value = weight(model, contacts[k].pair) * log_barrier_value(slack(model, state, contacts[k], unit));
      if (value != 0) values.push_back(value);
    }
  });
  double sum = std::accumulate(felt.begin(), felt.end(), 0.0);
  if (!model.has_box) return sum;
  for (int b = 0; b < model.boundary.size(); ++b) {
    const int v = model.boundary.vertex[b];
    if (hangs_on_box(model, v)) continue;
    for (int axis = 0; axis < 2; ++axis) {
      sum += model.point_weight[b] * (log_barrier_value(state.x[v][axis] / model.range) +
                                      log_barrier_value((state.box[axis] - state.x[v][axis]) / model.range));
    }
  }
  return sum;
}

double least_slack(const ReduceModel& model, const ReduceState& state) {
  const double unit = gap_unit(model, state.box);
  double least = 1;
  for (const Contact& contact : find_contacts(model, state)) least = std::min(least, slack(model, state, contact, unit));
  return least;
}

std::vector<std::pair<int, int>> coupled_nodes(const ReduceModel& model, const ReduceState& state, const ContactSet& contacts) {
  const PhaseScope scope(Phase::Contacts);
  const Boundary& boundary = model.boundary;
  std::vector<std::pair<int, int>> pairs;
  const auto add_nodes = [&](int a, int b) {
    if (model.node[a] != model.node[b]) pairs.emplace_back(model.node[a], model.node[b]);
  };
  const auto add = [&](const PointEdge& pair) {
    const auto [point, start, end] = vertices_of(boundary, pair);
    add_nodes(point, start);
    add_nodes(point, end);
  };
  for (const Contact& contact : contacts) add(contact.pair);
  const double unit = gap_unit(model, state.box);
  const double reach = kPatternReach * (model.gap.length(state.box) + model.range);
  for (const PointEdge& pair : near_pairs(boundary, state.x, {}, reach)) {
    if (moves_as_one(model, pair)) continue;
    if (of_one_piece(boundary, pair)) {
      const Closest nearest = closest(boundary, state.x, pair);
      const double felt = kPatternReach * farthest_felt(model, within_piece(model, pair), unit, true);
      if (nearest.distance >= felt || !faces_outside(boundary, state.x, pair, nearest)) continue;
    }
    add(pair);
  }
  if (model.has_box) {
    for (int v : boundary.vertex) {
      if (!hangs_on_box(model, v)) pairs.emplace_back(model.node[v], model.box_node());
    }
  }
  return pairs;
}

bool covers(const BlockCholesky& matrix, const ReduceModel& model, const ContactSet& contacts) {
  const auto has = [&](int a, int b) { return model.node[a] == model.node[b] || matrix.slot(model.node[a], model.node[b]) >= 0; };
  return matrix.node_count() > 0 && std::all_of(contacts.begin(), contacts.end(), [&](const Contact& contact) {
           const auto [point, start, end] = vertices_of(model.boundary, contact.pair);
           return has(point, start) && has(point, end);
         });
}

void add_contacts(const ReduceModel& model, const ReduceState& state, const ContactSet& contacts, double stiffness,
                  BlockSystem& system) {
  const double unit = gap_unit(model, state.box);
  double unit_slope = 0;  // d barrier / d gap unit
  for (const Contact& contact : contacts) {
    const ContactDerivatives d = derivatives(model, state, contact, unit);
    if (d.value == 0) continue;
    const std::array<int, 3> v = vertices_of(model.boundary, contact.pair);
    unit_slope -= d.slope * contact.floor_fraction;
    add_to_nodes(model, v, d, stiffness, system);
  }
  if (!model.has_box) return;
  Vec2 unit_gradient;
  if (model.gap.unit == Gap::Unit::BoxDiagonal)
    unit_gradient = state.box / state.box.norm();
  else
    unit_gradient = state.box.x() >= state.box.y() ? Vec2(1, 0) : Vec2(0, 1);
  system.gradient[model.box_node()] += on_box_node(model, stiffness * unit_slope * unit_gradient);
}

void add_walls(const ReduceModel& model, const ReduceState& state, double full_stiffness, BlockSystem& system) {
  const int box_node = model.box_node();
  const double aspect = model.aspect, range = model.range;
  Vec2 sides = Vec2::Zero(), sides_stiff = Vec2::Zero();  // by width and height
  for (int b = 0; b < model.boundary.size(); ++b) {
    const int v = model.boundary.vertex[b];
    if (hangs_on_box(model, v)) continue;
    const double stiffness = full_stiffness * model.point_weight[b];
    Vec2 gradient;
    Mat2 own = Mat2::Zero(), coupling = Mat2::Zero();  // rows: vertex; columns of the coupling: sides
    for (int axis = 0; axis < 2; ++axis) {
      const BarrierValue low = log_barrier(state.x[v][axis] / range);
      const BarrierValue high = log_barrier((state.box[axis] - state.x[v][axis]) / range);
      gradient[axis] = stiffness * (low.slope - high.slope) / range;
      const double low_stiff = stiffness * low.curvature / (range * range);
      const double high_stiff = stiffness * high.curvature / (range * range);
      own(axis, axis) = low_stiff + high_stiff;
      sides[axis] += stiffness * high.slope / range;
      sides_stiff[axis] += high_stiff;
      coupling(axis, axis) = -high_stiff;
    }
    if (gradient.isZero(0) && own.isZero(0)) continue;
    if (aspect > 0) {
      coupling(0, 0) *= aspect;
      coupling(1, 0) = coupling(1, 1);
      coupling.col(1).setZero();
    }
    add_wall(model, v, gradient, own, coupling, system);
  }
  system.gradient[box_node] += on_box_node(model, sides);
  if (aspect == 0) {
    system.matrix.diagonal[box_node] += sides_stiff.asDiagonal();
  } else {
    system.matrix.diagonal[box_node](0, 0) += aspect * aspect * sides_stiff.x() + sides_stiff.y();
    system.matrix.diagonal[box_node](1, 1) += 1;  // an empty equation keeps the node two wide
  }
}

std::vector<Vec2> contact_forces(const ReduceModel& model, const ReduceState& state, const ContactSet& contacts,
                                 double stiffness) {
  const double unit = gap_unit(model, state.box);
  std::vector<Vec2> forces(model.vertex_count(), Vec2::Zero());
  for (const Contact& contact : contacts) {
    const ContactDerivatives d = derivatives(model, state, contact, unit);
    if (d.value == 0) continue;
    const std::array<int, 3> v = vertices_of(model.boundary, contact.pair);
    for (int i = 0; i < 3; ++i) forces[v[i]] -= stiffness * d.gradient[i];
  }
  return forces;
}

}  // namespace atlas_refine
