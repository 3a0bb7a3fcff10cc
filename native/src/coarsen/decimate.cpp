// Intrinsic vertex removal: the star is laid flat around its vertex (Liu et al. 2023) and filled from one neighbour. Put back as
// in "Progressive Embedding" (Shen et al. 2019): near that neighbour there always is a valid place.
#include "coarsen/decimate.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "geometry/boundary.h"
#include "geometry/plane.h"
#include "geometry/predicates.h"
#include "geometry/rest_triangle.h"
#include "solve/symmetric_dirichlet.h"
#include "support/parallel.h"
#include "support/profile.h"

namespace atlas_refine {
namespace {

constexpr double kMostKept = 0.5;      // of the vertices: else there is little to gain
constexpr int kMostNeighbours = 12;    // of a vertex that is removed
constexpr double kLeastQuality = 0.1;  // of triangles that fill its ring; 1 = equilateral
constexpr double kIdle = 0.02;         // a pass that removes a smaller part of what is left is the last one

/// Triangles with the lengths of their sides (0, 1), (1, 2), (2, 0).
struct Mesh {
  std::vector<Triangle> corners;
  std::vector<std::array<double, 3>> lengths;
  std::vector<std::vector<int>> around;  ///< per vertex: its triangles
};

/// The triangles around a vertex, counterclockwise; each joins a neighbour to the next.
struct Fan {
  std::vector<int> triangles, ring;
  std::vector<double> spokes, rims;  ///< lengths of the sides at the vertex, and of those across

  void clear() {
    triangles.clear();
    ring.clear();
    spokes.clear();
    rims.clear();
  }

  int size() const { return static_cast<int>(ring.size()); }
  int after(int k) const { return k + 1 < size() ? k + 1 : 0; }
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
  fan.clear();
  if (around.size() < 3 || around.size() > kMostNeighbours) return false;
  int t = around.front();
  for (std::size_t step = 0; step < around.size(); ++step) {
    const Triangle& corners = mesh.corners[t];
    const int k = static_cast<int>(std::find(corners.begin(), corners.end(), v) - corners.begin());
    const int own = corners[(k + 1) % 3], next = corners[(k + 2) % 3];
    if (std::find(fan.ring.begin(), fan.ring.end(), own) != fan.ring.end()) return false;
    fan.triangles.push_back(t);
    fan.ring.push_back(own);
    fan.spokes.push_back(mesh.lengths[t][k]);
    fan.rims.push_back(mesh.lengths[t][(k + 1) % 3]);
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

using Angles = std::array<double, kMostNeighbours>;

/// Angles at the vertex, of each triangle.
Angles angles_of(const Fan& fan) {
  Angles out = {};
  double sum = 0;
  for (int k = 0; k < fan.size(); ++k) {
    const double a = fan.spokes[k], b = fan.spokes[fan.after(k)], c = fan.rims[k];
    sum += out[k] = std::acos(std::clamp((a * a + b * b - c * c) / (2 * a * b), -1.0, 1.0));
  }
  for (int k = 0; k < fan.size(); ++k) out[k] *= 2 * std::numbers::pi / sum;
  return out;
}

/// The ring around the vertex at the origin.
std::vector<Vec2> laid_flat(const Fan& fan) {
  std::vector<Vec2> out;
  double direction = 0;
  out.reserve(fan.size());
  const Angles angles = angles_of(fan);
  for (int k = 0; k < fan.size(); ++k) {
    out.push_back(fan.spokes[k] * Vec2(std::cos(direction), std::sin(direction)));
    direction += angles[k];
  }
  return out;
}

/// Twice the area over the mean square of the sides, 1 for an equilateral triangle; 0 where they do not close to one.
double quality(const std::array<double, 3>& lengths) {
  const auto [a, b, c] = lengths;
  const double product = (a + b + c) * (a + b - c) * (b + c - a) * (c + a - b);
  return product > 0 ? std::sqrt(3 * product) / (a * a + b * b + c * c) : 0;
}

bool joined(const Mesh& mesh, int v, int w) {
  return std::any_of(mesh.around[v].begin(), mesh.around[v].end(), [&](int t) {
    const Triangle& c = mesh.corners[t];
    return c[0] == w || c[1] == w || c[2] == w;
  });
}

/// The sides of triangle (onto, k, after k) that is to fill the ring.
std::array<double, 3> sides_of(const Fan& fan, const std::vector<Vec2>& flat, int onto, int k) {
  const int next = fan.after(k);
  const double there = fan.after(onto) == k ? fan.rims[onto] : (flat[k] - flat[onto]).norm();
  const double back = fan.after(next) == onto ? fan.rims[next] : (flat[onto] - flat[next]).norm();
  return {there, fan.rims[k], back};
}

/// The least quality of triangles that fill the ring from one of its vertices; 0 where they overlap or an edge is there already.
double quality_from(const Mesh& mesh, const Fan& fan, const std::vector<Vec2>& flat, int onto) {
  double least = 1;
  for (int k = fan.after(onto); fan.after(k) != onto; k = fan.after(k)) {
    const int next = fan.after(k);
    if (!(doubled_area(flat[onto], flat[k], flat[next]) > 0)) return 0;
    if (fan.after(next) != onto && joined(mesh, fan.ring[onto], fan.ring[next])) return 0;
    least = std::min(least, quality(sides_of(fan, flat, onto, k)));
    if (least < kLeastQuality) return 0;
  }
  return least;
}

void fill(Mesh& mesh, const Fan& fan, const std::vector<Vec2>& flat, int onto) {
  for (int k = 0; k < fan.size(); ++k) {
    for (const int v : {fan.ring[k], fan.ring[fan.after(k)]}) std::erase(mesh.around[v], fan.triangles[k]);
  }
  auto free = fan.triangles.begin();
  for (int k = fan.after(onto); fan.after(k) != onto; k = fan.after(k), ++free) {
    mesh.corners[*free] = {fan.ring[onto], fan.ring[k], fan.ring[fan.after(k)]};
    mesh.lengths[*free] = sides_of(fan, flat, onto, k);
    for (const int v : mesh.corners[*free]) mesh.around[v].push_back(*free);
  }
  for (; free != fan.triangles.end(); ++free) mesh.corners[*free] = {-1, -1, -1};
}

/// False where no neighbour's triangles would fill the ring well.
bool remove_vertex(Mesh& mesh, int v, Fan& fan, Decimation& out) {
  if (!find_fan(mesh, v, fan)) return false;
  const std::vector<Vec2> flat = laid_flat(fan);
  int onto = -1;
  double best = 0;
  for (int k = 0; k < fan.size(); ++k) {
    const double own = quality_from(mesh, fan, flat, k);
    if (own > best) std::tie(best, onto) = std::pair(own, k);
  }
  if (onto < 0) return false;
  fill(mesh, fan, flat, onto);
  mesh.around[v].clear();
  out.removals.push_back({v, onto, static_cast<int>(out.ring.size()), fan.size()});
  out.ring.insert(out.ring.end(), fan.ring.begin(), fan.ring.end());
  out.spokes.insert(out.spokes.end(), fan.spokes.begin(), fan.spokes.end());
  out.rims.insert(out.rims.end(), fan.rims.begin(), fan.rims.end());
  return true;
}

/// Removes vertices that are not neighbours, pass by pass.
void remove_all(std::vector<int> left, Mesh& mesh, Decimation& out) {
  std::vector<int> blocked(mesh.around.size(), -1);
  Fan fan;
  bool idle = false;
  for (int pass = 0; !idle; ++pass) {
    std::vector<int> rest;
    out.passes.push_back(static_cast<int>(out.removals.size()));
    for (const int v : left) {
      if (blocked[v] == pass || !remove_vertex(mesh, v, fan, out)) {
        rest.push_back(v);
        continue;
      }
      for (const int w : fan.ring) blocked[w] = pass;
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

/// Triangles around a vertex that comes back.
struct Star {
  std::vector<Vec2> ring;
  std::vector<RestTriangle> shapes;

  void clear() {
    ring.clear();
    shapes.clear();
  }
  std::size_t after(std::size_t k) const { return k + 1 < ring.size() ? k + 1 : 0; }
  bool positive_from(const Vec2& at) const {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      if (orientation(at, ring[k], ring[after(k)]) <= 0) return false;
    }
    return true;
  }
  double energy_from(const Vec2& at) const {
    double sum = 0;
    for (std::size_t k = 0; k < ring.size(); ++k)
      sum += shapes[k].area * symmetric_dirichlet(jacobian(shapes[k].inverse_edges, at, ring[k], ring[after(k)]));
    return sum;
  }
};

/// Mean value coordinates of the vertex among its neighbours, laid flat (Floater 2003).
Vec2 at_mean_value(const Star& star, const Fan& fan) {
  const Angles angles = angles_of(fan);
  Vec2 sum = Vec2::Zero();
  double weights = 0;
  for (int k = 0; k < fan.size(); ++k) {
    const double weight = (std::tan(0.5 * angles[k]) + std::tan(0.5 * angles[(k + fan.size() - 1) % fan.size()])) / fan.spokes[k];
    sum += weight * star.ring[k];
    weights += weight;
  }
  return sum / weights;
}

/// A place where all triangles are positive: near the neighbour that fills the ring, halfway between its edges.
std::optional<Vec2> near_neighbour(const Star& star, std::size_t onto) {
  constexpr int kHalvings = 40;
  const Vec2& from = star.ring[onto];
  const Vec2 next = star.ring[star.after(onto)] - from;
  const Vec2 previous = star.ring[(onto + star.ring.size() - 1) % star.ring.size()] - from;
  double opening = std::atan2(next.x() * previous.y() - next.y() * previous.x(), next.dot(previous));
  if (opening <= 0) opening += 2 * std::numbers::pi;
  const Vec2 direction = Eigen::Rotation2Dd(0.5 * opening) * next.normalized();
  double length = 0.5 * std::min(next.norm(), previous.norm());
  for (int k = 0; k < kHalvings; ++k, length *= 0.5) {
    const Vec2 at = from + length * direction;
    if (star.positive_from(at)) return at;
  }
  return std::nullopt;
}

/// Damped Newton steps of the vertex alone.
Vec2 relaxed(const Star& star, Vec2 at) {
  constexpr int kSteps = 2, kHalvings = 6;
  double energy = star.energy_from(at);
  for (int step = 0; step < kSteps; ++step) {
    Vec2 gradient = Vec2::Zero();
    Mat2 hessian = Mat2::Zero();
    for (std::size_t k = 0; k < star.ring.size(); ++k) {
      const TriangleDerivatives d =
          symmetric_dirichlet_derivatives(star.shapes[k].inverse_edges, at, star.ring[k], star.ring[star.after(k)]);
      gradient += star.shapes[k].area * d.gradient[0];
      hessian += star.shapes[k].area * d.diagonal[0];
    }
    Vec2 way = -hessian.inverse() * gradient;
    if (!way.allFinite()) return at;
    for (int k = 0; k < kHalvings; ++k, way *= 0.5) {
      const double reached = star.energy_from(at + way);
      if (!(reached < energy)) continue;
      at += way;
      energy = reached;
      break;
    }
  }
  return at;
}

/// Brings vertices back, with memory of its own.
class Return {
 public:
  explicit Return(const Decimation& decimation) : decimation_(decimation) {}

  /// Where the vertex belongs among its neighbours.
  std::optional<Vec2> place_of(const Removal& removal, const std::vector<Vec2>& uvs) {
    find_star(removal, uvs);
    const Vec2 at = at_mean_value(star_, fan_);
    if (star_.positive_from(at)) return relaxed(star_, at);
    const auto near = near_neighbour(star_, removal.onto);
    return near ? std::optional(relaxed(star_, *near)) : std::nullopt;
  }

 private:
  /// Its neighbours as they were when it was removed.
  void find_star(const Removal& removal, const std::vector<Vec2>& uvs) {
    fan_.clear();
    star_.clear();
    for (int k = removal.first; k < removal.first + removal.size; ++k) {
      fan_.ring.push_back(decimation_.ring[k]);
      fan_.spokes.push_back(decimation_.spokes[k]);
      fan_.rims.push_back(decimation_.rims[k]);
      star_.ring.push_back(uvs[decimation_.ring[k]]);
    }
    for (int k = 0; k < fan_.size(); ++k)
      star_.shapes.push_back(rest_from_sides({fan_.spokes[k], fan_.rims[k], fan_.spokes[fan_.after(k)]}));
  }

  const Decimation& decimation_;
  Fan fan_;
  Star star_;
};

/// Those of one pass are not neighbours: each comes back by itself. False where one has no place.
bool put_back_pass(const Decimation& decimation, int begin, int end, int threads, std::vector<Vec2>& uvs) {
  constexpr int kGrain = 256;
  std::atomic<bool> placed = true;
  parallel_ranges(end - begin, threads, kGrain, [&](int from, int to) {
    Return put(decimation);
    for (int k = begin + from; k < begin + to; ++k) {
      const Removal& removal = decimation.removals[k];
      const auto at = put.place_of(removal, uvs);
      if (at)
        uvs[removal.vertex] = *at;
      else
        placed = false;
    }
  });
  return placed;
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

std::optional<std::vector<Vec2>> put_back(const Decimation& decimation, const std::vector<Vec2>& coarse_uvs, int threads) {
  const PhaseScope scope(Phase::Coarsen);
  std::vector<Vec2> uvs(decimation.kept.size() + decimation.removals.size());
  for (std::size_t k = 0; k < decimation.kept.size(); ++k) uvs[decimation.kept[k]] = coarse_uvs[k];
  int end = static_cast<int>(decimation.removals.size());
  for (auto begin = decimation.passes.rbegin(); begin != decimation.passes.rend(); ++begin) {
    if (!put_back_pass(decimation, *begin, end, threads, uvs)) return std::nullopt;
    end = *begin;
  }
  return uvs;
}

}  // namespace atlas_refine
