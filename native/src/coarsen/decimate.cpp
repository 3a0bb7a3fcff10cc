// Intrinsic vertex removal: the star is laid flat around its vertex (Liu et al. 2023) and filled from one neighbour.
#include "coarsen/decimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "coarsen/fan.h"
#include "geometry/plane.h"
#include "geometry/rest_triangle.h"
#include "support/parallel.h"
#include "support/profile.h"
#include "support/thread_pool.h"

namespace atlas_refine {
namespace {

constexpr double kMostKept = 0.5;      // of the vertices: else there is little to gain
constexpr double kLeastQuality = 0.1;  // of triangles that fill its ring; 1 = equilateral
constexpr double kIdle = 0.02;         // a pass that removes a smaller part of what is left is the last one

/// Triangles with the lengths of their sides (0, 1), (1, 2), (2, 0).
struct Mesh {
  std::vector<Triangle> corners;
  std::vector<std::array<double, 3>> lengths;
  std::vector<std::vector<int>> around;  ///< per vertex: its triangles
};

Mesh mesh_of(const Chart& chart) {
  constexpr int kSpare = 4;  // triangles that a vertex may gain before its list has to grow
  Mesh out{.corners = chart.triangles, .lengths = {}, .around = std::vector<std::vector<int>>(chart.vertex_count())};
  std::vector<int> count(chart.vertex_count(), kSpare);
  for (const Triangle& t : chart.triangles) {
    for (const int v : t) ++count[v];
  }
  for (int v = 0; v < chart.vertex_count(); ++v) out.around[v].reserve(count[v]);
  out.lengths.reserve(chart.triangles.size());
  for (int t = 0; t < static_cast<int>(chart.triangles.size()); ++t) {
    out.lengths.push_back(side_lengths(chart.surface[t]));
    for (const int v : chart.triangles[t]) out.around[v].push_back(t);
  }
  return out;
}

/// False where the triangles do not close around the vertex, are too many, or meet a neighbour twice.
bool find_fan(const Mesh& mesh, int v, Fan& fan) {
  const std::vector<int>& around = mesh.around[v];
  fan.size = 0;
  if (around.size() < 3 || around.size() > kMostNeighbours) return false;
  int t = around.front();
  for (std::size_t step = 0; step < around.size(); ++step) {
    const Triangle& corners = mesh.corners[t];
    const int k = static_cast<int>(std::find(corners.begin(), corners.end(), v) - corners.begin());
    const int own = corners[(k + 1) % 3], next = corners[(k + 2) % 3];
    const auto known = fan.ring.begin() + fan.size;
    if (std::find(fan.ring.begin(), known, own) != known) return false;
    fan.triangles[fan.size] = t;
    fan.ring[fan.size] = own;
    fan.spokes[fan.size] = mesh.lengths[t][k];
    fan.rims[fan.size++] = mesh.lengths[t][(k + 1) % 3];
    const auto follows = [&](int other) {
      const Triangle& c = mesh.corners[other];
      return (c[0] == v && c[1] == next) || (c[1] == v && c[2] == next) || (c[2] == v && c[0] == next);
    };
    const auto found = std::find_if(around.begin(), around.end(), follows);
    if (found == around.end()) return false;
    t = *found;
  }
  return t == around.front();
}

using Ring = std::array<Vec2, kMostNeighbours>;

/// The ring around the vertex at the origin.
Ring laid_flat(const Fan& fan) {
  Ring out;
  double direction = 0;
  const Angles angles = angles_of(fan);
  for (int k = 0; k < fan.size; ++k) {
    out[k] = fan.spokes[k] * Vec2(std::cos(direction), std::sin(direction));
    direction += angles[k];
  }
  return out;
}

/// Twice the area over the mean square of the sides, 1 for an equilateral triangle; 0 where they do not close to one.
double quality(double a, double b, double c) {
  const double product = (a + b + c) * (a + b - c) * (b + c - a) * (c + a - b);
  return product > 0 ? std::sqrt(3 * product) / (a * a + b * b + c * c) : 0;
}

bool joined(const Mesh& mesh, int v, int w) {
  return std::any_of(mesh.around[v].begin(), mesh.around[v].end(), [&](int t) {
    const Triangle& c = mesh.corners[t];
    return c[0] == w || c[1] == w || c[2] == w;
  });
}

/// From the neighbour `onto` to all others, along the ring or across it.
Lengths lengths_from(const Fan& fan, const Ring& flat, int onto) {
  Lengths out = {};
  for (int k = 0; k < fan.size; ++k) out[k] = (flat[k] - flat[onto]).norm();
  const int next = fan.after(onto), last = onto > 0 ? onto - 1 : fan.size - 1;
  out[next] = fan.rims[onto];
  out[last] = fan.rims[last];
  return out;
}

/// Triangles (onto, k, after k) that fill the ring from one of its vertices.
template <class Visit>
void for_each_filling(const Fan& fan, int onto, Visit&& visit) {
  for (int k = fan.after(onto); fan.after(k) != onto; k = fan.after(k)) visit(k, fan.after(k));
}

/// True where one of the edges across the ring is there already, outside of it.
bool across_joined(const Mesh& mesh, const Fan& fan, int onto) {
  bool out = false;
  for_each_filling(
      fan, onto, [&](int, int next) { out = out || (fan.after(next) != onto && joined(mesh, fan.ring[onto], fan.ring[next])); });
  return out;
}

/// The least quality of triangles that fill the ring from one of its vertices; 0 where they overlap or one is too slim.
double quality_from(const Fan& fan, const Ring& flat, int onto, const Lengths& lengths) {
  double least = 1;
  for_each_filling(fan, onto, [&](int k, int next) {
    const bool positive = doubled_area(flat[onto], flat[k], flat[next]) > 0;
    least = std::min(least, positive ? quality(lengths[k], fan.rims[k], lengths[next]) : 0);
  });
  return least < kLeastQuality ? 0 : least;
}

/// How a vertex is to be removed.
struct Plan {
  int onto = -1;  ///< in the ring; none where no neighbour's triangles would fill it well
  Fan fan;
  Lengths lengths;  ///< from there
};

void make_plan(const Mesh& mesh, int v, Plan& plan) {
  plan.onto = -1;
  if (!find_fan(mesh, v, plan.fan)) return;
  const Ring flat = laid_flat(plan.fan);
  double best = 0;
  for (int k = 0; k < plan.fan.size; ++k) {
    const Lengths lengths = lengths_from(plan.fan, flat, k);
    const double own = quality_from(plan.fan, flat, k, lengths);
    if (own <= best || across_joined(mesh, plan.fan, k)) continue;
    best = own;
    plan.onto = k;
    plan.lengths = lengths;
  }
}

void fill(Mesh& mesh, const Plan& plan) {
  const Fan& fan = plan.fan;
  for (int k = 0; k < fan.size; ++k) {
    for (const int v : {fan.ring[k], fan.ring[fan.after(k)]}) std::erase(mesh.around[v], fan.triangles[k]);
  }
  int used = 0;
  for_each_filling(fan, plan.onto, [&](int k, int next) {
    const int t = fan.triangles[used++];
    mesh.corners[t] = {fan.ring[plan.onto], fan.ring[k], fan.ring[next]};
    mesh.lengths[t] = {plan.lengths[k], fan.rims[k], plan.lengths[next]};
    for (const int v : mesh.corners[t]) mesh.around[v].push_back(t);
  });
  for (; used < fan.size; ++used) mesh.corners[fan.triangles[used]] = {-1, -1, -1};
}

/// False where there is no plan, or another removal of the pass brought one of its edges.
bool remove_vertex(Mesh& mesh, int v, const Plan& plan, Decimation& out) {
  const Fan& fan = plan.fan;
  if (plan.onto < 0 || across_joined(mesh, fan, plan.onto)) return false;
  fill(mesh, plan);
  mesh.around[v].clear();
  out.removals.push_back({v, plan.onto, static_cast<int>(out.ring.size()), fan.size});
  out.ring.insert(out.ring.end(), fan.ring.begin(), fan.ring.begin() + fan.size);
  out.spokes.insert(out.spokes.end(), fan.spokes.begin(), fan.spokes.begin() + fan.size);
  out.rims.insert(out.rims.end(), fan.rims.begin(), fan.rims.begin() + fan.size);
  return true;
}

/// Those of `left` that are to go in one pass: no two are neighbours. The others move to `rest`.
std::vector<int> choose(const std::vector<int>& left, const Mesh& mesh, std::vector<char>& blocked, std::vector<int>& rest) {
  std::vector<int> chosen;
  std::fill(blocked.begin(), blocked.end(), 0);
  for (const int v : left) {
    if (blocked[v] || mesh.around[v].size() > kMostNeighbours) {
      rest.push_back(v);
      continue;
    }
    chosen.push_back(v);
    for (const int t : mesh.around[v]) {
      for (const int w : mesh.corners[t]) blocked[w] = 1;
    }
  }
  return chosen;
}

/// Removes vertices pass by pass. What surrounds those of one pass does not change in it, so that they are planned side by side.
/// Those that stayed come last in the next, so that they keep no neighbour from being chosen.
void remove_all(std::vector<int> left, Mesh& mesh, Decimation& out) {
  constexpr int kGrain = 128;
  std::vector<char> blocked(mesh.around.size());
  std::vector<Plan> plans;
  for (bool idle = false; !idle;) {
    std::vector<int> rest;
    out.passes.push_back(static_cast<int>(out.removals.size()));
    const std::vector<int> chosen = choose(left, mesh, blocked, rest);
    plans.resize(std::max(plans.size(), chosen.size()));
    parallel_ranges(static_cast<int>(chosen.size()), present_threads(), kGrain, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) make_plan(mesh, chosen[k], plans[k]);
    });
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      if (!remove_vertex(mesh, chosen[k], plans[k], out)) rest.push_back(chosen[k]);
    }
    const auto removed = static_cast<double>(left.size() - rest.size());
    idle = removed <= kIdle * static_cast<double>(left.size());
    left = std::move(rest);
  }
}

/// What is left as a chart.
void collect(const Chart& chart, const Mesh& mesh, Decimation& out) {
  std::vector<int> entry(chart.vertex_count(), -1);
  for (int v = 0; v < chart.vertex_count(); ++v) {
    if (mesh.around[v].empty()) continue;
    entry[v] = static_cast<int>(out.kept.size());
    out.kept.push_back(v);
  }
  std::vector<RestTriangle> shapes;
  for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
    const auto& [a, b, c] = mesh.corners[t];
    if (a < 0) continue;
    out.mesh.triangles.push_back({entry[a], entry[b], entry[c]});
    shapes.push_back(rest_from_sides(mesh.lengths[t]));
  }
  for (const int v : out.kept) out.mesh.uvs.push_back(chart.uvs[v]);
  out.mesh.surface = Surface(std::move(shapes));
  out.mesh.triangle_faces.assign(out.mesh.triangles.size(), chart.triangle_faces.front());
  out.mesh.boundary_loops = chart.boundary_loops;
  for (std::vector<int>& loop : out.mesh.boundary_loops) {
    for (int& v : loop) v = entry[v];
  }
  out.mesh.number = chart.number;
}

}  // namespace

std::optional<Decimation> decimate(const Chart& chart, const Sample& sample) {
  const PhaseScope scope(Phase::Coarsen);
  std::vector<char> kept(chart.vertex_count(), 0);
  for (const int v : sample.vertices) kept[v] = 1;
  std::vector<int> others;
  for (int v = 0; v < chart.vertex_count(); ++v) {
    if (!kept[v]) others.push_back(v);
  }
  Mesh mesh = mesh_of(chart);
  Decimation out;
  remove_all(std::move(others), mesh, out);
  collect(chart, mesh, out);
  if (static_cast<double>(out.kept.size()) > kMostKept * chart.vertex_count()) return std::nullopt;
  return out;
}

}  // namespace atlas_refine
