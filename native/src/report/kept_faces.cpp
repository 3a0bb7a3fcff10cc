// Corners found again by their chart's vertices.
#include "report/kept_faces.h"

namespace atlas_refine {

namespace {

/// Any piece of its chart that has the corner's vertex: all that is to be had for corners of faces without triangles.
std::vector<CornerRef> corners_on_any_piece(const ChartSet& set, const CutAtlas& cut) {
  std::vector<std::vector<CornerRef>> at;
  for (const Chart& chart : set.charts) at.emplace_back(chart.vertex_count(), CornerRef{-1, -1});
  for (int p = 0; p < static_cast<int>(cut.pieces.size()); ++p) {
    const Piece& piece = cut.pieces[p];
    for (int v = 0; v < static_cast<int>(piece.vertices.size()); ++v) at[piece.chart][piece.vertices[v]] = {p, v};
  }
  std::vector<CornerRef> out;
  for (const CornerRef& corner : set.corners)
    out.push_back(corner.chart < 0 ? CornerRef{-1, -1} : at[corner.chart][corner.vertex]);
  return out;
}

}  // namespace

std::vector<CornerRef> corners_on_pieces(const Atlas& atlas, const ChartSet& set, const CutAtlas& cut) {
  std::vector<CornerRef> out = corners_on_any_piece(set, cut);
  for (int p = 0; p < static_cast<int>(cut.pieces.size()); ++p) {
    const Piece& piece = cut.pieces[p];
    for (std::size_t t = 0; t < piece.mesh.triangles.size(); ++t) {
      const int face = piece.mesh.triangle_faces[t];
      for (int v : piece.mesh.triangles[t]) {
        for (int c = atlas.face_offsets[face]; c < atlas.face_offsets[face + 1]; ++c) {
          if (set.corners[c].vertex == piece.vertices[v]) out[c] = {p, v};
        }
      }
    }
  }
  return out;
}

std::vector<std::array<int, 2>> seams_as_vertices(const Atlas& atlas, const ChartSet& set, const CutAtlas& cut) {
  std::vector<std::vector<int>> vertices;  // the input's, of each chart's vertex
  for (const Chart& chart : set.charts) vertices.emplace_back(chart.vertex_count(), -1);
  for (std::size_t c = 0; c < set.corners.size(); ++c) {
    if (set.corners[c].chart >= 0) vertices[set.corners[c].chart][set.corners[c].vertex] = atlas.corner_vertices[c];
  }
  std::vector<std::array<int, 2>> out;
  for (const Seam& seam : cut.seams) out.push_back({vertices[seam.chart][seam.ends[0]], vertices[seam.chart][seam.ends[1]]});
  return out;
}

}  // namespace atlas_refine
