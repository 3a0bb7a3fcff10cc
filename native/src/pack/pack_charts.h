// Placing rigid charts of any outline in a box: rotations, an exact gap, free
// or fixed aspect.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "atlas_refine/options.h"
#include "geometry/chart.h"

namespace atlas_refine {

/// Beyond this many charts separation, many starts and many turns cost more than they bring.
inline constexpr int kManyCharts = 200;

/// A chart's outline: all boundary loops (chart on the left; outer first, then
/// holes), in the units of the box to be found.
struct Outline {
  std::vector<std::vector<Vec2>> loops;
  Rotate rotate = Rotate::Any;  ///< which rotations it may get
};

/// Rigid motion: p -> (cos, -sin; sin, cos) p + offset. No scaling, no
/// mirroring.
struct Placement {
  double cosine = 1;
  double sine = 0;
  Vec2 offset = Vec2::Zero();

  Vec2 apply(const Vec2& p) const {
    return {cosine * p.x() - sine * p.y() + offset.x(), sine * p.x() + cosine * p.y() + offset.y()};
  }
};

enum class PackSearch {
  Thorough,
  Rough,  ///< few greedy placements: to tell which of many atlases can be packed well
  Fair,   ///< the best of these made smaller for a while, where there are four charts or more
};

struct PackOptions {
  double gap = 0;         ///< smallest distance between two charts, absolute, in the
                          ///< outlines' units
  double box_aspect = 0;  ///< width / height, 0 = free
  double target_pe = 1;   ///< stop searching once sum(area) / box area reaches this
  std::uint64_t seed = 1;
  int threads = 1;
  PackSearch search = PackSearch::Thorough;
  std::function<void(double)> tick = {};  ///< called from the calling thread with
                                          ///< progress in [0, 1]; may throw to cancel
};

struct Packing {
  std::vector<Placement> placements;  ///< one per outline
  Box box;                            ///< of the placed outlines (of the asked aspect where that is
                                      ///< fixed), min = (0, 0)
  double pe = 0;                      ///< sum(area) / box area
  /// The same of two outlines and more as canonical_outlines() tells them: what goes on from there depends on nothing else.
  std::vector<Placement> canonical = {};
};

/// `areas[i]` is the UV area of outline i. Distances between placed outlines
/// are at least `gap` by construction (conservative rasterisation, never less
/// than asked). Deterministic for a seed, whatever the number of threads.
/// Near-linear in charts.
Packing pack_charts(const std::vector<Outline>& outlines, const std::vector<double>& areas, const PackOptions& options);

/// The same with all of them in rows, see pack_in_rows(); nothing where that does not reach the target.
std::optional<Packing> pack_charts_in_rows(const std::vector<Outline>& outlines, const std::vector<double>& areas,
                                           const PackOptions& options);

/// A layout that has the gap `before` with that of `options`, which is a little larger. Nothing where charts do not come that far
/// apart, or are so few or so many that packing them anew is as well.
std::optional<Packing> with_larger_gap(const std::vector<Outline>& outlines, const std::vector<double>& areas,
                                       const Packing& packing, double before, const PackOptions& options);

}  // namespace atlas_refine
