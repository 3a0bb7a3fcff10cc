// Edges of polygons by how they bend, who sees them, and what the artist said of them.
#include "input/price_sides.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "geometry/split_mesh.h"
#include "input/places.h"
#include "input/visibility.h"
#include "support/parallel.h"

namespace atlas_refine {
namespace {

constexpr double kSharpPrice = 0.5;   // of an edge that bends by a right angle or more
constexpr double kHiddenPrice = 0.5;  // of an edge that nobody sees

using VertexPairs = std::vector<std::array<int, 2>>;

/// Edges in space, by the places of their ends.
using SpaceEdges = std::set<std::pair<int, int>>;

SpaceEdges space_edges(const std::vector<int>& place, const VertexPairs& pairs) {
  SpaceEdges out;
  for (const auto& [a, b] : pairs) out.insert(std::minmax(place[a], place[b]));
  return out;
}

/// Per chart and vertex of it a corner of the input that it stands for.
std::vector<std::vector<int>> corners_at_vertices(const ChartSet& set) {
  std::vector<std::vector<int>> out;
  for (const Chart& chart : set.charts) out.emplace_back(chart.vertex_count(), -1);
  for (int c = 0; c < static_cast<int>(set.corners.size()); ++c) {
    if (set.corners[c].chart >= 0) out[set.corners[c].chart][set.corners[c].vertex] = c;
  }
  return out;
}

/// What is asked of edges in space.
struct Wishes {
  const Atlas& atlas;
  std::vector<int> place;
  SpaceEdges forbidden, preferred;
  std::vector<double> visible;  ///< per vertex of the input; empty: seams do not run along edges
};

/// One chart and where its vertices lie in space.
struct ChartInSpace {
  const Chart& chart;
  SplitMesh mesh;
  std::vector<int> vertices;  // of the input

  Vec3 normal(const Wishes& wishes, int triangle) const {
    std::array<Vec3, 3> p;
    for (int k = 0; k < 3; ++k) p[k] = wishes.atlas.positions[vertices[chart.triangles[triangle][k]]];
    return (p[1] - p[0]).cross(p[2] - p[0]);
  }

  /// How far the surface bends at an inner side, as a share of a right angle, at most 1.
  double bend(const Wishes& wishes, const Side& side) const {
    const Vec3 one = normal(wishes, side.triangle), other = normal(wishes, mesh.neighbours[side.triangle][side.side]);
    const double angle_rad = std::atan2(one.cross(other).norm(), one.dot(other));
    return std::min(1.0, angle_rad / (0.5 * std::numbers::pi));
  }

  double price(const Wishes& wishes, const Side& side) const {
    const auto edge = std::minmax(wishes.place[vertices[mesh.from(side)]], wishes.place[vertices[mesh.to(side)]]);
    if (wishes.forbidden.contains(edge)) return kNoSeam;
    const int across = mesh.neighbours[side.triangle][side.side];
    if (wishes.visible.empty() || across < 0) return 1;
    if (chart.triangle_faces[side.triangle] == chart.triangle_faces[across]) return kNoSeam;
    const double sharp = 1 - (1 - kSharpPrice) * bend(wishes, side);
    const double visible = 0.5 * (wishes.visible[edge.first] + wishes.visible[edge.second]);
    const double price = sharp * (1 - (1 - kHiddenPrice) * (1 - visible));
    return wishes.preferred.contains(edge) ? kPreferredSeam * price : price;
  }
};

SidePrices prices_of(const Wishes& wishes, const ChartInSpace& chart) {
  SidePrices out(chart.mesh.triangle_count());
  for (int t = 0; t < chart.mesh.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) out[t][k] = chart.price(wishes, {t, k});
  }
  return out;
}

}  // namespace

std::vector<SidePrices> price_sides(const Atlas& atlas, const ChartSet& set, const RefineOptions& options) {
  std::vector<SidePrices> out(set.charts.size());
  if (options.cut == Cut::Split && options.no_seam.empty()) return out;
  Wishes wishes{atlas, places(atlas), {}, {}, {}};
  if (options.cut == Cut::Edges) wishes.visible = visibility(atlas, resolve_threads(options.threads));
  wishes.forbidden = space_edges(wishes.place, options.no_seam);
  wishes.preferred = space_edges(wishes.place, options.prefer_seam);
  std::vector<std::vector<int>> corners = corners_at_vertices(set);
  for (std::size_t c = 0; c < out.size(); ++c) {
    std::vector<int>& vertices = corners[c];
    for (int& corner : vertices) corner = corner < 0 ? 0 : atlas.corner_vertices[corner];
    out[c] = prices_of(wishes, {set.charts[c], SplitMesh(set.charts[c]), std::move(vertices)});
  }
  return out;
}

}  // namespace atlas_refine
