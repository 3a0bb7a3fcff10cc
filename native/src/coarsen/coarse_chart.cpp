// Sampling, triangulation and location of one chart.
#include "coarsen/coarse_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/boundary.h"
#include "geometry/rest_triangle.h"
#include "geometry/triangulate_region.h"
#include "measure/distortion.h"
#include "support/profile.h"

namespace atlas_refine {
namespace {

constexpr double kMostKept = 0.5;  // of the vertices: else there is little to gain
constexpr double kFlat = 1e-6;     // sides may be so near to a line

/// Per vertex of the chart its entry in `kept`, -1 where it has none.
std::vector<int> entries_of(const Chart& chart, const std::vector<int>& kept) {
  std::vector<int> entry(chart.vertex_count(), -1);
  for (std::size_t k = 0; k < kept.size(); ++k) entry[kept[k]] = static_cast<int>(k);
  return entry;
}

std::vector<std::vector<int>> renamed(std::vector<std::vector<int>> loops, const std::vector<int>& entry) {
  for (std::vector<int>& loop : loops) {
    for (int& v : loop) v = entry[v];
  }
  return loops;
}

/// Vertices that stay: the boundary, and where the chart is so narrow that a vertex inside joins several stretches of it. What
/// the boundary does there nothing else could follow.
std::vector<char> held_vertices(const Chart& chart) {
  std::vector<char> held = boundary_flags(chart);
  std::vector<int> next(chart.vertex_count(), -1);
  for (const std::vector<int>& loop : chart.boundary_loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) next[loop[k]] = loop[(k + 1) % loop.size()];
  }
  // Around a vertex inside every neighbour comes in two triangles: neighbours on the boundary less boundary edges are stretches.
  std::vector<int> neighbours(chart.vertex_count(), 0), edges(chart.vertex_count(), 0);
  for (const Triangle& t : chart.triangles) {
    for (int k = 0; k < 3; ++k) {
      const int a = t[(k + 1) % 3], b = t[(k + 2) % 3];
      neighbours[t[k]] += held[a] + held[b];
      if (held[a] && next[a] == b) ++edges[t[k]];
    }
  }
  for (int v = 0; v < chart.vertex_count(); ++v) {
    if (neighbours[v] / 2 - edges[v] > 1) held[v] = 1;
  }
  return held;
}

/// Sides of triangles with all corners held: those triangles stay too.
std::vector<std::array<int, 2>> held_sides(const Chart& chart, const std::vector<char>& held, const std::vector<int>& entry) {
  std::vector<std::array<int, 2>> out;
  for (const Triangle& t : chart.triangles) {
    if (!held[t[0]] || !held[t[1]] || !held[t[2]]) continue;
    for (int k = 0; k < 3; ++k) out.push_back({entry[t[k]], entry[t[(k + 1) % 3]]});
  }
  return out;
}

/// Every vertex in the coarse triangle that holds it, found from where a neighbour was found.
std::vector<Place> places_of(const Chart& chart, const CoarseChart& coarse, const Locator& locator) {
  std::vector<Place> places(chart.vertex_count());
  for (std::size_t t = 0; t < coarse.mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      Place& place = places[coarse.kept[coarse.mesh.triangles[t][k]]];
      if (place.triangle >= 0) continue;
      place.triangle = static_cast<int>(t);
      place.weights[k] = 1;
    }
  }
  // Triangles share vertices with those before them, mostly: one pass finds nearly all, and the last passes what is left.
  for (bool left = true; left;) {
    left = false;
    for (const Triangle& t : chart.triangles) {
      int near = -1;
      for (const int v : t) near = std::max(near, places[v].triangle);
      if (near < 0) {
        left = true;
        continue;
      }
      for (const int v : t) {
        if (places[v].triangle < 0) places[v] = locator.locate(chart.uvs[v], near);
      }
    }
  }
  return places;
}

/// Boundary edges have their lengths on the surface. Of other sides nobody asks: where lengths do not close to a triangle, they
/// give way.
Surface surface_of(const Chart& chart, const CoarseChart& coarse) {
  const auto on_surface = surface_lengths(chart);
  const double scale = std::sqrt(chart.surface.area() / uv_area({coarse.mesh}));
  std::vector<RestTriangle> shapes;
  for (const Triangle& t : coarse.mesh.triangles) {
    std::array<double, 3> lengths = {};
    std::array<bool, 3> known = {};
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      const auto own = on_surface.find({coarse.kept[a], coarse.kept[b]});
      known[k] = own != on_surface.end();
      lengths[k] = known[k] ? own->second : scale * (coarse.mesh.uvs[b] - coarse.mesh.uvs[a]).norm();
    }
    for (int k = 0; k < 3; ++k) {
      const double a = lengths[(k + 1) % 3], b = lengths[(k + 2) % 3];
      if (!known[k]) lengths[k] = std::max(std::min(lengths[k], (1 - kFlat) * (a + b)), std::abs(a - b) + kFlat * (a + b));
    }
    shapes.push_back(rest_from_sides(lengths));
  }
  return Surface(std::move(shapes));
}

}  // namespace

Sample sample_of_coarse(const Chart& chart, double spacing) {
  const PhaseScope scope(Phase::Coarsen);
  return sample_vertices(chart, held_vertices(chart), spacing);
}

std::optional<CoarseChart> coarsen(const Chart& chart, Sample sample) {
  const std::vector<char> held = held_vertices(chart);
  if (static_cast<double>(sample.vertices.size()) > kMostKept * chart.vertex_count()) return std::nullopt;
  CoarseChart out;
  out.kept = std::move(sample.vertices);
  const std::vector<int> entry = entries_of(chart, out.kept);
  for (const int v : out.kept) out.mesh.uvs.push_back(chart.uvs[v]);
  out.mesh.boundary_loops = renamed(chart.boundary_loops, entry);
  out.mesh.number = chart.number;
  auto triangles =
      triangulate_region({out.mesh.uvs, out.mesh.boundary_loops, held_sides(chart, held, entry), std::move(sample.near)});
  if (!triangles) return std::nullopt;
  out.mesh.triangles = std::move(*triangles);
  out.mesh.triangle_faces.assign(out.mesh.triangles.size(), chart.triangle_faces.front());
  const Locator locator(out.mesh.uvs, out.mesh.triangles);
  out.places = places_of(chart, out, locator);
  if (std::any_of(out.places.begin(), out.places.end(), [](const Place& place) { return place.triangle < 0; }))
    return std::nullopt;
  out.mesh.surface = surface_of(chart, out);
  return out;
}

}  // namespace atlas_refine
