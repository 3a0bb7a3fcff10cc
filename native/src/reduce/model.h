// What one optimisation works on: all pieces as flat arrays, their objective, and what does not change between iterations.
#pragma once

#include <vector>

#include "geometry/near_pairs.h"
#include "reduce/reduce.h"
#include "solve/newton.h"

namespace atlas_refine {

/// Positions of all vertices, and the box [0, width] x [0, height] that holds those that are not fixed. Solver units: the surface
/// has area 1.
struct ReduceState {
  std::vector<Vec2> x;
  Vec2 box = Vec2::Zero();
};

/// Nodes are the vertices and, where there is a box, one more that stands for its sides: (width, height), or (height, unused)
/// where the aspect is fixed. Vertices of a piece that only moves share the node of its first; those of a fixed piece hang on the
/// box: in solver units the unit square of the texture shrinks, and what is fixed in it shrinks with it. Nodes that no vertex
/// moves with have an empty equation.
struct ReduceModel {
  std::vector<int> first_vertex;            ///< of each piece; then the number of vertices
  std::vector<Triangle> triangles;          ///< of the pieces that bend: of each its own, then its guards
  Objective objective;                      ///< of these
  double held_energy = 0;                   ///< of the pieces that only move: added to the objective
  std::vector<Triangle> surface_triangles;  ///< of all pieces, guards too
  std::vector<double> masses;               ///< one per node: a third of the triangles around it; 1 for the box
  Boundary boundary;                        ///< all fixed pieces count as one: the first of them
  std::vector<double> point_weight;         ///< of the barrier, in (0, 1], per boundary vertex,
  std::vector<double> edge_weight;          ///< and per boundary edge: less where the boundary is made of short stretches
  Freedoms freedom;                         ///< one per piece; empty where all bend
  std::vector<int> node;                    ///< per vertex: what it moves with
  std::vector<Vec2> lever;  ///< per vertex of a fixed piece: its position / height of the box; empty where none is fixed
  /// Per vertex of a piece that is not fixed: the middle of its piece, as a part of the box. Steps are told relative to where the
  /// box takes it, so that damping, and having no contact, leave charts their place in the box. Empty where pieces are few.
  std::vector<Vec2> ride;
  double fixed_share = 0;                ///< of the box, that fixed pieces cover
  double far_arc = 0;                    ///< borders of one piece between which the boundary is at least so long face each other
  std::vector<NearBorder> near_borders;  ///< by boundary vertices: pairs of one piece with less than the gap; sorted by the first
  Gap gap;
  double range = 0;  ///< the barrier is felt so far beyond the gap
  double aspect = 0;
  bool has_box = false;
  double open_unit = 1;  ///< gap unit where there is no box
  int threads = 1;
  ReduceState start;
  mutable NearPairs near;  ///< of `boundary`: what the searches of one iteration found serves the next ones

  int vertex_count() const { return first_vertex.back(); }
  int node_count() const { return vertex_count() + (has_box ? 1 : 0); }
  int box_node() const { return vertex_count(); }
};

ReduceModel make_model(const ReduceProblem& problem);

/// What the gap is a fraction of.
double gap_unit(const ReduceModel& model, const Vec2& box);

double chart_area(const ReduceModel& model, const std::vector<Vec2>& x);
std::vector<double> piece_areas(const ReduceModel& model, const std::vector<Vec2>& x);  ///< those of fixed pieces as one
double box_pe(const ReduceModel& model, const ReduceState& state);                      ///< against the unknown box
double tight_pe(const ReduceModel& model, const ReduceState& state);  ///< against the vertices' box of the asked aspect
/// Gradient of log box_pe, one entry per node.
std::vector<Vec2> pe_gradient(const ReduceModel& model, const ReduceState& state);
/// Objective of all pieces that are not fixed; infinite with a flip.
double model_energy(const ReduceModel& model, const std::vector<Vec2>& x);
/// E_d on the surface of the model's charts, under the one global scale that minimises it.
double surface_distortion(const std::vector<Chart>& charts, const ReduceModel& model, const std::vector<Vec2>& x);
/// What of the limits these charts use, as DistortionLimits::used_by().
double used_limits(const std::vector<Chart>& charts, const DistortionLimits& limits, const ReduceModel& model,
                   const std::vector<Vec2>& x);

/// A gradient by the sides of the box as the box node has it.
Vec2 on_box_node(const ReduceModel& model, const Vec2& by_sides);
/// Whether the vertex hangs on the box.
inline bool hangs_on_box(const ReduceModel& model, int vertex) {
  return !model.lever.empty() && model.node[vertex] == model.box_node();
}
/// Whether no step changes the distance between the point and the edge, or none needs to mind.
inline bool moves_as_one(const ReduceModel& model, const PointEdge& pair) {
  const int piece = model.boundary.chart[pair.point];
  return piece == model.boundary.chart[pair.edge] && !bends(model.freedom, piece);
}
/// How a step of the box node moves the vertex, besides its own node's.
Mat2 moved_by_box(const ReduceModel& model, int vertex);
/// Tells steps relative to where the box takes the pieces of `state`.
void ride_along(const ReduceState& state, ReduceModel& model);
/// From a step of the nodes to one of all vertices, in place.
void spread(const ReduceModel& model, std::vector<Vec2>& step);
/// state + fraction * bounds * step; the box takes the smallest of the bounds.
ReduceState moved(const ReduceModel& model, const ReduceState& state, const std::vector<Vec2>& step, const StepBounds& bounds,
                  double fraction);
/// Largest parts of `step` free of flips and collisions. All equal: the smallest of all pieces.
StepBounds free_step(const ReduceModel& model, const ReduceState& state, const std::vector<Vec2>& step);

/// One array per piece, from flat arrays over vertices; `factor` brings solver units to others.
std::vector<std::vector<Vec2>> by_piece(const ReduceModel& model, const std::vector<Vec2>& values, double factor);

}  // namespace atlas_refine
