// Dividing edges.
#include "align/prepare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

namespace atlas_refine {
namespace {

// Boundary edges are divided until they are at most this fraction of the boundary long: corners can only lie at vertices.
constexpr double kLongestEdge = 0.08;

void divide_long_boundary_edges(SplitMesh& mesh) {
  for (const auto& loop : mesh.boundary_loops()) {
    double perimeter = 0;
    for (const Side& s : loop) perimeter += (mesh.uvs[mesh.to(s)] - mesh.uvs[mesh.from(s)]).norm();
    std::vector<std::pair<int, int>> edges;
    for (const Side& s : loop) edges.emplace_back(mesh.from(s), mesh.to(s));
    while (!edges.empty()) {
      const auto [a, b] = edges.back();
      edges.pop_back();
      if ((mesh.uvs[b] - mesh.uvs[a]).norm() <= kLongestEdge * perimeter) continue;
      const int middle = mesh.split(mesh.find_side(a, b), 0.5, 0.5 * (mesh.uvs[a] + mesh.uvs[b]));
      edges.emplace_back(a, middle);
      edges.emplace_back(middle, b);
    }
  }
}

bool has_long_inner_edge(const SplitMesh& mesh) {
  const double least = kLongEdge * side_of_square(mesh);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      if (!mesh.is_boundary({t, k}) && (mesh.uvs[mesh.to({t, k})] - mesh.uvs[mesh.from({t, k})]).norm() > least) return true;
    }
  }
  return false;
}

/// Where boundary edges alone are divided, long faces become fans of slivers, which trails cross askew: the longest edge first,
/// wherever it is.
void divide_long_edges(SplitMesh& mesh) {
  double limit = std::numeric_limits<double>::infinity();
  for (const auto& loop : mesh.boundary_loops()) {
    double perimeter = 0;
    for (const Side& s : loop) perimeter += (mesh.uvs[mesh.to(s)] - mesh.uvs[mesh.from(s)]).norm();
    limit = std::min(limit, kLongestEdge * perimeter);
  }
  std::priority_queue<std::tuple<double, int, int>> edges;
  const auto add = [&](int a, int b) {
    const double length = (mesh.uvs[b] - mesh.uvs[a]).norm();
    if (length > limit) edges.emplace(length, a, b);
  };
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      if (mesh.is_boundary({t, k}) || mesh.from({t, k}) < mesh.to({t, k})) add(mesh.from({t, k}), mesh.to({t, k}));
    }
  }
  while (!edges.empty()) {
    const auto [length, a, b] = edges.top();
    edges.pop();
    const int middle = mesh.split(mesh.find_side(a, b), 0.5, 0.5 * (mesh.uvs[a] + mesh.uvs[b]));
    for (const Side& s : mesh.fan(middle)) {
      add(middle, mesh.to(s));
      if (mesh.is_boundary({s.triangle, (s.side + 2) % 3})) add(mesh.opposite(s), middle);
    }
  }
}

void divide_bridges(SplitMesh& mesh) {
  std::vector<char> outer(mesh.vertex_count(), 0);
  for (const auto& loop : mesh.boundary_loops()) {
    for (const Side& s : loop) outer[mesh.from(s)] = 1;
  }
  std::vector<std::pair<int, int>> bridges;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Side s{t, k};
      if (!mesh.is_boundary(s) && mesh.from(s) < mesh.to(s) && outer[mesh.from(s)] && outer[mesh.to(s)])
        bridges.emplace_back(mesh.from(s), mesh.to(s));
    }
  }
  for (const auto& [a, b] : bridges) {
    const Side side = mesh.find_side(a, b);
    mesh.split(side.triangle >= 0 ? side : mesh.find_side(b, a), 0.5, 0.5 * (mesh.uvs[a] + mesh.uvs[b]));
  }
}

}  // namespace

PreparedChart prepare_chart(const Chart& chart, const SidePrices& prices) {
  PreparedChart out{SplitMesh(chart), {}};
  out.opening = open_to_disk(out.mesh, prices);
  if (!out.opening.is_disk) return out;
  if (has_long_inner_edge(out.mesh)) divide_long_edges(out.mesh);
  divide_long_boundary_edges(out.mesh);
  divide_bridges(out.mesh);
  return out;
}

}  // namespace atlas_refine
