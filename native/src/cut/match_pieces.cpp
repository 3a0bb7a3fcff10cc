// Each piece as a divided mesh, matched, and back.
#include "cut/match_pieces.h"

#include <algorithm>

#include "cut/boundary_places.h"

namespace atlas_refine {
namespace {

/// Points at one place in space become one: stacked charts that follow others have points of their own.
void join_points(const std::vector<SplitMesh>& meshes, PointNumbers& numbers, CutAtlas& atlas) {
  std::vector<int> joined(atlas.points.size(), -1);
  for (std::size_t p = 0; p < meshes.size(); ++p) {
    Piece& piece = atlas.pieces[p];
    std::vector<int> points = numbers.joined(piece.chart, meshes[p], piece.points);
    for (std::size_t v = 0; v < points.size(); ++v) {
      if (points[v] >= 0) joined[piece.points[v]] = points[v];
    }
    piece.points = std::move(points);
  }
  for (Seam& seam : atlas.seams) {
    for (int& end : seam.ends) {
      if (end < 0 && joined[~end] >= 0) end = ~joined[~end];
    }
    std::sort(seam.ends.begin(), seam.ends.end());
  }
}

}  // namespace

void match_pieces(CutAtlas& atlas, const std::vector<Chart>& charts, const std::vector<std::vector<int>>& space_points,
                  std::vector<std::vector<Vec2>>& uvs) {
  std::vector<SplitMesh> meshes;
  std::vector<std::vector<int>> places;
  for (std::size_t p = 0; p < atlas.pieces.size(); ++p) {
    meshes.push_back(mesh_of(atlas.pieces[p]));
    meshes.back().uvs = uvs[p];
    places.push_back(space_points[atlas.pieces[p].chart]);
  }
  match_boundaries(meshes, places);
  PointNumbers numbers(space_points, atlas.points, borders_in_space(meshes, places));
  join_points(meshes, numbers, atlas);
  for (std::size_t p = 0; p < meshes.size(); ++p) {
    Piece& piece = atlas.pieces[p];
    if (meshes[p].vertex_count() == piece.mesh.vertex_count()) continue;
    std::vector<int> points = numbers.of_added(piece.chart, meshes[p], piece.points);
    piece.mesh = meshes[p].to_chart(charts[piece.chart]);
    piece.vertices.resize(points.size(), -1);
    piece.points = std::move(points);
    piece.sources = meshes[p].sources;
    piece.supports = meshes[p].supports;
    uvs[p] = meshes[p].uvs;
  }
}

}  // namespace atlas_refine
