// Pieces from divided charts, and taking them apart.
#include "cut/cut_atlas.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "atlas_refine/error.h"
#include "cut/boundary_places.h"

namespace atlas_refine {
namespace {

/// What a vertex of a piece is on the surface: a vertex of the chart, or ~k for points[k].
int end_of(const Piece& piece, int vertex) { return piece.points[vertex] >= 0 ? ~piece.points[vertex] : piece.vertices[vertex]; }

Seam seam_of(const Piece& piece, int from, int to) {
  const auto [low, high] = std::minmax({end_of(piece, from), end_of(piece, to)});
  return {piece.chart, {low, high}};
}

/// Edges of the chart's own boundary, as pairs of its vertices.
std::set<std::pair<int, int>> natural_boundary(const Chart& chart) {
  std::set<std::pair<int, int>> edges;
  for (const std::vector<int>& loop : chart.boundary_loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) edges.insert(std::minmax(loop[k], loop[(k + 1) % loop.size()]));
  }
  return edges;
}

/// True where a boundary side of the mesh is part of an edge of the chart's own boundary.
bool is_natural(const SplitMesh& mesh, const Side& side, const std::set<std::pair<int, int>>& natural) {
  std::set<int> ends;
  for (int v : {mesh.from(side), mesh.to(side)}) {
    for (int w : mesh.supports[v].vertices) {
      if (w >= 0) ends.insert(w);
    }
  }
  return ends.size() == 2 && natural.contains({*ends.begin(), *ends.rbegin()});
}

/// Boundary sides where the chart was whole: where it has been opened. Each is met from both sides and counts once.
void add_openings(const SplitMesh& mesh, const Chart& source, const Piece& piece, std::vector<Seam>& seams) {
  const auto natural = natural_boundary(source);
  std::set<std::array<int, 2>> seen;
  for (const auto& loop : mesh.boundary_loops()) {
    for (const Side& s : loop) {
      if (is_natural(mesh, s, natural)) continue;
      const Seam seam = seam_of(piece, mesh.from(s), mesh.to(s));
      if (seen.insert(seam.ends).second) seams.push_back(seam);
    }
  }
}

Piece piece_of(const SplitMesh& mesh, int chart, const Chart& source, std::vector<int> points) {
  Piece piece{.chart = chart,
              .mesh = mesh.to_chart(source),
              .vertices = {},
              .points = std::move(points),
              .sources = mesh.sources,
              .supports = mesh.supports};
  for (int v = 0; v < mesh.vertex_count(); ++v)
    piece.vertices.push_back(piece.points[v] >= 0 ? -1 : mesh.supports[v].vertices[0]);
  return piece;
}

/// The connected part of each triangle, numbered in the order of their first triangles.
std::vector<int> parts_of(const SplitMesh& mesh) {
  std::vector<int> part(mesh.triangle_count(), -1);
  int count = 0;
  for (int seed = 0; seed < mesh.triangle_count(); ++seed) {
    if (part[seed] >= 0) continue;
    std::vector<int> stack = {seed};
    part[seed] = count;
    while (!stack.empty()) {
      const int t = stack.back();
      stack.pop_back();
      for (int other : mesh.neighbours[t]) {
        if (other < 0 || part[other] >= 0) continue;
        part[other] = count;
        stack.push_back(other);
      }
    }
    ++count;
  }
  return part;
}

/// Triangles of a mesh and its vertices dealt out to the pieces that they belong to.
class Dealer {
 public:
  Dealer(const SplitMesh& mesh, int chart) : mesh_(mesh), part_(parts_of(mesh)), local_(mesh.vertex_count(), -1) {
    const int count = 1 + *std::max_element(part_.begin(), part_.end());
    pieces_.assign(count, {.chart = chart, .mesh = {}, .vertices = {}, .points = {}, .sources = {}, .supports = {}});
    shapes_.resize(count);
  }

  std::vector<Piece> run(const Chart& whole, const std::vector<int>& points) {
    for (Piece& piece : pieces_) piece.mesh.number = whole.number;
    for (int t = 0; t < mesh_.triangle_count(); ++t) deal(t, whole, points);
    for (const std::vector<int>& loop : mesh_.vertex_loops()) {
      const int triangle = mesh_.fan(loop.front()).front().triangle;
      std::vector<int>& own = pieces_[part_[triangle]].mesh.boundary_loops.emplace_back();
      for (int v : loop) own.push_back(local_[v]);
    }
    for (std::size_t p = 0; p < pieces_.size(); ++p) pieces_[p].mesh.surface = Surface(std::move(shapes_[p]));
    deal_guards(whole);
    return std::move(pieces_);
  }

 private:
  void deal(int t, const Chart& whole, const std::vector<int>& points) {
    Piece& piece = pieces_[part_[t]];
    Triangle triangle = mesh_.triangles[t];
    for (int& v : triangle) {
      if (local_[v] < 0) {
        local_[v] = piece.mesh.vertex_count();
        piece.mesh.uvs.push_back(mesh_.uvs[v]);
        piece.vertices.push_back(points[v] >= 0 ? -1 : mesh_.supports[v].vertices[0]);
        piece.points.push_back(points[v]);
        piece.supports.push_back(mesh_.supports[v]);
      }
      v = local_[v];
    }
    piece.mesh.triangles.push_back(triangle);
    shapes_[part_[t]].push_back(whole.surface[t]);
    piece.sources.push_back(mesh_.sources[t]);
    piece.mesh.triangle_faces.push_back(whole.triangle_faces[t]);
  }

  void deal_guards(const Chart& whole) {
    for (Guard guard : whole.guards) {
      // All vertices of a whole face have their one fan in the face's own piece.
      Chart& mesh = pieces_[part_[mesh_.fan(guard.triangle[0]).front().triangle]].mesh;
      for (int& v : guard.triangle) v = local_[v];
      mesh.guards.push_back(guard);
    }
  }

  const SplitMesh& mesh_;
  std::vector<int> part_;   // of each triangle
  std::vector<int> local_;  // number of each vertex in its piece
  std::vector<Piece> pieces_;
  std::vector<std::vector<RestTriangle>> shapes_;
};

}  // namespace

CutAtlas whole_atlas(const std::vector<Chart>& charts) {
  CutAtlas out;
  for (std::size_t c = 0; c < charts.size(); ++c) {
    const Chart& chart = charts[c];
    Piece piece{.chart = static_cast<int>(c), .mesh = chart, .vertices = {}, .points = {}, .sources = {}, .supports = {}};
    piece.vertices.resize(chart.vertex_count());
    piece.sources.resize(chart.triangles.size());
    std::iota(piece.vertices.begin(), piece.vertices.end(), 0);
    std::iota(piece.sources.begin(), piece.sources.end(), 0);
    piece.points.assign(chart.vertex_count(), -1);
    for (int v = 0; v < chart.vertex_count(); ++v) piece.supports.push_back({{v, -1, -1}, {1, 0, 0}});
    out.pieces.push_back(std::move(piece));
  }
  return out;
}

CutAtlas divided_atlas(const std::vector<SplitMesh>& meshes, const std::vector<Chart>& sources,
                       const std::vector<std::vector<int>>& space_points) {
  CutAtlas out;
  PointNumbers numbers(space_points, out.points, borders_in_space(meshes, space_points));
  for (int c = 0; c < static_cast<int>(meshes.size()); ++c) {
    out.pieces.push_back(piece_of(meshes[c], c, sources[c], numbers.of_chart(c, meshes[c])));
    add_openings(meshes[c], sources[c], out.pieces.back(), out.seams);
  }
  return out;
}

CutAtlas cut_along(const CutAtlas& atlas, const std::vector<Chart>& sources, std::span<const SurfacePath> paths) {
  CutAtlas out{.pieces = {}, .points = atlas.points, .seams = atlas.seams};
  std::vector<std::vector<const SurfacePath*>> own(atlas.pieces.size());
  for (const SurfacePath& path : paths) own[path.piece].push_back(&path);
  for (std::size_t p = 0; p < atlas.pieces.size(); ++p) {
    const Piece& piece = atlas.pieces[p];
    SplitMesh mesh = mesh_of(piece);
    std::vector<Side> sides;
    for (const SurfacePath* path : own[p]) {
      for (std::size_t k = 0; k + 1 < path->vertices.size(); ++k) {
        sides.push_back(mesh.find_side(path->vertices[k], path->vertices[k + 1]));
        if (sides.back().triangle < 0) throw RefineError(ErrorCode::NotCertified, "cut", "a cut leaves the edges of its chart");
      }
    }
    for (const Side& s : sides) out.seams.push_back(seam_of(piece, mesh.from(s), mesh.to(s)));
    std::vector<int> points = piece.points;
    for (int original : mesh.cut(sides)) points.push_back(points[original]);
    const Chart whole = mesh.to_chart(sources[piece.chart]);
    for (Piece& part : Dealer(mesh, piece.chart).run(whole, points)) out.pieces.push_back(std::move(part));
  }
  return out;
}

bool is_whole(const Piece& piece, const Chart& chart) {
  const bool divided = std::any_of(piece.points.begin(), piece.points.end(), [](int p) { return p >= 0; });
  return !divided && piece.mesh.vertex_count() == chart.vertex_count();
}

SplitMesh mesh_of(const Piece& piece) {
  SplitMesh mesh(piece.mesh);
  mesh.sources = piece.sources;
  mesh.supports = piece.supports;
  return mesh;
}

std::vector<std::vector<int>> points_in_space(const CutAtlas& atlas, const std::vector<std::vector<int>>& space_points) {
  std::vector<std::vector<int>> out;
  for (const Piece& piece : atlas.pieces) {
    std::vector<int>& own = out.emplace_back();
    for (int v = 0; v < piece.mesh.vertex_count(); ++v)
      own.push_back(piece.vertices[v] < 0 ? ~v : space_points[piece.chart][piece.vertices[v]]);
  }
  return out;
}

std::vector<Chart> meshes_of(const CutAtlas& atlas) {
  std::vector<Chart> out;
  for (const Piece& piece : atlas.pieces) out.push_back(piece.mesh);
  return out;
}

std::vector<int> charts_of(const CutAtlas& atlas) {
  std::vector<int> out;
  for (const Piece& piece : atlas.pieces) out.push_back(piece.chart);
  return out;
}

std::vector<std::vector<Vec2>> uvs_of(const std::vector<Chart>& charts) {
  std::vector<std::vector<Vec2>> out;
  out.reserve(charts.size());
  for (const Chart& chart : charts) out.push_back(chart.uvs);
  return out;
}

CutAtlas with_uvs(CutAtlas atlas, const std::vector<std::vector<Vec2>>& uvs) {
  for (std::size_t p = 0; p < atlas.pieces.size(); ++p) atlas.pieces[p].mesh.uvs = uvs[p];
  return atlas;
}

}  // namespace atlas_refine
