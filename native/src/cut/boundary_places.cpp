// Matching divided edges across seams.
#include "cut/boundary_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace atlas_refine {
namespace {

// Two points of an edge in space, as fractions of it: symmetric charts are cut at the same places but for rounding.
constexpr double kSamePlace = 1e-4;

/// Where on an edge of the input a vertex that divides it lies.
struct Place {
  SpaceEdge edge;
  double along;  ///< from low to high, in (0, 1)
};

/// Places by edge.
using Places = std::map<SpaceEdge, std::vector<double>>;

/// Where a point between two vertices of its chart lies in space; nothing for a vertex, for a point inside a triangle, and where
/// both ends of the edge are one point: no other edge is known to be the same as that.
std::optional<Place> place_of(const std::vector<int>& space_points, const Support& support) {
  if (support.vertices[1] < 0 || support.vertices[2] >= 0) return std::nullopt;
  const int a = space_points[support.vertices[0]], b = space_points[support.vertices[1]];
  if (a == b) return std::nullopt;
  return Place{{std::min(a, b), std::max(a, b)}, a < b ? support.weights[1] : support.weights[0]};
}

/// The divided edges of one chart in space.
struct ChartEdges {
  const std::vector<int>& space_points;
  const SplitMesh& mesh;

  /// The edge in space that a side runs along; its ends are the edge's, or points on it. Nothing where it runs through a
  /// triangle.
  std::optional<SpaceEdge> edge_of(int from, int to) const {
    std::array<int, 2> ends{-1, -1};
    for (int v : {from, to}) {
      for (int w : mesh.supports[v].vertices) {
        if (w < 0 || w == ends[0] || w == ends[1]) continue;
        if (ends[1] >= 0) return std::nullopt;
        ends[ends[0] >= 0] = w;
      }
    }
    const auto [low, high] = std::minmax(space_points[ends[0]], space_points[ends[1]]);
    return SpaceEdge{low, high};
  }
  /// Nothing where the vertex does not lie on the edge: a side that runs across triangles has ends on two edges.
  std::optional<double> along_of(int vertex, const SpaceEdge& edge) const {
    const auto same = [&](const SpaceEdge& other) { return other.low == edge.low && other.high == edge.high; };
    if (const auto place = place_of(space_points, mesh.supports[vertex]))
      return same(place->edge) ? std::optional(place->along) : std::nullopt;
    if (mesh.supports[vertex].vertices[1] >= 0) return std::nullopt;
    const int point = space_points[mesh.supports[vertex].vertices[0]];
    if (point == edge.low) return 0;
    return point == edge.high ? std::optional(1.0) : std::nullopt;
  }
};

void collect_places(const SplitMesh& mesh, const std::vector<int>& space_points, const std::set<SpaceEdge>& borders,
                    Places& places) {
  const auto collect = [&](const Support& support) {
    const auto place = place_of(space_points, support);
    if (!place || !borders.contains(place->edge)) return;
    std::vector<double>& known = places[place->edge];
    const auto same = [&](double other) { return std::abs(other - place->along) < kSamePlace; };
    if (std::none_of(known.begin(), known.end(), same)) known.push_back(place->along);
  };
  for (const auto& loop : mesh.boundary_loops()) {
    for (const Side& s : loop) collect(mesh.supports[mesh.from(s)]);
  }
  for (const Support& support : mesh.supports) collect(support);
}

/// Where a side is to be divided, as fractions of its edge in space, in the order of the side.
std::vector<double> places_within(double start, double end, std::vector<double> known) {
  std::erase_if(known, [&](double along) {
    const double t = (along - start) / (end - start);
    const bool inside = t > kSamePlace && t < 1 - kSamePlace;
    return !inside || std::abs(along - start) < kSamePlace || std::abs(along - end) < kSamePlace;
  });
  std::sort(known.begin(), known.end(), [&](double a, double b) { return start < end ? a < b : a > b; });
  return known;
}

/// The vertices that were put on the side.
std::vector<int> divide_side(SplitMesh& mesh, const std::vector<int>& space_points, int from, int to, const Places& places) {
  const ChartEdges edges{space_points, mesh};
  const auto edge = edges.edge_of(from, to);
  if (!edge) return {};
  const auto found = places.find(*edge);
  if (found == places.end()) return {};
  auto start = edges.along_of(from, *edge);
  const auto end = edges.along_of(to, *edge);
  if (!start || !end) return {};
  std::vector<int> added;
  for (const double along : places_within(*start, *end, found->second)) {
    const double t = (along - *start) / (*end - *start);
    const Vec2 uv = mesh.uvs[from] + t * (mesh.uvs[to] - mesh.uvs[from]);
    from = mesh.split(mesh.find_side(from, to), t, uv);
    added.push_back(from);
    start = along;
  }
  return added;
}

/// Inner sides too: where more than two faces meet at an edge, some join it inside their chart.
DividedSides divide_sides(SplitMesh& mesh, const std::vector<int>& space_points, const Places& places) {
  std::vector<std::pair<int, int>> sides;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Side s{t, k};
      if (mesh.is_boundary(s) || mesh.twin(s).triangle > t) sides.emplace_back(mesh.from(s), mesh.to(s));
    }
  }
  DividedSides divided;
  for (const auto& [from, to] : sides) {
    std::vector<int> added = divide_side(mesh, space_points, from, to, places);
    if (!added.empty()) divided[{from, to}] = std::move(added);
  }
  return divided;
}

std::vector<char> boundary_vertices(const SplitMesh& mesh) {
  std::vector<char> out(mesh.vertex_count(), 0);
  for (const auto& loop : mesh.boundary_loops()) {
    for (const Side& s : loop) out[mesh.from(s)] = 1;
  }
  return out;
}

}  // namespace

std::set<SpaceEdge> borders_in_space(const std::vector<SplitMesh>& meshes, const std::vector<std::vector<int>>& space_points) {
  std::set<SpaceEdge> borders;
  for (std::size_t c = 0; c < meshes.size(); ++c) {
    const ChartEdges edges{space_points[c], meshes[c]};
    for (const auto& loop : meshes[c].boundary_loops()) {
      for (const Side& s : loop) {
        if (const auto edge = edges.edge_of(meshes[c].from(s), meshes[c].to(s))) borders.insert(*edge);
      }
    }
  }
  return borders;
}

std::vector<DividedSides> match_boundaries(std::vector<SplitMesh>& meshes, const std::vector<std::vector<int>>& space_points) {
  const std::set<SpaceEdge> borders = borders_in_space(meshes, space_points);
  Places places;
  for (std::size_t c = 0; c < meshes.size(); ++c) collect_places(meshes[c], space_points[c], borders, places);
  std::vector<DividedSides> divided;
  for (std::size_t c = 0; c < meshes.size(); ++c) divided.push_back(divide_sides(meshes[c], space_points[c], places));
  return divided;
}

void follow_divided(const std::vector<DividedSides>& divided, std::vector<SurfacePath>& paths) {
  for (SurfacePath& path : paths) {
    const DividedSides& sides = divided[path.piece];
    std::vector<int> out = {path.vertices.front()};
    for (std::size_t k = 0; k + 1 < path.vertices.size(); ++k) {
      const int from = path.vertices[k], to = path.vertices[k + 1];
      if (const auto ahead = sides.find({from, to}); ahead != sides.end())
        out.insert(out.end(), ahead->second.begin(), ahead->second.end());
      if (const auto back = sides.find({to, from}); back != sides.end())
        out.insert(out.end(), back->second.rbegin(), back->second.rend());
      out.push_back(to);
    }
    path.vertices = std::move(out);
  }
}

std::vector<int> PointNumbers::of_chart(int chart, const SplitMesh& mesh) {
  const std::vector<char> on_boundary = boundary_vertices(mesh);
  std::vector<int> numbers(mesh.vertex_count(), -1);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.supports[v].vertices[1] >= 0) numbers[v] = number(chart, mesh.supports[v], on_boundary[v]);
  }
  return numbers;
}

std::vector<int> PointNumbers::joined(int chart, const SplitMesh& mesh, std::vector<int> numbers) {
  const std::vector<char> on_boundary = boundary_vertices(mesh);
  for (std::size_t v = 0; v < numbers.size(); ++v) {
    if (numbers[v] < 0) continue;
    int* known = at(chart, mesh.supports[v], on_boundary[v]);
    if (known && *known < 0) *known = numbers[v];
    if (known) numbers[v] = *known;
  }
  return numbers;
}

std::vector<int> PointNumbers::of_added(int chart, const SplitMesh& mesh, std::vector<int> numbers) {
  for (int v = static_cast<int>(numbers.size()); v < mesh.vertex_count(); ++v)
    numbers.push_back(number(chart, mesh.supports[v], true));
  return numbers;
}

int PointNumbers::number(int chart, const Support& support, bool on_boundary) {
  int* known = at(chart, support, on_boundary);
  if (known && *known >= 0) return *known;
  const int next = static_cast<int>(points_.size());
  if (known) *known = next;
  points_.push_back({chart, support});
  return next;
}

/// The number at that place, -1 where it is still to be given; null where a place has no number of its own.
int* PointNumbers::at(int chart, const Support& support, bool on_boundary) {
  const auto place = place_of(space_points_[chart], support);
  if (!place || !(on_boundary || borders_.contains(place->edge))) return nullptr;
  auto& known = on_edges_[place->edge];
  for (auto& [along, point] : known) {
    if (std::abs(along - place->along) < kSamePlace) return &point;
  }
  return &known.emplace_back(place->along, -1).second;
}

}  // namespace atlas_refine
