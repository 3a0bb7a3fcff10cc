// Assembly, factorisation and step limits.
#include "solve/newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/collision.h"
#include "solve/symmetric_dirichlet.h"
#include "support/gathered.h"
#include "support/parallel.h"
#include "support/profile.h"
#include "support/thread_pool.h"

namespace atlas_refine {
namespace {

constexpr int kGrain = 4096;  // triangles

void add_triangle(const Triangle& v, const std::array<int, 3>& slots, double weight, const TriangleDerivatives& d,
                  BlockSystem& system) {
  for (int k = 0; k < 3; ++k) {
    system.gradient[v[k]] += weight * d.gradient[k];
    system.matrix.diagonal[v[k]] += weight * d.diagonal[k];
    Mat2& block = system.matrix.off_diagonal[slots[k]];
    if (v[k] < v[(k + 1) % 3])
      block += weight * d.off_diagonal[k];
    else
      block += weight * d.off_diagonal[k].transpose();
  }
}

void damp(BlockSystem& system, const std::vector<double>& masses, double damping) {
  for (std::size_t v = 0; v < masses.size(); ++v) system.matrix.diagonal[v].diagonal().array() += damping * masses[v];
}

}  // namespace

void BlockSystem::set_zero() {
  matrix.set_zero();
  gradient.assign(matrix.node_count(), Vec2::Zero());
}

std::vector<std::pair<int, int>> triangle_sides(const std::vector<Triangle>& triangles) {
  std::vector<std::pair<int, int>> sides;
  sides.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) sides.emplace_back(t[k], t[(k + 1) % 3]);
  }
  return sides;
}

TriangleSlots triangle_slots(const BlockCholesky& matrix, const std::vector<Triangle>& triangles) {
  TriangleSlots slots(triangles.size());
  parallel_ranges(static_cast<int>(triangles.size()), present_threads(), kGrain, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const Triangle& t = triangles[k];
      slots[k] = {matrix.slot(t[0], t[1]), matrix.slot(t[1], t[2]), matrix.slot(t[2], t[0])};
    }
  });
  return slots;
}

double dirichlet_energy(const Objective& objective, const std::vector<Triangle>& triangles, const std::vector<Vec2>& x) {
  const std::vector<double> energies = triangle_energies(objective, triangles, x);
  double sum = 0;
  for (std::size_t t = 0; t < energies.size(); ++t) {
    if (!std::isfinite(energies[t])) return std::numeric_limits<double>::infinity();
    sum += objective.weight[t] * energies[t];
  }
  return sum;
}

std::vector<double> triangle_energies(const Objective& objective, const std::vector<Triangle>& triangles,
                                      const std::vector<Vec2>& x) {
  std::vector<double> energies(triangles.size());
  parallel_ranges(static_cast<int>(triangles.size()), present_threads(), kGrain, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      const Triangle& v = triangles[t];
      energies[t] = symmetric_dirichlet(jacobian(objective.inverse_edges[t], x[v[0]], x[v[1]], x[v[2]]));
    }
  });
  return energies;
}

void add_dirichlet(const Objective& objective, const std::vector<Triangle>& triangles, const TriangleSlots& slots,
                   const std::vector<Vec2>& x, int threads, BlockSystem& system) {
  const PhaseScope scope(Phase::Assemble);
  constexpr int kBlock = 512;  // triangles: few enough for a core's cache
  constexpr int kFewBlocks = 4;
  const int count = static_cast<int>(triangles.size()), blocks = (count + kBlock - 1) / kBlock;
  const int buffers = blocks > kFewBlocks ? threads : 1;
  std::vector<TriangleDerivatives> buffer(static_cast<std::size_t>(buffers) * std::min(kBlock, count));
  const auto for_block = [&](int block, int slot, auto&& body) {
    TriangleDerivatives* own = buffer.data() + static_cast<std::ptrdiff_t>(slot) * kBlock;
    for (int t = block * kBlock; t < std::min(count, (block + 1) * kBlock); ++t) body(t, *own++);
  };
  parallel_in_order(
      blocks, buffers,
      [&](int block, int slot) {
        for_block(block, slot, [&](int t, TriangleDerivatives& own) {
          const Triangle& v = triangles[t];
          own = symmetric_dirichlet_derivatives(objective.inverse_edges[t], x[v[0]], x[v[1]], x[v[2]]);
        });
      },
      [&](int block, int slot) {
        for_block(block, slot, [&](int t, const TriangleDerivatives& own) {
          add_triangle(triangles[t], slots[t], objective.weight[t], own, system);
        });
      });
}

std::optional<double> factor_damped(BlockSystem& system, const std::vector<double>& masses, const Damping& damping, int threads) {
  double total = damping.value;
  damp(system, masses, total);
  for (double extra = total; !system.matrix.factor(threads); extra *= damping.growth) {
    if (total + extra > damping.most) return std::nullopt;
    damp(system, masses, extra);
    total += extra;
  }
  return total;
}

std::vector<Vec2> newton_direction(const BlockSystem& system) {
  std::vector<Vec2> step = system.gradient;
  system.matrix.solve(step);
  for (Vec2& s : step) s = -s;
  return step;
}

std::vector<Vec2> newton_direction(const BlockSystem& system, std::vector<Vec2>& other) {
  std::vector<Vec2> step = system.gradient;
  system.matrix.solve(step, other);
  for (Vec2& s : step) s = -s;
  return step;
}

double dot(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

double flip_free_fraction(const std::vector<Triangle>& triangles, const std::vector<Vec2>& x, const std::vector<Vec2>& step,
                          double limit, double short_of) {
  const PhaseScope scope(Phase::LineSearch);
  const auto moving = [&](int v) { return Moving{x[v], step[v]}; };
  return least_of(static_cast<int>(triangles.size()), kGrain, limit, [&](int begin, int end) {
    double least = limit;
    for (int k = begin; k < end; ++k) {
      const Triangle& t = triangles[k];
      least = std::min(least, short_of * flip_time(moving(t[0]), moving(t[1]), moving(t[2])));
    }
    return least;
  });
}

double StepBounds::least() const { return of_piece.empty() ? 1 : *std::min_element(of_piece.begin(), of_piece.end()); }

}  // namespace atlas_refine
