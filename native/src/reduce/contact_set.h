// The contacts of one iteration: point-edge pairs and walls that a log barrier keeps apart.
#pragma once

#include <vector>

#include "reduce/model.h"

namespace atlas_refine {

/// A pair that the barrier keeps apart: distance > floor_fraction * gap unit, felt below floor + range.
struct Contact {
  PointEdge pair;
  double floor_fraction;
  double range;
};
using ContactSet = std::vector<Contact>;

/// ReduceModel::near_borders of the start.
std::vector<NearBorder> measure_near_borders(const ReduceModel& model);

/// Pairs that can come into the barrier's reach while `state` moves along `step` (may be empty).
ContactSet find_contacts(const ReduceModel& model, const ReduceState& state, const std::vector<Vec2>& step = {});

/// Writes down which borders of one piece are nearer than the gap now: they may part, and come little nearer from here on.
void note_near_borders(const ReduceState& state, const ContactSet& contacts, ReduceModel& model);

/// Of contacts and walls; infinite where one is crossed.
double barrier(const ReduceModel& model, const ReduceState& state, const ContactSet& contacts);
/// Smallest distance beyond its floor of any contact, as a fraction of its range; at most 1.
double least_slack(const ReduceModel& model, const ReduceState& state);

/// The pairs of nodes that contacts and walls couple now or may soon, for BlockCholesky::analyse.
std::vector<std::pair<int, int>> coupled_nodes(const ReduceModel& model, const ReduceState& state, const ContactSet& contacts);
/// True where the matrix holds every pair of the contacts.
bool covers(const BlockCholesky& matrix, const ReduceModel& model, const ContactSet& contacts);

/// Adds stiffness * barrier's gradient and projected Hessian.
void add_contacts(const ReduceModel& model, const ReduceState& state, const ContactSet& contacts, double stiffness,
                  BlockSystem& system);
void add_walls(const ReduceModel& model, const ReduceState& state, double stiffness, BlockSystem& system);

/// What contacts push each vertex with: -stiffness * gradient of their barrier, walls left out.
std::vector<Vec2> contact_forces(const ReduceModel& model, const ReduceState& state, const ContactSet& contacts,
                                 double stiffness);

}  // namespace atlas_refine
