// Triangles of pieces back to polygons.
#include "report/cut_faces.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "atlas_refine/error.h"
#include "geometry/convex_polygon.h"
#include "geometry/predicates.h"

namespace atlas_refine {
namespace {

/// What the faces are made from.
struct Sources {
  const Atlas& atlas;
  const ChartSet& set;
  const CutAtlas& cut;
  const CutFaceOptions& options;

  int begin(int face) const { return atlas.face_offsets[face]; }
  int end(int face) const { return atlas.face_offsets[face + 1]; }
  const Vec3& position(int corner) const { return atlas.positions[atlas.corner_vertices[corner]]; }
  /// The corner of a face that is this vertex of its chart, -1 where it has none.
  int corner_of(int face, int vertex) const {
    for (int c = begin(face); c < end(face); ++c) {
      if (set.corners[c].vertex == vertex) return c;
    }
    return -1;
  }
};

/// Triangles of one face in one piece.
struct FacePart {
  int piece;
  std::vector<int> triangles;
};

/// Of each face.
std::vector<std::vector<FacePart>> parts_of_faces(const Sources& in) {
  std::vector<std::vector<FacePart>> out(in.atlas.face_count());
  for (int p = 0; p < static_cast<int>(in.cut.pieces.size()); ++p) {
    const std::vector<int>& faces = in.cut.pieces[p].mesh.triangle_faces;
    for (int t = 0; t < static_cast<int>(faces.size()); ++t) {
      std::vector<FacePart>& parts = out[faces[t]];
      if (parts.empty() || parts.back().piece != p) parts.push_back({p, {}});
      parts.back().triangles.push_back(t);
    }
  }
  return out;
}

/// An edge of the face that it runs along once, as vertices of its chart: some polygons reach their holes along an edge to and
/// fro.
std::pair<int, int> outer_edge(const Sources& in, int face) {
  std::set<std::pair<int, int>> edges;
  for (int c = in.begin(face), end = in.end(face); c < end; ++c)
    edges.emplace(in.set.corners[c].vertex, in.set.corners[c + 1 < end ? c + 1 : in.begin(face)].vertex);
  return *std::find_if(edges.begin(), edges.end(), [&](const auto& edge) { return !edges.contains({edge.second, edge.first}); });
}

/// True where the chart has the face wound against the input.
bool is_turned(const Sources& in, int face) {
  const auto [from, to] = outer_edge(in, face);
  const Chart& chart = in.set.charts[in.set.corners[in.begin(face)].chart];
  // Triangles of a chart are ordered by their face.
  const std::vector<int>& faces = chart.triangle_faces;
  const auto first = std::lower_bound(faces.begin(), faces.end(), face) - faces.begin();
  for (auto t = first; t < std::ssize(faces) && faces[t] == face; ++t) {
    const Triangle& corners = chart.triangles[t];
    for (int k = 0; k < 3; ++k) {
      if (corners[k] == from && corners[(k + 1) % 3] == to) return false;
    }
  }
  return true;
}

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

/// The ends of an edge of the input, the smaller vertex first.
using Ends = std::pair<int, int>;

/// The points that pieces use.
struct UsedPoints {
  std::vector<int> index;  ///< of each point among `vertices`, -1 where no piece uses it any more
  std::vector<NewVertex> vertices;
  std::set<Ends> lie_together = {};
  std::map<std::pair<int, Ends>, int> of_edges = {};  ///< the vertex for an index on such an edge
  std::set<int> taken = {};                           ///< indices that such an edge has as they are
};

/// The input's, of each chart's vertex.
std::vector<std::vector<int>> vertices_of_charts(const Sources& in) {
  std::vector<std::vector<int>> out;
  for (const Chart& chart : in.set.charts) out.emplace_back(chart.vertex_count(), -1);
  for (int c = 0; c < in.atlas.corner_count(); ++c) {
    const CornerRef& corner = in.set.corners[c];
    if (corner.chart >= 0) out[corner.chart][corner.vertex] = in.atlas.corner_vertices[c];
  }
  return out;
}

/// Edges that lie where another edge of their triangle lies, as beside a cone's tip that is many vertices at one place.
std::set<Ends> edges_that_lie_together(const Sources& in) {
  const std::vector<std::vector<int>> vertices = vertices_of_charts(in);
  std::set<Ends> out;
  for (std::size_t c = 0; c < vertices.size(); ++c) {
    const std::vector<int>& points = in.set.points[c];
    for (const Triangle& t : in.set.charts[c].triangles) {
      for (int k = 0; k < 3; ++k) {
        const int a = t[k], b = t[(k + 1) % 3], tip = t[(k + 2) % 3];
        if (points[a] != points[b]) continue;
        for (const int end : {a, b}) out.insert(std::minmax(vertices[c][end], vertices[c][tip]));
      }
    }
  }
  return out;
}

/// A point as corners of one face of its own chart; nothing where the face is another one.
std::optional<NewVertex> point_on_face(const Sources& in, int face, const Support& support) {
  NewVertex vertex{{-1, -1, -1}, Vec3::Zero()};
  for (int k = 0; k < 3 && support.vertices[k] >= 0; ++k) {
    vertex.corners[k] = in.corner_of(face, support.vertices[k]);
    vertex.weights[k] = support.weights[k];
    if (vertex.corners[k] < 0) return {};
  }
  for (int c = in.begin(face); vertex.corners[2] < 0; ++c) {
    if (c != vertex.corners[0] && c != vertex.corners[1]) vertex.corners[2] = c;
  }
  return vertex;
}

/// Each point gets its corners from the first face that has it.
UsedPoints used_points(const Sources& in, const std::vector<std::vector<FacePart>>& parts) {
  UsedPoints out{.index = std::vector<int>(in.cut.points.size(), -1), .vertices = {}};
  int count = 0;
  for (const Piece& piece : in.cut.pieces) {
    for (int point : piece.points) {
      if (point >= 0 && out.index[point] < 0) out.index[point] = count++;
    }
  }
  std::vector<std::optional<NewVertex>> found(count);
  const auto locate = [&](int face, const Piece& piece, int point) {
    if (point < 0 || found[out.index[point]] || in.cut.points[point].chart != piece.chart) return;
    found[out.index[point]] = point_on_face(in, face, in.cut.points[point].support);
  };
  for (int f = 0; f < in.atlas.face_count(); ++f) {
    for (const FacePart& part : parts[f]) {
      const Piece& piece = in.cut.pieces[part.piece];
      for (int t : part.triangles) {
        for (int v : piece.mesh.triangles[t]) locate(f, piece, piece.points[v]);
      }
    }
  }
  for (const auto& vertex : found) {
    if (!vertex) throw RefineError(ErrorCode::NotCertified, "certify", "the result was withheld: a new vertex lies on no face");
    out.vertices.push_back(*vertex);
  }
  return out;
}

/// A corner of the output as a mean of corners of one input face.
struct CornerMean {
  std::array<int, 3> sources;
  Vec3 weights;
};

/// The corner of `face` at the position of `corner`, which may be another face's, among those that support a vertex of the face;
/// of several at one position that in place k. Vertices may be doubled, so positions tell.
int same_corner(const Sources& in, int face, const Support& support, int corner, int k) {
  for (int place : {k, 0, 1, 2}) {
    if (support.vertices[place] < 0) continue;
    const int own = in.corner_of(face, support.vertices[place]);
    if (own >= 0 && in.position(own) == in.position(corner)) return own;
  }
  assert(!"a new vertex is not a point of its face");
  return -1;
}

/// A new vertex seen from `face`, which has it inside or on an edge; `support` says where it lies on the face's own chart. The
/// vertex's weights hold for all of its faces: its position is the same in each, to the last bit.
CornerMean mean_on_face(const Sources& in, int face, const Support& support, const NewVertex& vertex) {
  int heaviest = 0;
  vertex.weights.maxCoeff(&heaviest);
  CornerMean out{{}, vertex.weights};
  out.sources.fill(same_corner(in, face, support, vertex.corners[heaviest], heaviest));
  for (int k = 0; k < 3; ++k) {
    if (vertex.weights[k] > 0 && k != heaviest) out.sources[k] = same_corner(in, face, support, vertex.corners[k], k);
  }
  return out;
}

/// Starts a face where the input's face starts: at the lowest of its corners that the outline has.
void start_at_lowest_corner(const Sources& in, int face, const Piece& piece, std::vector<int>& outline) {
  auto start = outline.begin();
  int lowest = in.end(face);
  for (auto v = outline.begin(); v != outline.end(); ++v) {
    const int corner = piece.vertices[*v] >= 0 ? in.corner_of(face, piece.vertices[*v]) : -1;
    if (corner < 0 || corner >= lowest) continue;
    lowest = corner;
    start = v;
  }
  std::rotate(outline.begin(), start, outline.end());
}

int doubled(int index, const Sources& in, UsedPoints& points, CutFaces& out) {
  points.vertices.push_back(NewVertex(points.vertices[index]));
  out.positions.push_back(Vec3(out.positions[in.atlas.positions.size() + index]));
  return static_cast<int>(points.vertices.size()) - 1;
}

/// The index of a point's new vertex, seen from `face`. Of edges that lie together each has its own; where a face runs along one
/// edge to and fro, the second is doubled.
int new_vertex(const Sources& in, int face, const Piece& piece, int v, UsedPoints& points, CutFaces& out) {
  int index = points.index[piece.points[v]];
  const Support& support = piece.supports[v];
  if (support.vertices[2] < 0) {
    const auto vertex = [&](int k) { return in.atlas.corner_vertices[in.corner_of(face, support.vertices[k])]; };
    const Ends edge = std::minmax(vertex(0), vertex(1));
    if (const auto own = points.of_edges.find({index, edge}); own != points.of_edges.end()) {
      index = own->second;
    } else if (points.lie_together.contains(edge)) {
      const bool free = points.taken.insert(index).second;
      const int fresh = free ? index : doubled(index, in, points, out);
      points.of_edges.emplace(std::pair(index, edge), fresh);
      index = fresh;
    }
  }
  const auto first = out.mesh.corner_vertices.begin() + out.mesh.face_offsets.back();
  const int vertex = static_cast<int>(in.atlas.positions.size()) + index;
  const bool named = std::find(first, out.mesh.corner_vertices.end(), vertex) != out.mesh.corner_vertices.end();
  return named ? doubled(index, in, points, out) : index;
}

void add_face(const Sources& in, int face, int piece, const std::vector<int>& outline, UsedPoints& points, CutFaces& out) {
  const Piece& p = in.cut.pieces[piece];
  for (int v : outline) {
    const int corner = p.vertices[v] >= 0 ? in.corner_of(face, p.vertices[v]) : -1;
    const int index = corner >= 0 ? -1 : new_vertex(in, face, p, v, points, out);
    const CornerMean mean = corner >= 0 ? CornerMean{{corner, corner, corner}, Vec3(1, 0, 0)}
                                        : mean_on_face(in, face, p.supports[v], points.vertices[index]);
    out.mesh.corner_vertices.push_back(corner >= 0 ? in.atlas.corner_vertices[corner]
                                                   : static_cast<int>(in.atlas.positions.size()) + index);
    out.mesh.corner_sources.push_back(mean.sources);
    out.mesh.corner_weights.push_back(mean.weights);
    out.corners.push_back({piece, v});
  }
  out.mesh.face_offsets.push_back(static_cast<int>(out.corners.size()));
  out.mesh.face_sources.push_back(face);
}

/// Within the box of the corners that it is a mean of: far from the origin rounding is coarse against a face, and where these
/// share a coordinate it would lift the vertex out of their plane.
Vec3 mean_position(const Sources& in, const NewVertex& vertex) {
  Vec3 mean = Vec3::Zero(), low, high;
  bool first = true;
  for (int k = 0; k < 3; ++k) {
    if (vertex.weights[k] == 0) continue;
    const Vec3& corner = in.position(vertex.corners[k]);
    mean += vertex.weights[k] * corner;
    low = first ? corner : low.cwiseMin(corner);
    high = first ? corner : high.cwiseMax(corner);
    first = false;
  }
  return mean.cwiseMax(low).cwiseMin(high);
}

std::vector<Vec3> positions_with(const Sources& in, const std::vector<NewVertex>& vertices) {
  std::vector<Vec3> out = in.atlas.positions;
  for (const NewVertex& vertex : vertices) out.push_back(mean_position(in, vertex));
  return out;
}

std::vector<int> meshes_with(const Atlas& atlas, const std::vector<NewVertex>& vertices) {
  std::vector<int> out = atlas.vertex_meshes;
  if (out.empty()) return out;
  for (const NewVertex& vertex : vertices) out.push_back(atlas.vertex_meshes[atlas.corner_vertices[vertex.corners[0]]]);
  return out;
}

/// True where every division of the outline of an undivided face that was positive in the input still is.
bool reads_as_before(const FaceReading& before, const std::vector<Vec2>& uvs) {
  bool fan = true;
  for (std::size_t i = 2; i < uvs.size(); ++i) fan = fan && orientation(uvs[0], uvs[i - 1], uvs[i]) > 0;
  return fan >= before.fan && is_strictly_convex(uvs) >= before.diagonals;
}

/// Charts that stay mirrored are read from behind.
bool is_mirrored(const std::vector<Vec2>& uvs, const Triangle& own) {
  return orientation(uvs[own[0]], uvs[own[1]], uvs[own[2]]) < 0;
}

/// Whether a part of a face may be written as one polygon; `outline` starts where the input's face does.
bool stays_polygon(const Sources& in, const UsedPoints& points, const std::vector<Vec3>& positions, int face,
                   const FacePart& part, const std::vector<int>& outline) {
  const Piece& p = in.cut.pieces[part.piece];
  const std::vector<Vec2>& stored = in.options.uvs[part.piece];
  const Vec2 side(is_mirrored(stored, p.mesh.triangles[part.triangles.front()]) ? -1 : 1, 1);
  std::vector<Vec2> uvs;
  std::vector<Vec3> corners;
  bool is_whole = static_cast<int>(outline.size()) == in.end(face) - in.begin(face);
  for (int v : outline) {
    const int corner = p.vertices[v] >= 0 ? in.corner_of(face, p.vertices[v]) : -1;
    is_whole = is_whole && corner >= 0;
    uvs.push_back(stored[v].cwiseProduct(side));
    corners.push_back(corner >= 0 ? in.position(corner) : positions[in.atlas.positions.size() + points.index[p.points[v]]]);
  }
  if (is_whole) return reads_as_before(in.set.readings[face], uvs);
  // A mesh of triangles stays one. A corner in the middle of a side would make a polygon that other tools may lay flat.
  const bool of_triangle = in.end(face) - in.begin(face) == 3;
  return !of_triangle && !in.options.triangulate && is_clearly_convex(uvs) && is_clearly_convex(corners);
}

/// The outlines of what the part of a face becomes, wound as in the chart.
std::vector<std::vector<int>> outlines_of(const Sources& in, const UsedPoints& points, const std::vector<Vec3>& positions,
                                          int face, const FacePart& part) {
  const Piece& piece = in.cut.pieces[part.piece];
  if (std::vector<int> outline = outline_of(piece.mesh, part.triangles); !outline.empty()) {
    start_at_lowest_corner(in, face, piece, outline);
    if (stays_polygon(in, points, positions, face, part, outline)) return {std::move(outline)};
  }
  std::vector<std::vector<int>> out;
  for (int t : part.triangles) out.emplace_back(piece.mesh.triangles[t].begin(), piece.mesh.triangles[t].end());
  return out;
}

std::vector<std::array<int, 2>> seams_of(const Sources& in, const UsedPoints& points) {
  const std::vector<std::vector<int>> vertices = vertices_of_charts(in);
  std::vector<std::array<int, 2>> out;
  for (const Seam& seam : in.cut.seams) {
    const auto vertex = [&](int end) {
      return end < 0 ? static_cast<int>(in.atlas.positions.size()) + points.index[~end] : vertices[seam.chart][end];
    };
    out.push_back({vertex(seam.ends[0]), vertex(seam.ends[1])});
  }
  return out;
}

}  // namespace

CutFaces cut_faces(const Atlas& atlas, const ChartSet& set, const CutAtlas& cut, const CutFaceOptions& options) {
  const Sources in{atlas, set, cut, options};
  const std::vector<std::vector<FacePart>> parts = parts_of_faces(in);
  UsedPoints points = used_points(in, parts);
  points.lie_together = edges_that_lie_together(in);
  CutFaces out;
  out.mesh.face_offsets = {0};
  out.positions = positions_with(in, points.vertices);
  for (int f = 0; f < atlas.face_count(); ++f) {
    if (parts[f].empty()) continue;
    const bool turned = is_turned(in, f);
    for (const FacePart& part : parts[f]) {
      for (std::vector<int>& outline : outlines_of(in, points, out.positions, f, part)) {
        if (turned) std::reverse(outline.begin(), outline.end());
        start_at_lowest_corner(in, f, cut.pieces[part.piece], outline);
        add_face(in, f, part.piece, outline, points, out);
      }
    }
  }
  out.mesh.new_seams = seams_of(in, points);
  out.vertex_meshes = meshes_with(atlas, points.vertices);
  out.mesh.new_vertices = std::move(points.vertices);
  return out;
}

}  // namespace atlas_refine
