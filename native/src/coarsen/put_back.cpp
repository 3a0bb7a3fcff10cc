// As in "Progressive Embedding" (Shen et al. 2019): near the neighbour that fills its ring there always is a valid place.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <atomic>
#include <cmath>
#include <numbers>

#include "coarsen/decimate.h"
#include "coarsen/fan.h"
#include "geometry/plane.h"
#include "geometry/predicates.h"
#include "geometry/rest_triangle.h"
#include "solve/symmetric_dirichlet.h"
#include "support/parallel.h"
#include "support/profile.h"

namespace atlas_refine {
namespace {

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
  for (int k = 0; k < fan.size; ++k) {
    const double weight = (std::tan(0.5 * angles[k]) + std::tan(0.5 * angles[(k + fan.size - 1) % fan.size])) / fan.spokes[k];
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
    fan_.size = removal.size;
    star_.clear();
    for (int k = 0; k < removal.size; ++k) {
      fan_.ring[k] = decimation_.ring[removal.first + k];
      fan_.spokes[k] = decimation_.spokes[removal.first + k];
      fan_.rims[k] = decimation_.rims[removal.first + k];
      star_.ring.push_back(uvs[fan_.ring[k]]);
    }
    for (int k = 0; k < fan_.size; ++k)
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
