// Each piece as a divided mesh, matched, and back.
#include "cut/match_pieces.h"

#include "cut/boundary_places.h"

namespace atlas_refine {

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
  PointNumbers numbers(space_points, atlas.points);
  for (std::size_t p = 0; p < meshes.size(); ++p) numbers.know(atlas.pieces[p].chart, meshes[p], atlas.pieces[p].points);
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
