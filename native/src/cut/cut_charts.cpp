// Tracing, matching divided edges across seams, and taking apart.
#include "cut/cut_charts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace atlas_refine {
namespace {

// Two points of an edge in space, as fractions of it: symmetric charts are cut at the same places but for rounding.
constexpr double kSamePlace = 1e-4;

/// A boundary edge in space; `low` < `high` are points in space.
struct SpaceEdge {
  int low, high;
  auto operator<=>(const SpaceEdge&) const = default;
};

/// Where on its boundary edge of the input a vertex of a divided boundary lies.
struct Place {
  SpaceEdge edge;
  double along;  ///< from low to high, in (0, 1)
};

class Cutter {
 public:
  Cutter(const std::vector<AxisAlignedChart>& aligned, const std::vector<Chart>& sources,
         const std::vector<std::vector<int>>& space_points)
      : aligned_(aligned), sources_(sources), space_points_(space_points) {}

  CutCharts run(const std::vector<std::vector<TrailStart>>& trails) {
    for (std::size_t c = 0; c < aligned_.size(); ++c) trace(static_cast<int>(c), trails[c]);
    collect_places();
    for (std::size_t c = 0; c < meshes_.size(); ++c) divide_partners(static_cast<int>(c));
    for (std::size_t c = 0; c < meshes_.size(); ++c) take_apart(static_cast<int>(c), trails[c]);
    return std::move(out_);
  }

 private:
  void trace(int c, const std::vector<TrailStart>& trails) {
    meshes_.push_back(aligned_[c].mesh);
    ends_.emplace_back();
    if (aligned_[c].boundary.empty()) return;
    TrailTracer tracer(meshes_.back(), aligned_[c].boundary, aligned_[c].quarter_turns);
    for (const TrailStart& start : trails) tracer.hold(start.vertex);
    for (const TrailStart& start : trails)
      ends_.back().push_back(tracer.trace(start, TrailTracer::Until::BoundaryOrTrail).back());
  }

  /// The boundary edge of the input that a side of the divided boundary is part of, and where on it the side's ends are.
  bool place_of(int c, const Support& support, Place& place) const {
    if (support.vertices[1] < 0) return false;
    const int a = space_points_[c][support.vertices[0]], b = space_points_[c][support.vertices[1]];
    place.edge = {std::min(a, b), std::max(a, b)};
    place.along = a < b ? support.weights[1] : support.weights[0];
    return support.vertices[2] < 0;
  }

  void collect_places() {
    for (int c = 0; c < static_cast<int>(meshes_.size()); ++c) {
      for (const auto& loop : meshes_[c].boundary_loops()) {
        for (const Side& s : loop) {
          Place place;
          if (place_of(c, meshes_[c].supports[meshes_[c].from(s)], place)) add_place(place);
        }
      }
    }
  }
  void add_place(const Place& place) {
    std::vector<double>& places = places_[place.edge];
    const auto same = [&](double other) { return std::abs(other - place.along) < kSamePlace; };
    if (std::none_of(places.begin(), places.end(), same)) places.push_back(place.along);
  }

  /// The edge in space of a boundary side; its ends are the edge's, or points on it.
  SpaceEdge edge_of(int c, const Side& s) const {
    const SplitMesh& mesh = meshes_[c];
    Place place;
    if (place_of(c, mesh.supports[mesh.from(s)], place) || place_of(c, mesh.supports[mesh.to(s)], place)) return place.edge;
    const int a = space_points_[c][mesh.supports[mesh.from(s)].vertices[0]];
    const int b = space_points_[c][mesh.supports[mesh.to(s)].vertices[0]];
    return {std::min(a, b), std::max(a, b)};
  }
  double along_of(int c, int vertex, const SpaceEdge& edge) const {
    Place place;
    if (place_of(c, meshes_[c].supports[vertex], place)) return place.along;
    return space_points_[c][meshes_[c].supports[vertex].vertices[0]] == edge.low ? 0 : 1;
  }

  /// Puts a vertex on every boundary side where some chart has one at that place in space.
  void divide_partners(int c) {
    SplitMesh& mesh = meshes_[c];
    std::vector<std::pair<int, int>> sides;
    for (const auto& loop : mesh.boundary_loops()) {
      for (const Side& s : loop) sides.emplace_back(mesh.from(s), mesh.to(s));
    }
    while (!sides.empty()) {
      const auto [from, to] = sides.back();
      sides.pop_back();
      const Side side = mesh.find_side(from, to);
      const SpaceEdge edge = edge_of(c, side);
      const auto found = places_.find(edge);
      if (found == places_.end()) continue;
      const double start = along_of(c, from, edge), end = along_of(c, to, edge);
      for (const double along : found->second) {
        const double t = (along - start) / (end - start);
        if (!(t > kSamePlace && t < 1 - kSamePlace) || std::abs(along - start) < kSamePlace || std::abs(along - end) < kSamePlace)
          continue;
        Vec2 uv = mesh.uvs[from] + t * (mesh.uvs[to] - mesh.uvs[from]);
        const int middle = mesh.split(side, t, uv);
        sides.emplace_back(from, middle);
        sides.emplace_back(middle, to);
        break;
      }
    }
  }

  /// Index of the new point that a vertex is: one for all vertices at its place on a boundary edge, else one of its own.
  int point_of(int c, int vertex, bool on_boundary) {
    const Support& support = meshes_[c].supports[vertex];
    Place place;
    if (on_boundary && place_of(c, support, place)) {
      for (const auto& [along, point] : boundary_points_[place.edge]) {
        if (std::abs(along - place.along) < kSamePlace) return point;
      }
      boundary_points_[place.edge].emplace_back(place.along, static_cast<int>(out_.points.size()));
    }
    out_.points.push_back({c, support});
    return static_cast<int>(out_.points.size()) - 1;
  }

  /// Boundary sides along which a hole was cut open, each edge in space once.
  std::vector<Side> opened_sides(int c) const {
    if (aligned_[c].holes_cut == 0) return {};
    std::set<std::pair<int, int>> natural;
    for (const std::vector<int>& loop : sources_[c].boundary_loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) natural.insert(std::minmax(loop[k], loop[(k + 1) % loop.size()]));
    }
    std::set<std::pair<SpaceEdge, long>> seen;
    std::vector<Side> out;
    for (const auto& loop : meshes_[c].boundary_loops()) {
      for (const Side& s : loop) {
        if (natural.contains(chart_edge_of(c, s))) continue;
        const SpaceEdge edge = edge_of(c, s);
        const double middle = 0.5 * (along_of(c, meshes_[c].from(s), edge) + along_of(c, meshes_[c].to(s), edge));
        if (seen.emplace(edge, std::lround(middle / kSamePlace)).second) out.push_back(s);
      }
    }
    return out;
  }
  /// The edge of the input chart that a boundary side is part of.
  std::pair<int, int> chart_edge_of(int c, const Side& s) const {
    std::set<int> ends;
    for (int v : {meshes_[c].from(s), meshes_[c].to(s)}) {
      for (int w : meshes_[c].supports[v].vertices) {
        if (w >= 0) ends.insert(w);
      }
    }
    return {*ends.begin(), *ends.rbegin()};
  }

  void take_apart(int c, const std::vector<TrailStart>& trails) {
    SplitMesh& mesh = meshes_[c];
    std::vector<char> on_boundary(mesh.vertex_count(), 0);
    for (const auto& loop : mesh.boundary_loops()) {
      for (const Side& s : loop) on_boundary[mesh.from(s)] = 1;
    }
    std::vector<int> points(mesh.vertex_count(), -1);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      if (mesh.supports[v].vertices[1] >= 0) points[v] = point_of(c, v, on_boundary[v]);
    }
    std::vector<Side> cuts;
    if (!aligned_[c].boundary.empty()) {
      TrailTracer tracer(mesh, aligned_[c].boundary, aligned_[c].quarter_turns);
      for (std::size_t t = 0; t < trails.size(); ++t) {
        const std::vector<int> path = tracer.path(trails[t], ends_[c][t]);
        for (std::size_t k = 0; k + 1 < path.size(); ++k) cuts.push_back(mesh.find_side(path[k], path[k + 1]));
      }
    }
    const auto end = [&](int v) { return points[v] >= 0 ? ~points[v] : mesh.supports[v].vertices[0]; };
    for (const Side& s : opened_sides(c)) out_.seams.push_back({c, {end(mesh.from(s)), end(mesh.to(s))}});
    for (const Side& s : cuts) out_.seams.push_back({c, {end(mesh.from(s)), end(mesh.to(s))}});
    for (int original : mesh.cut(cuts)) points.push_back(points[original]);
    add_pieces(c, points);
  }

  void add_pieces(int c, const std::vector<int>& points) {
    const SplitMesh& mesh = meshes_[c];
    const Chart whole = mesh.to_chart(sources_[c]);
    std::vector<int> piece_of(mesh.triangle_count(), -1);
    const std::size_t first = out_.pieces.size();
    for (int seed = 0; seed < mesh.triangle_count(); ++seed) {
      if (piece_of[seed] >= 0) continue;
      const int piece = static_cast<int>(out_.pieces.size() - first);
      out_.pieces.push_back({.chart = c, .mesh = {}, .vertices = {}, .points = {}, .sources = {}, .supports = {}});
      std::vector<int> stack = {seed};
      piece_of[seed] = piece;
      while (!stack.empty()) {
        const int t = stack.back();
        stack.pop_back();
        for (int other : mesh.neighbours[t]) {
          if (other < 0 || piece_of[other] >= 0) continue;
          piece_of[other] = piece;
          stack.push_back(other);
        }
      }
    }
    std::vector<int> local(mesh.vertex_count(), -1);
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      CutPiece& piece = out_.pieces[first + piece_of[t]];
      Triangle triangle = mesh.triangles[t];
      for (int& v : triangle) {
        if (local[v] < 0) {
          local[v] = piece.mesh.vertex_count();
          piece.mesh.uvs.push_back(mesh.uvs[v]);
          piece.vertices.push_back(points[v] >= 0 ? -1 : mesh.supports[v].vertices[0]);
          piece.points.push_back(points[v]);
          piece.supports.push_back(mesh.supports[v]);
        }
        v = local[v];
      }
      piece.mesh.triangles.push_back(triangle);
      piece.mesh.rest.push_back(whole.rest[t]);
      piece.sources.push_back(mesh.sources[t]);
      piece.mesh.triangle_faces.push_back(whole.triangle_faces[t]);
    }
    for (const std::vector<int>& loop : mesh.vertex_loops()) {
      const int triangle = mesh.fan(loop.front()).front().triangle;
      std::vector<int>& own = out_.pieces[first + piece_of[triangle]].mesh.boundary_loops.emplace_back();
      for (int v : loop) own.push_back(local[v]);
    }
  }

  const std::vector<AxisAlignedChart>& aligned_;
  const std::vector<Chart>& sources_;
  const std::vector<std::vector<int>>& space_points_;
  std::vector<SplitMesh> meshes_;
  std::vector<std::vector<int>> ends_;  // last vertex of each trail
  std::map<SpaceEdge, std::vector<double>> places_;
  std::map<SpaceEdge, std::vector<std::pair<double, int>>> boundary_points_;
  CutCharts out_;
};

}  // namespace

std::vector<Chart> meshes_of(const CutCharts& cut) {
  std::vector<Chart> out;
  for (const CutPiece& piece : cut.pieces) out.push_back(piece.mesh);
  return out;
}

std::vector<int> charts_of(const CutCharts& cut) {
  std::vector<int> out;
  for (const CutPiece& piece : cut.pieces) out.push_back(piece.chart);
  return out;
}

CutCharts cut_charts(const std::vector<AxisAlignedChart>& aligned, const std::vector<Chart>& sources,
                     const std::vector<std::vector<TrailStart>>& trails, const std::vector<std::vector<int>>& space_points) {
  return Cutter(aligned, sources, space_points).run(trails);
}

}  // namespace atlas_refine
