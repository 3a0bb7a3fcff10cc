// Linear in each coarse triangle; then Newton steps of single vertices around bad elements.
#include "coarsen/prolong.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "geometry/boundary.h"
#include "geometry/guards.h"
#include "solve/foldover.h"
#include "solve/newton.h"
#include "support/gathered.h"
#include "support/parallel.h"
#include "support/profile.h"
#include "support/quantile.h"
#include "support/thread_pool.h"

namespace atlas_refine {
namespace {

constexpr double kBad = 2;          // times its energy before, or the median: an element that has to be mended
constexpr int kMostSweeps = 100;    // over the vertices of bad elements
constexpr int kOwnSweeps = 6;       // without those around them
constexpr int kPatience = 10;       // sweeps in which, none being flipped,
constexpr double kProgress = 0.9;   // the bad ones must have become so many: else they are as good as they get
constexpr double kFirstBlur = 0.3;  // epsilon of the energy for flipped elements,
constexpr double kFocus = 0.7;      // falls by this factor in every sweep,
constexpr double kLeastBlur = 0.1;  // to this: with less, steps of single vertices get stuck between flipped ones

constexpr int kGrain = 4096;  // elements

/// Elements of a chart in solver units.
struct Patch {
  std::vector<Triangle> elements;
  const ChartObjective& objective;
  std::vector<Vec2> x;
  std::vector<char> fixed;                        ///< per vertex
  std::vector<int> around_start, around_entries;  ///< the elements of each vertex

  std::span<const int> around(int v) const {
    return std::span(around_entries).subspan(around_start[v], around_start[v + 1] - around_start[v]);
  }

  Mat2 jacobian_of(int e) const {
    const Triangle& t = elements[e];
    return jacobian(objective.inverse_edges[e], x[t[0]], x[t[1]], x[t[2]]);
  }
  double energy_of(int e) const { return symmetric_dirichlet(jacobian_of(e)); }
};

std::vector<Triangle> elements_of(const Chart& chart) {
  std::vector<Triangle> out = chart.triangles;
  for (const Guard& guard : chart.guards) out.push_back(guard.triangle);
  return out;
}

std::vector<Vec2> interpolated(const CoarseChart& coarse, const std::vector<Vec2>& coarse_uvs) {
  std::vector<Vec2> out;
  out.reserve(coarse.places.size());
  for (const Place& place : coarse.places) {
    const Triangle& t = coarse.mesh.triangles[place.triangle];
    Vec2 sum = Vec2::Zero();
    for (int k = 0; k < 3; ++k) sum += place.weights[k] * coarse_uvs[t[k]];
    out.push_back(sum);
  }
  return out;
}

/// Energy of the elements around a vertex, finite for flipped ones where epsilon > 0.
double local_energy(const Patch& patch, int v, double epsilon) {
  double sum = 0;
  for (const int e : patch.around(v))
    sum += patch.objective.weight[e] *
           (epsilon > 0 ? foldover_energy(patch.jacobian_of(e), epsilon) : symmetric_dirichlet(patch.jacobian_of(e)));
  return sum;
}

/// One damped Newton step of one vertex.
void relax(Patch& patch, int v, double epsilon) {
  Vec2 gradient = Vec2::Zero();
  Mat2 hessian = Mat2::Zero();
  bool flipped = false;
  for (const int e : patch.around(v)) flipped = flipped || !(patch.jacobian_of(e).determinant() > 0);
  if (!flipped) epsilon = 0;
  for (const int e : patch.around(v)) {
    const Triangle& t = patch.elements[e];
    const auto& x = patch.x;
    const TriangleDerivatives d =
        epsilon > 0 ? foldover_derivatives(patch.objective.inverse_edges[e], x[t[0]], x[t[1]], x[t[2]], epsilon)
                    : symmetric_dirichlet_derivatives(patch.objective.inverse_edges[e], x[t[0]], x[t[1]], x[t[2]]);
    const auto k = std::find(t.begin(), t.end(), v) - t.begin();
    gradient += patch.objective.weight[e] * d.gradient[k];
    hessian += patch.objective.weight[e] * d.diagonal[k];
  }
  const Vec2 step = -hessian.inverse() * gradient;
  if (!step.allFinite()) return;
  const Vec2 from = patch.x[v];
  const double before = local_energy(patch, v, epsilon);
  const double fraction = backtrack(1, before, gradient.dot(step), [&](double part) {
    patch.x[v] = from + part * step;
    return local_energy(patch, v, epsilon);
  });
  if (fraction == 0) patch.x[v] = from;
}

/// Lists of numbers below a limit, ascending and each once.
class NumberSet {
 public:
  explicit NumberSet(std::size_t limit) : listed_(limit, 0) {}

  template <class Numbers>
  void add(const Numbers& numbers) {
    for (const int n : numbers) {
      if (!std::exchange(listed_[n], 1)) list_.push_back(n);
    }
  }

  std::vector<int> take() {
    for (const int n : list_) listed_[n] = 0;
    std::sort(list_.begin(), list_.end());
    return std::exchange(list_, {});
  }

 private:
  std::vector<char> listed_;
  std::vector<int> list_;
};

/// The vertices of elements, and the elements around vertices.
struct Stars {
  explicit Stars(const Patch& patch) : patch(patch), vertices(patch.x.size()), elements(patch.elements.size()) {}

  std::vector<int> corners(const std::vector<int>& of) {
    for (const int e : of) vertices.add(patch.elements[e]);
    return vertices.take();
  }
  std::vector<int> around(const std::vector<int>& of) {
    for (const int v : of) elements.add(patch.around(v));
    return elements.take();
  }

  const Patch& patch;
  NumberSet vertices, elements;
};

void find_stars(Patch& patch) {
  patch.around_start.assign(patch.x.size() + 1, 0);
  for (const Triangle& t : patch.elements) {
    for (const int v : t) ++patch.around_start[v + 1];
  }
  std::partial_sum(patch.around_start.begin(), patch.around_start.end(), patch.around_start.begin());
  std::vector<int> next(patch.around_start.begin(), patch.around_start.end() - 1);
  patch.around_entries.resize(patch.around_start.back());
  for (int e = 0; e < static_cast<int>(patch.elements.size()); ++e) {
    for (const int v : patch.elements[e]) patch.around_entries[next[v]++] = e;
  }
}

/// Whether sweeps go on mending: while some are flipped always.
class Progress {
 public:
  bool ends(std::size_t bad, bool flipped) {
    if (flipped || static_cast<double>(bad) < kProgress * least_) {
      least_ = static_cast<double>(bad);
      idle_ = 0;
    }
    return ++idle_ > kPatience;
  }

 private:
  double least_ = std::numeric_limits<double>::infinity();
  int idle_ = 0;
};

/// Of elements with more energy than `most`; true where none is left flipped.
bool mend(const std::vector<double>& most, Patch& patch) {
  const auto is_good = [&](int e) { return patch.energy_of(e) <= most[e]; };
  std::vector<int> bad = gathered<int>(static_cast<int>(patch.elements.size()), kGrain, [&](int begin, int end, auto& out) {
    for (int e = begin; e < end; ++e) {
      if (!is_good(e)) out.push_back(e);
    }
  });
  if (bad.empty()) return true;
  find_stars(patch);
  Stars stars(patch);
  Progress progress;
  bool flipped = true;
  double epsilon = kFirstBlur;
  for (int sweep = 0; sweep < kMostSweeps && !bad.empty(); ++sweep, epsilon = std::max(kLeastBlur, kFocus * epsilon)) {
    const std::vector<int> moving = stars.corners(sweep < kOwnSweeps ? bad : stars.around(stars.corners(bad)));
    for (const int v : moving) {
      if (!patch.fixed[v]) relax(patch, v, epsilon);
    }
    bad = stars.around(moving);  // while some are flipped, others may be on the way
    std::erase_if(bad, is_good);
    flipped = std::any_of(bad.begin(), bad.end(), [&](int e) { return !std::isfinite(patch.energy_of(e)); });
    if (progress.ends(bad.size(), flipped)) break;
  }
  return !flipped;
}

std::vector<double> energies(const Patch& patch) {
  std::vector<double> out(patch.elements.size());
  parallel_ranges(static_cast<int>(out.size()), present_threads(), kGrain, [&](int begin, int end) {
    for (int e = begin; e < end; ++e) out[e] = patch.energy_of(e);
  });
  return out;
}

/// In solver units.
Patch patch_of(const Chart& chart, const ChartObjective& objective, double unit) {
  Patch out{.elements = elements_of(chart),
            .objective = objective,
            .x = chart.uvs,
            .fixed = boundary_flags(chart),
            .around_start = {},
            .around_entries = {}};
  for (Vec2& x : out.x) x /= unit;
  return out;
}

std::vector<Vec2> in_uvs(std::vector<Vec2> x, double unit) {
  for (Vec2& point : x) point *= unit;
  return x;
}

}  // namespace

std::optional<std::vector<Vec2>> prolong(const Chart& chart, const CoarseChart& coarse, const std::vector<Vec2>& coarse_uvs,
                                         const ChartObjective& fine, double unit) {
  Patch patch = patch_of(chart, fine, unit);
  std::vector<double> most = energies(patch);
  for (double& energy : most) energy *= kBad;
  patch.x = interpolated(coarse, coarse_uvs);
  for (Vec2& x : patch.x) x /= unit;
  if (!mend(most, patch)) return std::nullopt;
  return in_uvs(std::move(patch.x), unit);
}

std::vector<Vec2> relax_crushed(const Chart& chart, const ChartObjective& objective, double unit) {
  const PhaseScope scope(Phase::Coarsen);
  Patch patch = patch_of(chart, objective, unit);
  mend(std::vector<double>(patch.elements.size(), kBad * median(energies(patch))), patch);
  return in_uvs(std::move(patch.x), unit);
}

}  // namespace atlas_refine
