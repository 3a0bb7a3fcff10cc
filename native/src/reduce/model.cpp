// Set-up of the unknowns, their measures, and steps that keep them free of flips and collisions.
#include "reduce/model.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/collision.h"
#include "geometry/guards.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "reduce/contact_set.h"
#include "solve/symmetric_dirichlet.h"
#include "support/gathered.h"
#include "support/profile.h"

namespace atlas_refine {
namespace {

// How far the barrier is felt beyond the gap, as a fraction of the box diagonal.
constexpr double kRangeFraction = 0.0025;
// No wider than this part of a chart's mean size: else small charts feel all others at once, and steps stall.
constexpr double kRangeOfChart = 0.05;
// A step moves no vertex further than this fraction of the surface's size, which bounds the search for collisions.
constexpr double kLongestMove = 0.25;
constexpr double kBoxGrowth = 0.0035;  // of a box of fixed aspect
constexpr double kShortOf = 0.95;      // of the first flip or collision
constexpr int kGrain = 2048;           // pairs

void flatten(const std::vector<Chart>& charts, ReduceModel& model) {
  int count = 0;
  for (const Chart& chart : charts) {
    model.first_vertex.push_back(count);
    for_each_element(chart, [&](const Triangle& t, const RestTriangle&, double, int) {
      model.surface_triangles.push_back({count + t[0], count + t[1], count + t[2]});
    });
    for (const Vec2& uv : chart.uvs) model.start.x.push_back(uv / model.objective.unit);
    count += chart.vertex_count();
  }
  model.first_vertex.push_back(count);
}

/// A start in a frame stays where it is.
void place_in_frame(const Vec2& frame, ReduceModel& model) {
  model.start.box = frame / model.objective.unit;
  model.range = kRangeFraction * model.start.box.norm();
}

/// So does one that goes on in a box.
void place_in_box(const WarmStart& warm, ReduceModel& model) {
  model.start.box = warm.box / model.objective.unit;
  model.range = warm.range / model.objective.unit;
}

void place_start(ReduceModel& model) {
  const Box tight = box_of_points(model.start.x);
  const Vec2 size = box_of_aspect(tight, model.aspect).size();
  const auto pieces = static_cast<double>(model.first_vertex.size() - 1);
  model.range = std::min(kRangeFraction * size.norm(), kRangeOfChart * std::sqrt(size.prod() / pieces));
  model.open_unit = model.gap.unit == Gap::Unit::BoxDiagonal ? size.norm() : size.maxCoeff();
  // The box grows a little, so that no chart touches a wall, and by less than kStartGap: the gap follows it.
  const Vec2 slack = model.aspect == 0 ? Vec2(Vec2::Constant(0.5 * model.range)) : Vec2(0.5 * kBoxGrowth * size);
  for (Vec2& x : model.start.x) x += slack - tight.min;
  model.start.box = size + 2 * slack;
}

/// Leaves those that bend in the objective: of the others energy and mass are told once.
void keep_bending(const std::vector<Chart>& charts, ReduceModel& model) {
  Objective all = std::move(model.objective);
  model.objective = {.unit = all.unit};
  double fixed_weight = 0;
  std::size_t t = 0;
  for (std::size_t p = 0; p < charts.size(); ++p) {
    for (std::size_t end = t + charts[p].triangles.size() + charts[p].guards.size(); t < end; ++t) {
      const Triangle& v = model.surface_triangles[t];
      if (bends(model.freedom, p)) {
        model.triangles.push_back(v);
        model.objective.inverse_edges.push_back(all.inverse_edges[t]);
        model.objective.weight.push_back(all.weight[t]);
      } else if (model.freedom[p] == Freedom::Fixed) {
        fixed_weight += all.weight[t];
      } else {
        const auto& x = model.start.x;
        model.held_energy += all.weight[t] * symmetric_dirichlet(jacobian(all.inverse_edges[t], x[v[0]], x[v[1]], x[v[2]]));
        model.masses[model.first_vertex[p]] += all.weight[t];
      }
    }
  }
  const double rest = 1 - fixed_weight > 1e-12 ? 1 - fixed_weight : 1;
  for (double& weight : model.objective.weight) weight /= rest;
  for (double& mass : model.masses) mass /= rest;
  model.held_energy /= rest;
}

/// Ties the vertices of pieces that do not bend to one node, or to the box.
void attach(const std::vector<Chart>& charts, ReduceModel& model) {
  int first_fixed = -1;
  for (int p = 0; p < static_cast<int>(charts.size()); ++p) {
    if (bends(model.freedom, p)) continue;
    const bool fixed = model.freedom[p] == Freedom::Fixed;
    if (fixed && first_fixed < 0) first_fixed = p;
    const int node = fixed ? model.box_node() : model.first_vertex[p];
    std::fill(model.node.begin() + model.first_vertex[p], model.node.begin() + model.first_vertex[p + 1], node);
    if (fixed) model.fixed_share += area_within(charts[p], {Vec2::Zero(), model.objective.unit * model.start.box});
  }
  if (first_fixed < 0) return;
  const Vec2 sides = model.start.box;
  model.fixed_share /= model.objective.unit * model.objective.unit * sides.prod();
  for (const Vec2& x : model.start.x) model.lever.push_back(x / sides.y());
  for (int& piece : model.boundary.chart) {
    if (model.freedom[piece] == Freedom::Fixed) piece = first_fixed;
  }
}

/// By boundary vertices instead of vertices.
std::vector<NearBorder> at_boundary(const ReduceModel& model, std::vector<NearBorder> near_borders) {
  std::vector<int> index(model.vertex_count(), -1);
  for (int e = 0; e < model.boundary.size(); ++e) index[model.boundary.vertex[e]] = e;
  for (NearBorder& near : near_borders) near = {index[near.vertex], index[near.edge], near.floor};
  std::sort(near_borders.begin(), near_borders.end(),
            [](const NearBorder& a, const NearBorder& b) { return a.vertex < b.vertex; });
  return near_borders;
}

void set_masses(ReduceModel& model) {
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    for (int v : model.triangles[t]) model.masses[v] += model.objective.weight[t] / 3;
  }
  if (model.has_box) model.masses.back() = 1;
}

DirichletSums surface_sums(const std::vector<Chart>& charts, const ReduceModel& model, const std::vector<Vec2>& x) {
  std::vector<RestTriangle> surface;  // not kept: it is large, and asked for where E_d is limited only
  surface.reserve(model.surface_triangles.size());
  for (const Chart& chart : charts) {
    for_each_element(chart, [&](const Triangle&, const RestTriangle& shape, double share, int) {
      surface.push_back({shape.inverse_edges, share * shape.area});
    });
  }
  return dirichlet_sums(surface, model.surface_triangles, x);
}

}  // namespace

/// Where points lie close together, each pushed as others are, they would push with far more than the stretch of boundary that
/// they stand for, and crush the small triangles there: the narrow faces of a bevel stop the steps of all. So what is much
/// shorter than its loop's edges in the mean counts by its length.
void weigh_boundary(ReduceModel& model) {
  constexpr double kShort = 0.1;   // of the mean
  constexpr double kLeast = 1e-9;  // borders may not cross, however short
  const Boundary& boundary = model.boundary;
  std::vector<double> lengths(boundary.size());
  std::vector<int> edges(boundary.loop_length.size(), 0);
  for (int e = 0; e < boundary.size(); ++e) {
    const double end = boundary.next[e] > e ? boundary.arc[boundary.next[e]] : boundary.loop_length[boundary.loop[e]];
    lengths[e] = end - boundary.arc[e];
    ++edges[boundary.loop[e]];
  }
  for (int e = 0; e < boundary.size(); ++e) {
    const int loop = boundary.loop[e];
    const double full = kShort * boundary.loop_length[loop] / edges[loop];
    const auto weight = [&](double length) { return length < full ? std::max(kLeast, length / full) : 1; };
    model.edge_weight.push_back(weight(lengths[e]));
    model.point_weight.push_back(weight(0.5 * (lengths[e] + lengths[boundary.previous[e]])));
  }
}

ReduceModel make_model(const ReduceProblem& problem) {
  ReduceModel model;
  model.objective = problem.objective ? *problem.objective : make_objective(problem.charts);
  model.gap = problem.gap;
  model.aspect = problem.box_aspect;
  model.has_box = problem.pe_target > 0;
  model.threads = problem.threads;
  model.freedom = problem.freedom;
  flatten(problem.charts, model);
  model.masses.assign(model.node_count(), 0);
  if (model.freedom.empty())
    model.triangles = model.surface_triangles;
  else
    keep_bending(problem.charts, model);
  set_masses(model);
  model.boundary = make_boundary(problem.charts, model.first_vertex);
  for (double& arc : model.boundary.arc) arc /= model.objective.unit;
  for (double& length : model.boundary.loop_length) length /= model.objective.unit;
  weigh_boundary(model);
  if (problem.warm)
    place_in_box(*problem.warm, model);
  else if (problem.frame.x() > 0)
    place_in_frame(problem.frame, model);
  else
    place_start(model);
  model.node.resize(model.vertex_count());
  std::iota(model.node.begin(), model.node.end(), 0);
  if (!model.freedom.empty()) attach(problem.charts, model);
  if (problem.warm) {
    model.far_arc = problem.warm->far_arc / model.objective.unit;
    model.near_borders = at_boundary(model, problem.warm->near_borders);
  } else {
    // As in the smallest box that may come, or borders would come near before they count as far from each other.
    const Vec2& box = model.start.box;
    const double least = model.has_box ? box.norm() * std::min(1.0, std::sqrt(box_pe(model, model.start) / problem.pe_target))
                                       : std::sqrt(2 * chart_area(model, model.start.x));
    model.far_arc = kFarArc * std::min(least, box.norm());
    model.near_borders = measure_near_borders(model);
  }
  return model;
}

double gap_unit(const ReduceModel& model, const Vec2& box) {
  if (!model.has_box) return model.open_unit;
  return model.gap.unit == Gap::Unit::BoxDiagonal ? box.norm() : box.maxCoeff();
}

double chart_area(const ReduceModel& model, const std::vector<Vec2>& x) {
  const Boundary& boundary = model.boundary;
  double twice = 0;
  for (int e = 0; e < boundary.size(); ++e) {
    if (hangs_on_box(model, boundary.vertex[e])) continue;
    const Vec2& a = x[boundary.vertex[e]];
    const Vec2& b = x[boundary.vertex[boundary.next[e]]];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

std::vector<double> piece_areas(const ReduceModel& model, const std::vector<Vec2>& x) {
  const Boundary& boundary = model.boundary;
  std::vector<double> areas(model.first_vertex.size() - 1, 0);
  for (int e = 0; e < boundary.size(); ++e) {
    const Vec2& a = x[boundary.vertex[e]];
    const Vec2& b = x[boundary.vertex[boundary.next[e]]];
    areas[boundary.chart[e]] += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return areas;
}

double box_pe(const ReduceModel& model, const ReduceState& state) {
  return chart_area(model, state.x) / state.box.prod() + model.fixed_share;
}

double tight_pe(const ReduceModel& model, const ReduceState& state) {
  if (!model.lever.empty()) return box_pe(model, state);
  return chart_area(model, state.x) / box_of_aspect(box_of_points(state.x), model.aspect).area();
}

double model_energy(const ReduceModel& model, const std::vector<Vec2>& x) {
  return model.held_energy + dirichlet_energy(model.objective, model.triangles, x);
}

double surface_distortion(const std::vector<Chart>& charts, const ReduceModel& model, const std::vector<Vec2>& x) {
  return surface_sums(charts, model, x).best_energy();
}

double used_limits(const std::vector<Chart>& charts, const DistortionLimits& limits, const ReduceModel& model,
                   const std::vector<Vec2>& x) {
  const DirichletSums sums = surface_sums(charts, model, x);
  if (limits.stretch == 0) return limits.used(sums.best_energy(), 0);
  const double scale = sums.best_scale();
  std::vector<StretchedArea> stretched;
  std::size_t element = 0;
  for (const Chart& chart : charts) {
    for (std::size_t t = 0; t < chart.triangles.size(); ++t)
      stretched.push_back(
          {triangle_stretch(chart.surface[t], model.surface_triangles[element + t], x, scale), chart.surface[t].area});
    element += chart.triangles.size() + chart.guards.size();
  }
  return limits.used(sums.best_energy(), stretch_99(std::move(stretched)));
}

std::vector<Vec2> pe_gradient(const ReduceModel& model, const ReduceState& state) {
  std::vector<Vec2> gradient(model.node_count(), Vec2::Zero());
  const Boundary& boundary = model.boundary;
  const double area = chart_area(model, state.x);
  for (int e = 0; e < boundary.size(); ++e) {
    if (!bends(model.freedom, boundary.chart[e])) continue;
    const Vec2 chord = state.x[boundary.vertex[boundary.next[e]]] - state.x[boundary.vertex[boundary.previous[e]]];
    gradient[boundary.vertex[e]] += Vec2(chord.y(), -chord.x()) / (2 * area);
  }
  gradient[model.box_node()] += on_box_node(model, -state.box.cwiseInverse());
  if (model.lever.empty()) return gradient;
  const double others = area / state.box.prod();  // the fixed share does not change
  for (Vec2& g : gradient) g *= others / (others + model.fixed_share);
  return gradient;
}

Vec2 on_box_node(const ReduceModel& model, const Vec2& by_sides) {
  return model.aspect == 0 ? by_sides : Vec2(model.aspect * by_sides.x() + by_sides.y(), 0);
}

Mat2 moved_by_box(const ReduceModel& model, int vertex) {
  Mat2 out = Mat2::Zero();
  if (hangs_on_box(model, vertex))
    out.col(0) = model.lever[vertex];
  else if (!model.ride.empty() && model.aspect == 0)
    out.diagonal() = model.ride[vertex];
  else if (!model.ride.empty())
    out.col(0) = Vec2(model.aspect * model.ride[vertex].x(), model.ride[vertex].y());
  return out;
}

void ride_along(const ReduceState& state, ReduceModel& model) {
  model.ride.resize(model.vertex_count());
  for (std::size_t p = 0; p + 1 < model.first_vertex.size(); ++p) {
    const auto begin = state.x.begin() + model.first_vertex[p], end = state.x.begin() + model.first_vertex[p + 1];
    const Vec2 middle = std::accumulate(begin, end, Vec2(Vec2::Zero())) / static_cast<double>(end - begin);
    std::fill(model.ride.begin() + model.first_vertex[p], model.ride.begin() + model.first_vertex[p + 1],
              middle.cwiseQuotient(state.box));
  }
}

void spread(const ReduceModel& model, std::vector<Vec2>& step) {
  if (model.freedom.empty() && model.ride.empty()) return;
  const Vec2 box = model.has_box ? step[model.box_node()] : Vec2(Vec2::Zero());
  for (int v = model.vertex_count() - 1; v >= 0; --v) {  // a piece's node is its first vertex
    const Vec2 own = hangs_on_box(model, v) ? Vec2(Vec2::Zero()) : step[model.node[v]];
    step[v] = own + moved_by_box(model, v) * box;
  }
}

ReduceState moved(const ReduceModel& model, const ReduceState& state, const std::vector<Vec2>& step, const StepBounds& bounds,
                  double fraction) {
  ReduceState out = state;
  for (std::size_t p = 0; p < bounds.of_piece.size(); ++p) {
    const double part = fraction * bounds.of_piece[p];
    for (int v = model.first_vertex[p]; v < model.first_vertex[p + 1]; ++v) out.x[v] += part * step[v];
  }
  if (!model.has_box) return out;
  const Vec2& node = step[model.box_node()];
  const Vec2 sides = model.aspect == 0 ? node : Vec2(model.aspect * node.x(), node.x());
  out.box += fraction * bounds.least() * sides;
  for (int v = 0; v < static_cast<int>(model.lever.size()); ++v) {
    if (hangs_on_box(model, v)) out.x[v] = out.box.y() * model.lever[v];
  }
  return out;
}

StepBounds free_step(const ReduceModel& model, const ReduceState& state, const std::vector<Vec2>& step) {
  const PhaseScope scope(Phase::LineSearch);
  const int count = model.vertex_count();
  double longest = 0;
  for (int v = 0; v < count; ++v) longest = std::max(longest, step[v].norm());
  double limit = std::min(1.0, kLongestMove / std::max(longest, 1e-300));
  limit = flip_free_fraction(model.triangles, state.x, step, limit, kShortOf);
  std::vector<Vec2> scaled(count);
  for (int v = 0; v < count; ++v) scaled[v] = limit * step[v];
  const auto moving = [&](int v) { return Moving{state.x[v], step[v]}; };
  const Boundary& boundary = model.boundary;
  const double whole = limit;
  const std::vector<PointEdge> pairs = model.near.find(boundary, state.x, scaled, 0);
  limit = least_of(static_cast<int>(pairs.size()), kGrain, limit, [&](int begin, int end) {
    double least = whole;
    for (int k = begin; k < end; ++k) {
      if (moves_as_one(model, pairs[k])) continue;
      const auto [point, edge] = pairs[k];
      const double hit = hit_time(moving(boundary.vertex[point]), moving(boundary.vertex[edge]),
                                  moving(boundary.vertex[boundary.next[edge]]), whole);
      least = std::min(least, kShortOf * hit);
    }
    return least;
  });
  return {std::vector<double>(model.first_vertex.size() - 1, limit)};
}

std::vector<std::vector<Vec2>> by_piece(const ReduceModel& model, const std::vector<Vec2>& values, double factor) {
  std::vector<std::vector<Vec2>> out;
  for (std::size_t p = 0; p + 1 < model.first_vertex.size(); ++p) {
    auto& own = out.emplace_back();
    for (int v = model.first_vertex[p]; v < model.first_vertex[p + 1]; ++v) own.push_back(factor * values[v]);
  }
  return out;
}

}  // namespace atlas_refine
