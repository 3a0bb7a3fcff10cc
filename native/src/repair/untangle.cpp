// Projected Newton while eps falls from 1 to next to nothing.
#include "repair/untangle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/predicates.h"
#include "solve/foldover.h"
#include "solve/newton.h"
#include "support/parallel.h"

namespace atlas_refine {
namespace {

constexpr int kMostIterations = 80;
constexpr double kSettled = 1e-3;     // relative change of the energy
constexpr double kSettledFall = 0.1;  // of eps then
constexpr Damping kDamping{1e-10, 10, 1e24};

/// The unknowns: vertices of the triangles that are not fixed.
struct Unknowns {
  std::vector<int> node;  // per vertex, -1 where it does not move
  std::vector<double> masses;
  BlockSystem system;
};

double normalised(const Tangle& tangle) {
  double sum = 0;
  for (const double weight : tangle.weights) sum += weight;
  return 1 / sum;
}

Unknowns unknowns_of(const Tangle& tangle, double factor) {
  Unknowns out{.node = std::vector<int>(tangle.fixed.size(), -1), .masses = {}, .system = {}};
  for (std::size_t t = 0; t < tangle.triangles.size(); ++t) {
    const double mass = factor * tangle.weights[t] * tangle.inverse_edges[t].squaredNorm();
    for (const int v : tangle.triangles[t]) {
      if (tangle.fixed[v]) continue;
      if (out.node[v] < 0) {
        out.node[v] = static_cast<int>(out.masses.size());
        out.masses.push_back(0);
      }
      out.masses[out.node[v]] += mass;
    }
  }
  std::vector<std::pair<int, int>> edges;
  for (const auto& [a, b] : triangle_sides(tangle.triangles)) {
    if (out.node[a] >= 0 && out.node[b] >= 0) edges.emplace_back(out.node[a], out.node[b]);
  }
  out.system.matrix.analyse(static_cast<int>(out.masses.size()), std::move(edges));
  return out;
}

void add_triangle(const std::array<int, 3>& n, double weight, const TriangleDerivatives& d, BlockSystem& system) {
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    if (n[k] < 0) continue;
    system.gradient[n[k]] += weight * d.gradient[k];
    system.matrix.diagonal[n[k]] += weight * d.diagonal[k];
    if (n[next] < 0) continue;
    // Only the block above the diagonal counts.
    if (n[k] < n[next])
      system.matrix.add(n[k], n[next], weight * d.off_diagonal[k]);
    else
      system.matrix.add(n[next], n[k], weight * d.off_diagonal[k].transpose());
  }
}

/// Gradient and Hessian; returns the energy. Sums run in triangle order whatever the number of threads.
double assemble(const Tangle& tangle, double factor, const std::vector<Vec2>& x, double epsilon, int threads,
                std::vector<TriangleDerivatives>& buffer, Unknowns& unknowns) {
  const int count = static_cast<int>(tangle.triangles.size());
  parallel_ranges(count, threads, 1024, [&](int from, int to) {
    for (int t = from; t < to; ++t) {
      const Triangle& v = tangle.triangles[t];
      buffer[t] = foldover_derivatives(tangle.inverse_edges[t], x[v[0]], x[v[1]], x[v[2]], epsilon);
    }
  });
  unknowns.system.set_zero();
  double energy = 0;
  for (int t = 0; t < count; ++t) {
    const Triangle& v = tangle.triangles[t];
    const double weight = factor * tangle.weights[t];
    add_triangle({unknowns.node[v[0]], unknowns.node[v[1]], unknowns.node[v[2]]}, weight, buffer[t], unknowns.system);
    energy += weight * buffer[t].energy;
  }
  return energy;
}

Mat2 jacobian_of(const Tangle& tangle, std::size_t t, const std::vector<Vec2>& x) {
  const Triangle& v = tangle.triangles[t];
  return jacobian(tangle.inverse_edges[t], x[v[0]], x[v[1]], x[v[2]]);
}

double energy_at(const Tangle& tangle, double factor, const std::vector<Vec2>& x, double epsilon) {
  double sum = 0;
  for (std::size_t t = 0; t < tangle.triangles.size(); ++t)
    sum += factor * tangle.weights[t] * foldover_energy(jacobian_of(tangle, t, x), epsilon);
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

double least_determinant(const Tangle& tangle, const std::vector<Vec2>& x) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < tangle.triangles.size(); ++t) {
    const Mat2 j = jacobian_of(tangle, t, x);
    least = std::min(least, j(0, 0) * j(1, 1) - j(0, 1) * j(1, 0));
  }
  return least;
}

bool all_positive(const Tangle& tangle, const std::vector<Vec2>& x) {
  return std::all_of(tangle.triangles.begin(), tangle.triangles.end(),
                     [&](const Triangle& v) { return orientation(x[v[0]], x[v[1]], x[v[2]]) > 0; });
}

std::vector<Vec2> moved(const std::vector<Vec2>& x, const std::vector<int>& node, const std::vector<Vec2>& step,
                        double fraction) {
  std::vector<Vec2> out = x;
  for (std::size_t v = 0; v < x.size(); ++v) {
    if (node[v] >= 0) out[v] += fraction * step[node[v]];
  }
  return out;
}

}  // namespace

std::optional<std::vector<Vec2>> untangle(const Tangle& tangle, std::vector<Vec2> uvs, int threads, Monitor& monitor) {
  const double factor = normalised(tangle);
  Unknowns unknowns = unknowns_of(tangle, factor);
  if (unknowns.masses.empty()) return std::nullopt;
  std::vector<TriangleDerivatives> buffer(tangle.triangles.size());
  double epsilon = tangle.stays_positive ? kLeastEpsilon : 1;
  std::vector<FoldoverLevel> history;
  for (int k = 0; k < kMostIterations; ++k) {
    monitor.check();
    const double before = assemble(tangle, factor, uvs, epsilon, threads, buffer, unknowns);
    if (!std::isfinite(before) || !factor_damped(unknowns.system, unknowns.masses, kDamping)) break;
    const std::vector<Vec2> step = newton_direction(unknowns.system);
    std::vector<Vec2> trial;
    double after = before;
    const double fraction = line_search(1, before, dot(unknowns.system.gradient, step), [&](double part) {
      trial = moved(uvs, unknowns.node, step, part);
      return after = energy_at(tangle, factor, trial, epsilon);
    });
    if (fraction == 0) break;
    uvs = std::move(trial);
    const double least = least_determinant(tangle, uvs);
    const bool settled = after > (1 - kSettled) * before && all_positive(tangle, uvs);
    if (settled && least >= epsilon) return uvs;
    history.push_back({after, epsilon});
    if (least < 0 && stay_folded(history)) return std::nullopt;
    // Positive triangles far below eps are not felt yet: they would stay next to nothing.
    epsilon = settled ? std::max(kLeastEpsilon, kSettledFall * epsilon) : next_epsilon(epsilon, least, before, after);
  }
  if (!all_positive(tangle, uvs)) return std::nullopt;
  return uvs;
}

}  // namespace atlas_refine
