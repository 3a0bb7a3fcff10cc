// Triangles of pieces back to polygons.
#include "report/cut_faces.h"

#include <algorithm>
#include <map>

namespace atlas_refine {
namespace {

/// Triangles of one face in one piece.
struct FacePart {
  int piece;
  std::vector<int> triangles;
};

/// The one loop around the triangles, empty where there are several or some vertex lies inside.
std::vector<int> outline_of(const Chart& mesh, const std::vector<int>& triangles) {
  std::map<int, int> next;
  std::map<std::pair<int, int>, bool> sides;
  for (int t : triangles) {
    for (int k = 0; k < 3; ++k) sides[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}] = true;
  }
  for (const auto& [side, present] : sides) {
    if (sides.contains({side.second, side.first})) continue;
    if (!next.emplace(side.first, side.second).second) return {};
  }
  if (next.size() != triangles.size() + 2) return {};
  std::vector<int> loop;
  int walk = next.begin()->first;
  do {
    loop.push_back(walk);
    walk = next[walk];
  } while (walk != loop.front() && loop.size() <= next.size());
  return loop.size() == next.size() ? loop : std::vector<int>();
}

class FaceBuilder {
 public:
  FaceBuilder(const Atlas& atlas, const ChartSet& set, const CutAtlas& cut) : atlas_(atlas), set_(set), cut_(cut) {
    out_.positions = atlas.positions;
    out_.mesh.face_offsets = {0};
    number_points();
    parts_.resize(atlas.face_count());
    for (int p = 0; p < static_cast<int>(cut.pieces.size()); ++p) {
      const Chart& mesh = cut.pieces[p].mesh;
      for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
        auto& parts = parts_[mesh.triangle_faces[t]];
        if (parts.empty() || parts.back().piece != p) parts.push_back({p, {}});
        parts.back().triangles.push_back(t);
      }
    }
  }

  CutFaces run() {
    for (int f = 0; f < atlas_.face_count(); ++f) {
      locate_points(f);
      const bool turned = is_turned(f);
      for (const FacePart& part : parts_[f]) {
        const Chart& mesh = cut_.pieces[part.piece].mesh;
        // A triangle with a corner in the middle of a side would be a polygon that other tools may lay flat: it is divided.
        const std::vector<int> outline = outline_of(mesh, part.triangles);
        const bool triangle = atlas_.face_offsets[f + 1] - atlas_.face_offsets[f] == 3;
        if (!outline.empty() && !triangle) {
          add_face(f, part.piece, outline, turned);
          continue;
        }
        for (int t : part.triangles) add_face(f, part.piece, {mesh.triangles[t].begin(), mesh.triangles[t].end()}, turned);
      }
    }
    for (const Seam& seam : cut_.seams) {
      const auto vertex = [&](int end) { return end < 0 ? vertex_of_point(~end) : vertex_of_chart_[{seam.chart, end}]; };
      out_.mesh.new_seams.push_back({vertex(seam.ends[0]), vertex(seam.ends[1])});
    }
    return std::move(out_);
  }

 private:
  /// The corner of a face that is this vertex of its chart, -1 where it has none.
  int corner_of(int face, int vertex) const {
    for (int c = atlas_.face_offsets[face]; c < atlas_.face_offsets[face + 1]; ++c) {
      if (set_.corners[c].vertex == vertex) return c;
    }
    return -1;
  }

  /// Points that no piece uses any more get no vertex.
  void number_points() {
    index_.assign(cut_.points.size(), -1);
    int count = 0;
    for (const Piece& piece : cut_.pieces) {
      for (int point : piece.points) {
        if (point >= 0 && index_[point] < 0) index_[point] = count++;
      }
    }
    out_.mesh.new_vertices.resize(count);
    out_.positions.resize(atlas_.positions.size() + count);
    located_.assign(count, 0);
  }
  int vertex_of_point(int point) const { return static_cast<int>(atlas_.positions.size()) + index_[point]; }

  /// New points get their corners and positions from the first face that has them.
  void locate_points(int face) {
    for (const FacePart& part : parts_[face]) {
      const Piece& piece = cut_.pieces[part.piece];
      for (int t : part.triangles) {
        for (int v : piece.mesh.triangles[t]) {
          if (piece.points[v] >= 0 && cut_.points[piece.points[v]].chart == piece.chart) locate_point(face, piece.points[v]);
        }
      }
    }
  }
  void locate_point(int face, int point) {
    const int index = index_[point];
    NewVertex& vertex = out_.mesh.new_vertices[index];
    if (located_[index]) return;
    const Support& support = cut_.points[point].support;
    vertex.weights = Vec3::Zero();
    Vec3 position = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      const int corner = support.vertices[k] >= 0 ? corner_of(face, support.vertices[k]) : -1;
      if (support.vertices[k] >= 0 && corner < 0) return;  // another face's
      vertex.corners[k] = corner;
      vertex.weights[k] = corner >= 0 ? support.weights[k] : 0;
      if (corner >= 0) position += support.weights[k] * atlas_.positions[atlas_.corner_vertices[corner]];
    }
    for (int c = atlas_.face_offsets[face]; vertex.corners[2] < 0; ++c) {
      if (c != vertex.corners[0] && c != vertex.corners[1]) vertex.corners[2] = c;
    }
    located_[index] = 1;
    out_.positions[vertex_of_point(point)] = position;
  }

  /// True where the chart has the face wound against the input.
  bool is_turned(int face) const {
    const int begin = atlas_.face_offsets[face], count = atlas_.face_offsets[face + 1] - begin;
    const Chart& chart = set_.charts[set_.corners[begin].chart];
    const int triangle = first_triangle(face);
    std::array<int, 3> at{};
    for (int k = 0; k < 3; ++k) at[k] = corner_of(face, chart.triangles[triangle][k]) - begin;
    int around = 0;
    for (int k = 0; k < 3; ++k) around += ((at[(k + 1) % 3] - at[k]) % count + count) % count;
    return around > count;
  }
  /// Triangles of a chart are ordered by their face.
  int first_triangle(int face) const {
    const std::vector<int>& faces = set_.charts[set_.corners[atlas_.face_offsets[face]].chart].triangle_faces;
    return static_cast<int>(std::lower_bound(faces.begin(), faces.end(), face) - faces.begin());
  }

  void add_face(int face, int piece, std::vector<int> outline, bool turned) {
    if (turned) std::reverse(outline.begin(), outline.end());
    const Piece& p = cut_.pieces[piece];
    // Start where the face started.
    std::size_t start = 0;
    int lowest = atlas_.corner_count();
    std::vector<int> corners;
    for (std::size_t k = 0; k < outline.size(); ++k) {
      corners.push_back(p.vertices[outline[k]] >= 0 ? corner_of(face, p.vertices[outline[k]]) : -1);
      if (corners[k] < 0 || corners[k] >= lowest) continue;
      lowest = corners[k];
      start = k;
    }
    std::rotate(outline.begin(), outline.begin() + start, outline.end());
    std::rotate(corners.begin(), corners.begin() + start, corners.end());
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const int v = outline[k];
      const int vertex = corners[k] >= 0 ? atlas_.corner_vertices[corners[k]] : vertex_of_point(p.points[v]);
      if (corners[k] >= 0) vertex_of_chart_[{p.chart, p.vertices[v]}] = vertex;
      out_.mesh.corner_vertices.push_back(vertex);
      out_.corners.push_back({piece, v});
    }
    out_.mesh.face_offsets.push_back(static_cast<int>(out_.corners.size()));
    out_.mesh.face_sources.push_back(face);
  }

  const Atlas& atlas_;
  const ChartSet& set_;
  const CutAtlas& cut_;
  CutFaces out_;
  std::vector<std::vector<FacePart>> parts_;
  std::vector<int> index_;  // of each point among the new vertices
  std::vector<char> located_;
  std::map<std::pair<int, int>, int> vertex_of_chart_;  // (chart, vertex) -> input vertex
};

}  // namespace

CutFaces cut_faces(const Atlas& atlas, const ChartSet& set, const CutAtlas& cut) { return FaceBuilder(atlas, set, cut).run(); }

}  // namespace atlas_refine
