// Untangling in place, with broken guards as the flipped triangles.
#include "repair/convex_again.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "geometry/guards.h"
#include "geometry/rest_triangle.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "repair/untangle.h"

namespace atlas_refine {
namespace {

constexpr int kMostRings = 4;           // of elements around the broken guards, that may change
constexpr double kMostCost = 2;         // as a factor on E_d: a thin polygon is no gain
constexpr std::size_t kMostAlone = 64;  // broken polygons that are tried one by one where they cannot all be mended
constexpr double kLeastWeight = 1e-3;   // of an element, as a fraction of the mean one

std::set<int> faces_with_guards(const Chart& chart) {
  std::set<int> out;
  for (const Guard& guard : chart.guards) out.insert(guard.face);
  return out;
}

/// The polygons one of whose guards is not positive.
std::set<int> faces_with_broken_guards(const Chart& chart) {
  Chart held = chart;
  drop_broken_guards(held);
  std::set<int> out = faces_with_guards(chart);
  for (const int face : faces_with_guards(held)) out.erase(face);
  return out;
}

/// One flag per vertex: it lies on one of these polygons.
std::vector<char> at_faces(const Chart& chart, const std::set<int>& faces) {
  std::vector<char> out(chart.vertex_count(), 0);
  for (const Guard& guard : chart.guards) {
    if (!faces.contains(guard.face)) continue;
    for (const int v : guard.triangle) out[v] = 1;
  }
  return out;
}

void widen(const Chart& chart, std::vector<char>& near) {
  const std::vector<char> before = near;
  for (const Triangle& t : chart.triangles) {
    if (!before[t[0]] && !before[t[1]] && !before[t[2]]) continue;
    for (const int v : t) near[v] = 1;
  }
}

/// The triangles and guards at free vertices: those of broken polygons are to look as on the surface, the others as they do.
Tangle tangle_at(const Chart& chart, const std::vector<char>& free, const std::set<int>& broken) {
  Tangle out;
  const double scale = texel_density(chart);
  const double least = kLeastWeight * uv_area(chart) / static_cast<double>(chart.triangles.size());
  for_each_element(chart, [&](const Triangle& t, const RestTriangle& surface, double share, int face) {
    if (surface.area == 0 || (!free[t[0]] && !free[t[1]] && !free[t[2]])) return;
    RestTriangle shape = rest_from_plane(chart.uvs[t[0]], chart.uvs[t[1]], chart.uvs[t[2]], 1);
    if (shape.area == 0 || broken.contains(face)) shape = {surface.inverse_edges / scale, surface.area * scale * scale};
    out.triangles.push_back(t);
    out.inverse_edges.push_back(shape.inverse_edges);
    out.weights.push_back(std::max(least, share * shape.area));
  });
  for (const char flag : free) out.fixed.push_back(!flag);
  return out;
}

/// Without the guards of these faces.
Chart without_guards(Chart chart, const std::set<int>& faces) {
  std::erase_if(chart.guards, [&](const Guard& guard) { return faces.contains(guard.face); });
  return chart;
}

/// The UVs with these polygons convex and all guards held; nothing where they were not found.
std::optional<std::vector<Vec2>> made_convex(const Chart& chart, const std::set<int>& faces, bool may_overlap, int threads,
                                             Monitor& monitor) {
  Chart bare = chart;
  bare.guards.clear();
  const double most = kMostCost * dirichlet_sums(bare).best_energy();
  std::vector<char> free = at_faces(chart, faces);
  for (int rings = 0; rings <= kMostRings; ++rings, widen(chart, free)) {
    auto uvs = untangle(tangle_at(chart, free, faces), chart.uvs, threads, monitor);
    if (!uvs) continue;
    Chart mended = chart;
    mended.uvs = std::move(*uvs);
    if (all_guards_hold(mended) && dirichlet_sums(mended).best_energy() < most &&
        (may_overlap || certify_charts({mended}).valid()))
      return std::move(mended.uvs);
  }
  return std::nullopt;
}

}  // namespace

bool all_guards_hold(Chart chart) {
  const std::size_t count = chart.guards.size();
  drop_broken_guards(chart);
  return chart.guards.size() == count;
}

Chart convex_again(const Chart& chart, bool may_overlap, int threads, Monitor& monitor) {
  Chart out = chart;
  std::set<int> broken = faces_with_broken_guards(chart);
  if (broken.empty()) return out;
  if (auto uvs = made_convex(chart, broken, may_overlap, threads, monitor)) {
    out.uvs = std::move(*uvs);
    return out;
  }
  if (broken.size() > kMostAlone) return out;
  for (const int face : std::set<int>(broken)) {
    std::set<int> others = broken;
    others.erase(face);
    auto uvs = made_convex(without_guards(out, others), {face}, may_overlap, threads, monitor);
    if (!uvs) continue;
    out.uvs = std::move(*uvs);
    broken = std::move(others);
  }
  return out;
}

}  // namespace atlas_refine
