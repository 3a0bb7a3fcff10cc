// Rings around the bad triangles, wider until it works.
#include "repair/untangle_chart.h"

#include <algorithm>
#include <cmath>

#include "geometry/plane.h"
#include "geometry/rest_triangle.h"
#include "measure/bad_triangles.h"
#include "measure/certificate.h"
#include "repair/overlap_depth.h"
#include "repair/part_touching.h"
#include "repair/untangle.h"

namespace atlas_refine {
namespace {

constexpr double kShapesKept = 1.02;   // E_2 over the good triangles
constexpr double kLeastWeight = 1e-3;  // of a triangle, as a fraction of the mean one: slivers must count, a little
constexpr int kMostOverlapping = 3;    // positive everywhere, yet the boundary crosses: wider rings will not help for ever
// What misshapen triangles count for, of their area, where with all of it the good ones bend too much.
constexpr double kLesserShares[] = {0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4};
constexpr double kCollapsed = 100;  // E_2 above which an embedding anew serves better

/// The number of edges between each vertex and the nearest bad triangle.
std::vector<int> rings_around(const Chart& chart, const std::vector<char>& bad) {
  std::vector<std::vector<int>> neighbours(chart.vertex_count());
  for (const Triangle& t : chart.triangles) {
    for (int k = 0; k < 3; ++k) {
      neighbours[t[k]].push_back(t[(k + 1) % 3]);
      neighbours[t[k]].push_back(t[(k + 2) % 3]);
    }
  }
  std::vector<int> ring(chart.vertex_count(), -1), queue;
  const auto reach = [&](int v, int distance) {
    if (ring[v] >= 0) return;
    ring[v] = distance;
    queue.push_back(v);
  };
  for (std::size_t t = 0; t < bad.size(); ++t) {
    for (int k = 0; bad[t] && k < 3; ++k) reach(chart.triangles[t][k], 0);
  }
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const int v = queue[head];
    for (const int w : neighbours[v]) reach(w, ring[v] + 1);
  }
  return ring;
}

RestTriangle shape_in_uvs(const Chart& chart, std::size_t t) {
  const Triangle& v = chart.triangles[t];
  return rest_from_plane(chart.uvs[v[0]], chart.uvs[v[1]], chart.uvs[v[2]], 1);
}

/// UV length per surface length over the good ones of these triangles; 0 without any.
double uv_scale(const Chart& chart, const std::vector<char>& bad, const std::vector<std::size_t>& triangles) {
  double plane = 0, surface = 0;
  for (const std::size_t t : triangles) {
    if (bad[t]) continue;
    const Triangle& v = chart.triangles[t];
    plane += 0.5 * doubled_area(chart.uvs[v[0]], chart.uvs[v[1]], chart.uvs[v[2]]);
    surface += chart.surface[t].area;
  }
  return surface > 0 ? std::sqrt(plane / surface) : 0;
}

/// What is to be mended, and how.
struct Mending {
  const Chart& chart;
  std::vector<int> ring;               ///< rings_around() its bad triangles
  const std::vector<char>& misshapen;  ///< triangles that are to get the surface's shape; the others keep what they have
  bool may_overlap;
  int threads;
  Monitor& monitor;
};

/// The triangles with a vertex within `rings` of a bad triangle, those vertices free; misshapen ones count for `share` of their
/// area.
Tangle tangle_within(const Mending& mending, int rings, double share) {
  const Chart& chart = mending.chart;
  Tangle out;
  for (const int distance : mending.ring) out.fixed.push_back(distance >= rings);
  std::vector<std::size_t> own;
  for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
    const Triangle& v = chart.triangles[t];
    if (!out.fixed[v[0]] || !out.fixed[v[1]] || !out.fixed[v[2]]) own.push_back(t);
  }
  double scale = uv_scale(chart, mending.misshapen, own);
  if (!(scale > 0)) scale = 1;
  double sum = 0;
  for (const std::size_t t : own) {
    RestTriangle rest = mending.misshapen[t] ? RestTriangle{} : shape_in_uvs(chart, t);
    if (rest.area == 0) rest = {chart.surface[t].inverse_edges / scale, chart.surface[t].area * scale * scale};
    out.triangles.push_back(chart.triangles[t]);
    out.inverse_edges.push_back(rest.inverse_edges);
    out.weights.push_back(rest.area);
    sum += rest.area;
  }
  for (std::size_t k = 0; k < own.size(); ++k) {
    out.weights[k] = std::max(out.weights[k], kLeastWeight * sum / static_cast<double>(own.size()));
    if (mending.misshapen[own[k]]) out.weights[k] *= share;
  }
  return out;
}

std::optional<Chart> accepted(const Chart& chart, bool may_overlap) {
  if (may_overlap) return chart;
  const bool valid = certify_charts({chart}).valid();
  if (valid && !touches_itself(chart)) return chart;
  const auto parted = part_touching(chart);
  return parted || !valid ? parted : chart;
}

/// How wide rings are in which nothing can be mended, as the chart lies on itself beyond them. Looked for once the first attempt
/// has failed: most charts need not know.
class Hopeless {
 public:
  explicit Hopeless(const Mending& mending) : mending_(mending) {}

  bool known_of(int rings) const { return depth_ && rings <= *depth_; }
  bool is(int rings) {
    if (!depth_) depth_ = mending_.may_overlap ? 0 : overlap_depth(mending_.chart, mending_.ring);
    return known_of(rings);
  }

 private:
  const Mending& mending_;
  std::optional<int> depth_;
};

struct Untangled {
  std::optional<Chart> chart;
  double loss = kCollapsed;  ///< E_2 over the triangles that have a shape
  int rings = 0;             ///< around the bad triangles, that moved
  bool unfolded = false;     ///< this or another attempt had every triangle positive, if not apart
};

Untangled untangled(const Mending& mending, const std::vector<Vec2>& uvs, int rings) {
  Chart mended = mending.chart;
  mended.uvs = uvs;
  Untangled out{.chart = accepted(mended, mending.may_overlap), .rings = rings};
  if (out.chart) out.loss = distortion_to_good(mending.chart, *out.chart);
  return out;
}

/// The best of all rings around the bad triangles.
Untangled untangle_rings(const Mending& mending, Hopeless& hopeless) {
  const int widest = *std::max_element(mending.ring.begin(), mending.ring.end());
  Untangled best;
  int overlapping = 0;
  for (int rings = 1; rings <= 2 * widest + 1 && overlapping < kMostOverlapping; rings *= 2) {
    Tangle tangle = tangle_within(mending, rings, 1);
    if (2 * tangle.triangles.size() > mending.misshapen.size() && rings <= widest) {
      rings = widest + 1;  // most of it moves: let all of it
      tangle = tangle_within(mending, rings, 1);
    }
    const auto uvs =
        hopeless.known_of(rings) ? std::nullopt : untangle(tangle, mending.chart.uvs, mending.threads, mending.monitor);
    if (!uvs) {
      overlapping += hopeless.is(rings);
      continue;
    }
    Untangled own = untangled(mending, *uvs, rings);
    if (!own.chart) ++overlapping;
    own.unfolded = best.unfolded = true;
    if (own.loss < best.loss) best = std::move(own);
    if (best.loss <= kShapesKept) break;
  }
  return best;
}

/// From there on with the misshapen triangles counting less and less, as far as the good ones need it to keep their shapes.
/// Charts that are going to be deformed keep none: they had better start with room for every triangle.
Untangled yielding(const Mending& mending, Untangled best) {
  if (mending.may_overlap) return best;
  for (const double share : kLesserShares) {
    if (!best.chart || best.loss <= kShapesKept) break;
    Tangle tangle = tangle_within(mending, best.rings, share);
    tangle.stays_positive = true;
    const auto uvs = untangle(tangle, best.chart->uvs, mending.threads, mending.monitor);
    if (!uvs) break;
    Untangled own = untangled(mending, *uvs, best.rings);
    if (own.loss < best.loss) best = std::move(own);
  }
  return best;
}

}  // namespace

std::optional<Chart> untangle_chart(const Chart& chart, bool may_overlap, int threads, Monitor& monitor) {
  const std::vector<char> bad = bad_triangles(chart), misshapen = misshapen_triangles(chart);
  const Mending mending{chart, rings_around(chart, bad), misshapen, may_overlap, threads, monitor};
  Hopeless hopeless(mending);
  Untangled best = untangle_rings(mending, hopeless);
  // Drawn out as they are, triangles have less room to unfold than with the surface's shape.
  if (best.loss <= kShapesKept || misshapen == bad || !best.unfolded) return yielding(mending, std::move(best)).chart;
  // Where the artist's UVs are far from the surface all over, what looks drawn out may be meant.
  const Mending as_meant{chart, mending.ring, bad, may_overlap, threads, monitor};
  Untangled kept = untangle_rings(as_meant, hopeless);
  return (kept.loss < best.loss ? yielding(as_meant, std::move(kept)) : yielding(mending, std::move(best))).chart;
}

}  // namespace atlas_refine
