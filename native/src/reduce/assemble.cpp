// Gradient and projected Hessian of the engine's objective, assembled block by block.
#include <algorithm>
#include <array>

#include "reduce/system.h"
#include "solve/contact_barrier.h"
#include "solve/symmetric_dirichlet.h"
#include "support/parallel.h"

namespace atlas_refine {
namespace {

// The pattern holds pairs up to this multiple of the reach, so that it changes seldom.
constexpr double kPatternReach = 1.7;

}  // namespace

void ReduceSystem::assemble(const ReduceState& state, const std::vector<Contact>& contacts, double stiffness) {
  ensure_pattern(state, contacts);
  const int nodes = vertex_count() + (has_box_ ? 1 : 0);
  energy_gradient.assign(nodes, Vec2::Zero());
  pe_gradient.assign(nodes, Vec2::Zero());
  matrix.set_zero();
  add_triangles(state);
  add_contacts(state, contacts, stiffness);
  if (!has_box_) return;
  add_walls(state, stiffness);
  add_pe_gradient(state);
}

void ReduceSystem::damp(double damping) {
  for (int v = 0; v < vertex_count(); ++v) matrix.diagonal[v].diagonal().array() += damping * mass_[v];
  if (has_box_) matrix.diagonal[vertex_count()].diagonal().array() += damping;
}

void ReduceSystem::ensure_pattern(const ReduceState& state, const std::vector<Contact>& contacts) {
  const bool known = matrix.node_count() > 0 && std::all_of(contacts.begin(), contacts.end(), [&](const Contact& contact) {
                       const int point = boundary_.vertex[contact.pair.point];
                       const int start = boundary_.vertex[contact.pair.edge],
                                 end = boundary_.vertex[boundary_.next[contact.pair.edge]];
                       return matrix.slot(point, start) >= 0 && matrix.slot(point, end) >= 0;
                     });
  if (known) return;
  std::vector<std::pair<int, int>> edges;
  for (const Triangle& t : triangles_) {
    for (int k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
  }
  const auto add = [&](const PointEdge& pair) {
    edges.emplace_back(boundary_.vertex[pair.point], boundary_.vertex[pair.edge]);
    edges.emplace_back(boundary_.vertex[pair.point], boundary_.vertex[boundary_.next[pair.edge]]);
  };
  for (const Contact& contact : contacts) add(contact.pair);
  for (const PointEdge& pair : near_pairs(boundary_, state.x, {}, kPatternReach * (gap_.length(state.box) + range_))) {
    const Closest nearest = closest(state.x, pair);
    if (boundary_.chart[pair.point] != boundary_.chart[pair.edge] || faces_outside(boundary_, state.x, pair, nearest)) add(pair);
  }
  const int box_node = vertex_count();
  if (has_box_) {
    for (int v : boundary_.vertex) edges.emplace_back(v, box_node);
  }
  matrix.analyse(vertex_count() + (has_box_ ? 1 : 0), edges, has_box_ ? box_node : -1);
  triangle_slots_.resize(triangles_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (int k = 0; k < 3; ++k) triangle_slots_[t][k] = matrix.slot(triangles_[t][k], triangles_[t][(k + 1) % 3]);
  }
}

void ReduceSystem::add_triangles(const ReduceState& state) {
  constexpr int kBlock = 4096;  // bounds the buffer; the sums run in triangle order whatever the number of threads
  std::vector<TriangleDerivatives> buffer(std::min<std::size_t>(kBlock, triangles_.size()));
  const int count = static_cast<int>(triangles_.size());
  for (int begin = 0; begin < count; begin += kBlock) {
    const int end = std::min(count, begin + kBlock);
    parallel_ranges(end - begin, threads_, kBlock / 4, [&](int from, int to) {
      for (int k = from; k < to; ++k) {
        const Triangle& v = triangles_[begin + k];
        buffer[k] = symmetric_dirichlet_derivatives(rest_[begin + k], state.x[v[0]], state.x[v[1]], state.x[v[2]]);
      }
    });
    for (int t = begin; t < end; ++t) {
      const TriangleDerivatives& d = buffer[t - begin];
      const double weight = rest_[t].area;
      for (int k = 0; k < 3; ++k) {
        const int i = triangles_[t][k], j = triangles_[t][(k + 1) % 3];
        energy_gradient[i] += weight * d.gradient[k];
        matrix.diagonal[i] += weight * d.diagonal[k];
        Mat2& block = matrix.off_diagonal[triangle_slots_[t][k]];
        if (i < j)
          block += weight * d.off_diagonal[k];
        else
          block += weight * d.off_diagonal[k].transpose();
      }
    }
  }
}

void ReduceSystem::add_block(int i, int j, const Mat2& block) {
  if (i == j)
    matrix.diagonal[i] += block;
  else if (i < j)
    matrix.off_diagonal[matrix.slot(i, j)] += block;
}

void ReduceSystem::add_contacts(const ReduceState& state, const std::vector<Contact>& contacts, double stiffness) {
  const double unit = gap_unit(state.box);
  double unit_slope = 0;  // d barrier / d gap unit
  for (const Contact& contact : contacts) {
    const std::array<int, 3> v = {boundary_.vertex[contact.pair.point], boundary_.vertex[contact.pair.edge],
                                  boundary_.vertex[boundary_.next[contact.pair.edge]]};
    const ContactDerivatives d =
        contact_derivatives(state.x[v[0]], state.x[v[1]], state.x[v[2]], contact.floor_fraction * unit, contact.range);
    if (d.value == 0) continue;
    unit_slope -= d.slope * contact.floor_fraction;
    for (int i = 0; i < 3; ++i) {
      energy_gradient[v[i]] += stiffness * d.gradient[i];
      for (int j = 0; j < 3; ++j) add_block(v[i], v[j], stiffness * d.hessian[i][j]);
    }
  }
  if (!has_box_) return;
  Vec2 unit_gradient;
  if (gap_.unit == Gap::Unit::BoxDiagonal)
    unit_gradient = state.box / state.box.norm();
  else
    unit_gradient = state.box.x() >= state.box.y() ? Vec2(1, 0) : Vec2(0, 1);
  const Vec2 sides = stiffness * unit_slope * unit_gradient;
  energy_gradient[vertex_count()] += aspect_ == 0 ? sides : Vec2(aspect_ * sides.x() + sides.y(), 0);
}

void ReduceSystem::add_walls(const ReduceState& state, double stiffness) {
  const int box_node = vertex_count();
  Vec2 sides = Vec2::Zero();  // gradient by width and height
  Vec2 sides_stiff = Vec2::Zero();
  for (int v : boundary_.vertex) {
    Mat2 coupling = Mat2::Zero();  // rows: vertex, columns: sides
    for (int axis = 0; axis < 2; ++axis) {
      const BarrierValue low = log_barrier(state.x[v][axis] / range_);
      const BarrierValue high = log_barrier((state.box[axis] - state.x[v][axis]) / range_);
      energy_gradient[v][axis] += stiffness * (low.slope - high.slope) / range_;
      const double low_stiff = stiffness * low.curvature / (range_ * range_);
      const double high_stiff = stiffness * high.curvature / (range_ * range_);
      matrix.diagonal[v](axis, axis) += low_stiff + high_stiff;
      sides[axis] += stiffness * high.slope / range_;
      sides_stiff[axis] += high_stiff;
      coupling(axis, axis) = -high_stiff;
    }
    if (coupling(0, 0) == 0 && coupling(1, 1) == 0) continue;
    if (aspect_ > 0) {
      coupling(0, 0) *= aspect_;
      coupling(1, 0) = coupling(1, 1);
      coupling.col(1).setZero();
    }
    matrix.off_diagonal[matrix.slot(v, box_node)] += coupling;
  }
  if (aspect_ == 0) {
    energy_gradient[box_node] += sides;
    matrix.diagonal[box_node] += sides_stiff.asDiagonal();
  } else {
    energy_gradient[box_node] += Vec2(aspect_ * sides.x() + sides.y(), 0);
    matrix.diagonal[box_node](0, 0) += aspect_ * aspect_ * sides_stiff.x() + sides_stiff.y();
    matrix.diagonal[box_node](1, 1) += 1;  // an empty equation keeps the node two wide
  }
}

void ReduceSystem::add_pe_gradient(const ReduceState& state) {
  const double area = this->area(state.x);
  for (int e = 0; e < boundary_.size(); ++e) {
    const Vec2 chord = state.x[boundary_.vertex[boundary_.next[e]]] - state.x[boundary_.vertex[boundary_.previous[e]]];
    pe_gradient[boundary_.vertex[e]] += Vec2(chord.y(), -chord.x()) / (2 * area);
  }
  const Vec2 sides = -state.box.cwiseInverse();
  pe_gradient[vertex_count()] += aspect_ == 0 ? sides : Vec2(aspect_ * sides.x() + sides.y(), 0);
}

}  // namespace atlas_refine
