// Pieces of all parts in one CutAtlas, faces from that.
#include "report/assemble.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "cut/match_pieces.h"
#include "report/certify.h"
#include "report/cut_faces.h"
#include "report/kept_faces.h"
#include "report/stored.h"

namespace atlas_refine {
namespace {

/// All pieces of the result, on the charts of the whole input.
struct Whole {
  CutAtlas atlas;
  std::vector<std::vector<Vec2>> uvs;       // of each piece
  std::vector<char> own;                    // of each piece: these are the input's
  std::vector<std::vector<int>> pieces_of;  // of each chart
};

void add_piece(Piece piece, std::vector<Vec2> uvs, Whole& out, bool own = false) {
  out.pieces_of[piece.chart].push_back(static_cast<int>(out.atlas.pieces.size()));
  out.atlas.pieces.push_back(std::move(piece));
  out.uvs.push_back(std::move(uvs));
  out.own.push_back(own);
}

void add_part(const RefinedPart& part, Whole& out) {
  const int first = static_cast<int>(out.atlas.points.size());
  for (SurfacePoint point : part.atlas.points) {
    point.chart = part.charts[point.chart];
    out.atlas.points.push_back(point);
  }
  const auto moved = [&](int end) { return end < 0 ? ~(~end + first) : end; };
  for (const Seam& seam : part.atlas.seams)
    out.atlas.seams.push_back({part.charts[seam.chart], {moved(seam.ends[0]), moved(seam.ends[1])}});
  for (std::size_t p = 0; p < part.atlas.pieces.size(); ++p) {
    Piece piece = part.atlas.pieces[p];
    piece.chart = part.charts[piece.chart];
    for (int& point : piece.points) point = point < 0 ? -1 : point + first;
    add_piece(std::move(piece), part.uvs[p], out);
  }
}

/// What of a leader lies on what of the chart that follows it.
struct Mapping {
  int chart;                             // the follower
  std::vector<int> vertex;               // the own vertex on each of the leader's
  std::vector<int> triangle;             // the own triangle on each of the leader's
  bool alike = true;                     // own triangles are wound as the leader's
  const std::vector<int>& space_points;  // of the follower's vertices
  /// The own point for one of the leader's and the place in space where it lies on the follower: edges that are one at a tip of
  /// the leader may be several here.
  std::map<std::pair<int, std::array<int, 3>>, int> points;
};

std::array<int, 3> sorted(std::array<int, 3> t) {
  std::sort(t.begin(), t.end());
  return t;
}

Mapping mapping_of(const Follower& follower, const std::vector<Chart>& charts, const std::vector<int>& space_points) {
  const Chart &own = charts[follower.chart], &leader = charts[follower.leader];
  Mapping map{follower.chart, std::vector<int>(leader.vertex_count(), -1), {}, true, space_points, {}};
  for (int v = 0; v < own.vertex_count(); ++v) map.vertex[follower.vertices[v]] = v;
  std::map<std::array<int, 3>, int> numbers;
  for (std::size_t t = 0; t < own.triangles.size(); ++t) numbers[sorted(own.triangles[t])] = static_cast<int>(t);
  for (const Triangle& t : leader.triangles)
    map.triangle.push_back(numbers.at(sorted({map.vertex[t[0]], map.vertex[t[1]], map.vertex[t[2]]})));
  const Triangle &first = leader.triangles.front(), &onto = own.triangles[map.triangle.front()];
  const auto at = std::find(onto.begin(), onto.end(), map.vertex[first[0]]) - onto.begin();
  map.alike = onto[(at + 1) % 3] == map.vertex[first[1]];
  return map;
}

Support moved(Support support, const Mapping& map) {
  for (int& v : support.vertices) v = v < 0 ? -1 : map.vertex[v];
  return support;
}

/// `support`: where on the follower it lies. The leader's point may be told by another chart that has it too.
int own_point(int leaders, const Support& support, Mapping& map, std::vector<SurfacePoint>& points) {
  std::array<int, 3> place{-1, -1, -1};
  for (int k = 0; k < 3; ++k) {
    if (support.vertices[k] >= 0) place[k] = map.space_points[support.vertices[k]];
  }
  const auto [at, added] = map.points.emplace(std::pair(leaders, sorted(place)), static_cast<int>(points.size()));
  if (added) points.push_back({map.chart, support});
  return at->second;
}

/// A part of the leader as the part of the follower that lies on it.
Piece followed(Piece piece, const Chart& own, Mapping& map, std::vector<SurfacePoint>& points) {
  piece.chart = map.chart;
  for (int& v : piece.vertices) v = v < 0 ? -1 : map.vertex[v];
  for (std::size_t v = 0; v < piece.points.size(); ++v) {
    piece.supports[v] = moved(piece.supports[v], map);
    if (piece.points[v] >= 0) piece.points[v] = own_point(piece.points[v], piece.supports[v], map, points);
  }
  for (std::size_t t = 0; t < piece.sources.size(); ++t) {
    piece.sources[t] = map.triangle[piece.sources[t]];
    piece.mesh.triangle_faces[t] = own.triangle_faces[piece.sources[t]];
    if (!map.alike) std::swap(piece.mesh.triangles[t][1], piece.mesh.triangles[t][2]);
  }
  return piece;
}

/// The whole chart at the places of its leader.
void follow_whole(const Follower& follower, const std::vector<Chart>& charts, int piece, Whole& out) {
  const std::vector<int>& stands_for = out.atlas.pieces[piece].vertices;
  std::vector<int> at(stands_for.size());
  for (std::size_t v = 0; v < stands_for.size(); ++v) at[stands_for[v]] = static_cast<int>(v);
  std::vector<Vec2> uvs;
  for (const int v : follower.vertices) uvs.push_back(out.uvs[piece][at[v]]);
  Piece own = std::move(whole_atlas({charts[follower.chart]}).pieces.front());
  own.chart = follower.chart;
  add_piece(std::move(own), std::move(uvs), out);
}

/// Ends of seams: a vertex of the chart, or ~k for point k.
int end_at(const Piece& piece, int vertex) {
  return piece.vertices[vertex] >= 0 ? piece.vertices[vertex] : ~piece.points[vertex];
}

template <class Visit>
void for_border(const Piece& piece, const Visit& visit) {
  for (const std::vector<int>& loop : piece.mesh.boundary_loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) visit(loop[k], loop[(k + 1) % loop.size()]);
  }
}

/// The follower's edges on the leader's seams, which lie on the borders of its pieces.
std::set<std::pair<int, int>> followed_seams(const std::vector<Seam>& seams, int leader, const std::vector<Piece>& leaders,
                                             const std::vector<Piece>& followers) {
  std::set<std::pair<int, int>> cut, out;
  for (const Seam& seam : seams) {
    if (seam.chart == leader) cut.insert(std::minmax(seam.ends[0], seam.ends[1]));
  }
  for (std::size_t p = 0; p < leaders.size(); ++p) {
    for_border(leaders[p], [&](int from, int to) {
      if (cut.contains(std::minmax(end_at(leaders[p], from), end_at(leaders[p], to))))
        out.insert(std::minmax(end_at(followers[p], from), end_at(followers[p], to)));
    });
  }
  return out;
}

void follow(const Follower& follower, const ChartSet& set, Whole& out) {
  const std::vector<Chart>& charts = set.charts;
  const std::vector<int> pieces = out.pieces_of[follower.leader];
  if (pieces.empty()) return;  // the leader stays as it is
  if (pieces.size() == 1 && is_whole(out.atlas.pieces[pieces.front()], charts[follower.leader]))
    return follow_whole(follower, charts, pieces.front(), out);
  Mapping map = mapping_of(follower, charts, set.points[follower.chart]);
  std::vector<Piece> leaders, followers;
  for (const int p : pieces) {
    leaders.push_back(out.atlas.pieces[p]);
    followers.push_back(followed(leaders.back(), charts[follower.chart], map, out.atlas.points));
    add_piece(followers.back(), out.uvs[p], out);
  }
  for (const auto& [from, to] : followed_seams(out.atlas.seams, follower.leader, leaders, followers))
    out.atlas.seams.push_back({follower.chart, {from, to}});
}

/// Charts that no part changed, with the input's UVs.
void add_untouched(const InputAtlas& whole, Whole& out) {
  const std::vector<Chart>& charts = whole.set.charts;
  std::vector<std::vector<Vec2>> given;
  for (const Chart& chart : charts) given.emplace_back(chart.vertex_count());
  for (std::size_t c = 0; c < whole.set.corners.size(); ++c)
    given[whole.set.corners[c].chart][whole.set.corners[c].vertex] = whole.atlas.corner_uvs[c];
  for (int k = 0; k < static_cast<int>(charts.size()); ++k) {
    if (!out.pieces_of[k].empty()) continue;
    Piece piece = std::move(whole_atlas({charts[k]}).pieces.front());
    piece.chart = k;
    add_piece(std::move(piece), std::move(given[k]), out, true);
  }
}

/// The input's faces, the UVs of its corners from the pieces.
AssembledAtlas kept(const InputAtlas& whole, const Whole& pieces) {
  AssembledAtlas out{whole.atlas};
  const std::vector<CornerRef> corners = corners_on_pieces(whole.atlas, whole.set, pieces.atlas);
  for (std::size_t c = 0; c < corners.size(); ++c) {
    if (corners[c].chart >= 0) out.mesh.corner_uvs[c] = pieces.uvs[corners[c].chart][corners[c].vertex];
  }
  out.new_seams = seams_as_vertices(whole.atlas, whole.set, pieces.atlas);
  return out;
}

AssembledAtlas divided(const InputAtlas& whole, bool several, const AssembleOptions& options, Whole& pieces) {
  add_untouched(whole, pieces);
  // Within one part both sides of each seam are divided alike already.
  if (several) match_pieces(pieces.atlas, whole.set.charts, whole.set.points, pieces.uvs);
  CutFaces faces = cut_faces(whole.atlas, whole.set, pieces.atlas, {pieces.uvs, options.triangulate});
  AssembledAtlas out;
  out.mesh = {whole.atlas.name, std::move(faces.positions), faces.mesh.face_offsets, faces.mesh.corner_vertices, {}};
  out.mesh.vertex_meshes = std::move(faces.vertex_meshes);
  for (std::size_t c = 0; c < faces.corners.size(); ++c) {
    const auto [p, vertex] = faces.corners[c];
    const bool own = faces.mesh.corner_weights[c][0] == 1 && pieces.own[p];
    out.mesh.corner_uvs.push_back(own ? whole.atlas.corner_uvs[faces.mesh.corner_sources[c][0]]
                                      : as_stored(pieces.uvs[p][vertex], options.stored));
  }
  out.cut = std::move(faces.mesh);
  return out;
}

}  // namespace

AssembledAtlas assemble(const InputAtlas& whole, const Participants& participants, const std::vector<RefinedPart>& parts,
                        const AssembleOptions& options) {
  const std::vector<Chart>& charts = whole.set.charts;
  Whole pieces{.atlas = {}, .uvs = {}, .own = {}, .pieces_of = std::vector<std::vector<int>>(charts.size())};
  for (const RefinedPart& part : parts) {
    if (part.changed) add_part(part, pieces);
  }
  for (const Follower& follower : participants.followers) follow(follower, whole.set, pieces);
  const bool cut = !pieces.atlas.seams.empty() || !pieces.atlas.points.empty();
  const bool several = parts.size() > 1 || !participants.left.empty() || !participants.followers.empty();
  const int cut_edges = static_cast<int>(pieces.atlas.seams.size());
  AssembledAtlas out = cut && options.divide ? divided(whole, several, options, pieces) : kept(whole, pieces);
  out.cut_edges = cut_edges;
  return out;
}

}  // namespace atlas_refine
