// The unknowns of the engine (all UV vertices and the box), their energy, its derivatives and the contact pairs.
#pragma once

#include <vector>

#include "geometry/boundary.h"
#include "reduce/reduce.h"
#include "solve/block_ldlt.h"

namespace atlas_refine {

/// Positions of all vertices, and the box [0, width] x [0, height] that holds them.
struct ReduceState {
  std::vector<Vec2> x;
  Vec2 box = Vec2::Zero();
};

/// A pair that the barrier keeps apart: distance > floor_fraction * gap unit, felt below floor + range.
struct Contact {
  PointEdge pair;
  double floor_fraction;
  double range;
};

/// Everything about one atlas that does not change between iterations, and what one iteration assembles. All lengths are scaled
/// so that the surface has area 1; E_d is then the sum over triangles of weight * energy.
class ReduceSystem {
 public:
  explicit ReduceSystem(const ReduceProblem& problem);

  ReduceState start() const { return start_; }
  std::vector<std::vector<Vec2>> chart_uvs(const ReduceState& state) const;

  double distortion(const std::vector<Vec2>& x) const;  ///< E_d; infinite with a flip
  double area(const std::vector<Vec2>& x) const;
  double box_pe(const ReduceState& state) const;    ///< against the unknown box
  double tight_pe(const ReduceState& state) const;  ///< against the bounding box of the vertices, of the asked aspect

  /// Pairs that can come into the barrier's reach while `state` moves along `step` (may be empty).
  std::vector<Contact> contacts(const ReduceState& state, const std::vector<Vec2>& step) const;
  double barrier(const ReduceState& state, const std::vector<Contact>& contacts) const;
  /// Smallest distance beyond its floor of any contact, as a fraction of its range; at most 1.
  double least_slack(const ReduceState& state) const;

  /// Gradients of E + stiffness * barrier and of log PE, and the projected Hessian of the former in `matrix`.
  /// Node vertex_count() is the box where there is one.
  void assemble(const ReduceState& state, const std::vector<Contact>& contacts, double stiffness);
  std::vector<Vec2> energy_gradient;
  std::vector<Vec2> pe_gradient;
  BlockLdlt matrix;
  /// Adds damping times the vertex masses to the diagonal.
  void damp(double damping);

  /// Largest fraction of `step` free of flips and collisions, at most 1.
  double free_step(const ReduceState& state, const std::vector<Vec2>& step) const;
  /// state + fraction * step; `box_step` as it comes from the box node.
  ReduceState moved(const ReduceState& state, const std::vector<Vec2>& step, double fraction) const;

  bool has_box() const { return has_box_; }
  int vertex_count() const { return static_cast<int>(start_.x.size()); }
  double range() const { return range_; }
  const Boundary& boundary() const { return boundary_; }

 private:
  Vec2 box_part(const Vec2& node_step) const;  // sides from the box node's two values
  double gap_unit(const Vec2& box) const;
  Closest closest(const std::vector<Vec2>& x, const PointEdge& pair) const;
  double far_arc_length(const Vec2& box) const;
  void place_start(const ReduceProblem& problem);
  void measure_floors();
  void ensure_pattern(const ReduceState& state, const std::vector<Contact>& contacts);
  void add_triangles(const ReduceState& state);
  void add_contacts(const ReduceState& state, const std::vector<Contact>& contacts, double stiffness);
  void add_walls(const ReduceState& state, double stiffness);
  void add_pe_gradient(const ReduceState& state);
  void add_block(int i, int j, const Mat2& block);

  ReduceState start_;
  std::vector<int> first_vertex_;
  std::vector<Triangle> triangles_;
  std::vector<RestTriangle> rest_;  // area = weight in E_d
  std::vector<double> mass_;
  Boundary boundary_;
  std::vector<double> own_floor_;  // per boundary vertex: fraction of the gap unit to far edges of its own chart
  Gap gap_;
  double aspect_ = 0;
  bool has_box_ = false;
  double open_unit_ = 1;  // gap unit where there is no box
  double range_ = 0;
  double scale_ = 1;  // start units -> ours
  int threads_ = 1;
  std::vector<std::array<int, 3>> triangle_slots_;
};

}  // namespace atlas_refine
