// Rings around the bad triangles, wider until it works.
#include "repair/untangle_chart.h"

#include <algorithm>
#include <cmath>

#include "geometry/plane.h"
#include "geometry/rest_triangle.h"
#include "measure/certificate.h"
#include "repair/bad_triangles.h"
#include "repair/part_touching.h"
#include "repair/untangle.h"

namespace atlas_refine {
namespace {

constexpr double kShapesKept = 1.02;   // E_2 over the good triangles
constexpr double kLeastWeight = 1e-3;  // of a triangle, as a fraction of the mean one: slivers must count, a little
constexpr int kMostOverlapping = 3;    // positive everywhere, yet the boundary crosses: wider rings will not help for ever
constexpr double kCollapsed = 100;     // E_2 above which an embedding anew serves better

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

/// The triangles with a vertex within `rings` of a bad triangle, those vertices free; `misshapen` ones are to get the surface's
/// shape.
Tangle tangle_within(const Chart& chart, const std::vector<char>& misshapen, const std::vector<int>& ring, int rings) {
  Tangle out;
  for (const int distance : ring) out.fixed.push_back(distance >= rings);
  std::vector<std::size_t> own;
  for (std::size_t t = 0; t < misshapen.size(); ++t) {
    const Triangle& v = chart.triangles[t];
    if (!out.fixed[v[0]] || !out.fixed[v[1]] || !out.fixed[v[2]]) own.push_back(t);
  }
  double scale = uv_scale(chart, misshapen, own);
  if (!(scale > 0)) scale = 1;
  double sum = 0;
  for (const std::size_t t : own) {
    RestTriangle rest = misshapen[t] ? RestTriangle{} : shape_in_uvs(chart, t);
    if (rest.area == 0) rest = {chart.surface[t].inverse_edges / scale, chart.surface[t].area * scale * scale};
    out.triangles.push_back(chart.triangles[t]);
    out.inverse_edges.push_back(rest.inverse_edges);
    out.weights.push_back(rest.area);
    sum += rest.area;
  }
  for (double& weight : out.weights) weight = std::max(weight, kLeastWeight * sum / static_cast<double>(own.size()));
  return out;
}

std::optional<Chart> accepted(const Chart& chart, bool may_overlap) {
  if (may_overlap) return chart;
  const bool valid = certify_charts({chart}).valid();
  if (valid && !touches_itself(chart)) return chart;
  const auto parted = part_touching(chart);
  return parted || !valid ? parted : chart;
}

struct Untangled {
  std::optional<Chart> chart;
  double loss = kCollapsed;  ///< E_2 over the triangles that have a shape
};

/// The best of all rings around the bad triangles; `misshapen` ones get the surface's shape.
Untangled untangle_rings(const Chart& chart, const std::vector<char>& bad, const std::vector<char>& misshapen, bool may_overlap,
                         int threads, Monitor& monitor) {
  const std::vector<int> ring = rings_around(chart, bad);
  const int widest = *std::max_element(ring.begin(), ring.end());
  Untangled best;
  int overlapping = 0;
  for (int rings = 1; rings <= 2 * widest + 1 && overlapping < kMostOverlapping; rings *= 2) {
    Tangle tangle = tangle_within(chart, misshapen, ring, rings);
    if (2 * tangle.triangles.size() > bad.size() && rings <= widest) {
      rings = widest + 1;  // most of it moves: let all of it
      tangle = tangle_within(chart, misshapen, ring, rings);
    }
    auto uvs = untangle(tangle, chart.uvs, threads, monitor);
    if (!uvs) continue;
    Chart mended = chart;
    mended.uvs = std::move(*uvs);
    const auto valid = accepted(mended, may_overlap);
    if (!valid) {
      ++overlapping;
      continue;
    }
    const double distortion = distortion_to_good(chart, *valid);
    if (distortion < best.loss) best = {valid, distortion};
    if (best.loss <= kShapesKept) break;
  }
  return best;
}

}  // namespace

std::optional<Chart> untangle_chart(const Chart& chart, bool may_overlap, int threads, Monitor& monitor) {
  const std::vector<char> bad = bad_triangles(chart), misshapen = misshapen_triangles(chart);
  Untangled best = untangle_rings(chart, bad, misshapen, may_overlap, threads, monitor);
  // Where the artist's UVs are far from the surface all over, what looks drawn out may be meant.
  if (best.loss > kShapesKept && misshapen != bad) {
    Untangled kept = untangle_rings(chart, bad, bad, may_overlap, threads, monitor);
    if (kept.loss < best.loss) best = std::move(kept);
  }
  return best.chart;
}

}  // namespace atlas_refine
