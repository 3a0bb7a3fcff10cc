// The nearest image of each corner beside the one before it, and whether it fits the chart better.
#include "input/unwrap_tiles.h"

#include <algorithm>
#include <cmath>

#include "geometry/plane.h"
#include "input/face_areas.h"
#include "support/disjoint_sets.h"

namespace atlas_refine {
namespace {

constexpr double kMostWrapped = 0.5;    // of a chart's area in space, or there is nothing to go by
constexpr double kFlipped = 2;          // what a face that lies against its chart is worse by, in e-folds of its density
constexpr double kClearlyBetter = 0.5;  // likewise
constexpr double kMostAgainst = 0.1;    // faces left the wrong way round, per face that is moved

/// The corners of the face moved by whole tiles so that no edge is longer than half a tile in u or v; none is moved down.
std::vector<Vec2> nearest_images(const Atlas& atlas, int face) {
  std::vector<Vec2> tiles = {Vec2::Zero()};
  for (int c = atlas.face_offsets[face] + 1; c < atlas.face_offsets[face + 1]; ++c) {
    const Vec2 edge = atlas.corner_uvs[c] - atlas.corner_uvs[c - 1];
    tiles.push_back(tiles.back() - Vec2(std::round(edge.x()), std::round(edge.y())));
  }
  Vec2 least = Vec2::Zero();
  for (const Vec2& tile : tiles) least = least.cwiseMin(tile);
  for (std::size_t k = 0; k < tiles.size(); ++k) tiles[k] += atlas.corner_uvs[atlas.face_offsets[face] + k] - least;
  return tiles;
}

/// Faces with an edge that another image would shorten.
std::vector<char> spanning(const Atlas& atlas) {
  std::vector<char> out(atlas.face_count(), 0);
  for (int f = 0; f < atlas.face_count(); ++f) {
    const int first = atlas.face_offsets[f], end = atlas.face_offsets[f + 1];
    for (int c = first; c < end; ++c) {
      const Vec2 edge = atlas.corner_uvs[c + 1 < end ? c + 1 : first] - atlas.corner_uvs[c];
      if (edge.cwiseAbs().maxCoeff() > 0.5) out[f] = 1;
    }
  }
  return out;
}

/// How the faces of a chart that do not span a tile lie.
struct Lie {
  double signed_uv_area = 0, uv_area = 0, area = 0;
  double spanned = 0;  // area in space of the others
  bool kept = false;
  int turned = 0, unturned = 0;  // faces that another image suits better: that lie the wrong way round, and that do not
  int against = 0;               // others that lie the wrong way round
  bool parted = false;           // with these images
  int torn = 0, met = 0;         // with these images: edges of moved faces, and those of them where the map starts again

  /// Where the chart falls apart, or lies all one way before, or still does not, its map does not start again. (A face that
  /// runs back in u and in v is turned over twice.) Nor does it where moved faces are torn from each other more than they meet
  /// faces at the other end of the tile: around a vertex whose UV was lost.
  bool is_mended() const { return !parted && turned > unturned && against <= kMostAgainst * turned && 2 * met >= torn; }
  bool tells() const { return !kept && uv_area > 0 && area > 0 && spanned <= kMostWrapped * (area + spanned); }

  /// How badly a face fits: by density, and by orientation.
  double misfit(double signed_area, double in_space) const {
    if (signed_area == 0 || in_space == 0) return INFINITY;
    const double density = std::abs(std::log(std::abs(signed_area) / in_space * (area / uv_area)));
    return density + (signed_area * signed_uv_area < 0 ? kFlipped : 0);
  }
};

class Unwrapping {
 public:
  Unwrapping(const Atlas& atlas, const EdgeJoins& joins, const std::vector<char>& spans)
      : atlas_(atlas), joins_(joins), spans_(spans), charts_of_(atlas.face_count()), lies_(atlas.face_count()) {}

  UnwrappedTiles run(const std::vector<char>& kept) {
    measure(kept);
    std::vector<std::vector<Vec2>> images(atlas_.face_count());  // of the faces that fit better so
    for (int f = 0; f < atlas_.face_count(); ++f) {
      if (spans_[f]) images[f] = better_image(f);
      Lie& lie = lies_[charts_of_.find(f)];
      const bool against = sign(f) * doubled_uv_area(atlas_, f) * lie.signed_uv_area < 0;
      if (images[f].empty())
        lie.against += against;
      else
        ++(against ? lie.turned : lie.unturned);
    }
    mark_parted(moved(images).corner_uvs);
    count_torn(moved(images));
    UnwrappedTiles out = moved(images);
    if (out.faces.empty()) return {};
    for (const int f : out.faces) find_torn(f, out);
    return out;
  }

 private:
  double sign(int face) const { return joins_.turned_faces[face] ? -1 : 1; }

  void measure(const std::vector<char>& kept) {
    for (int c = 0; c < atlas_.corner_count(); ++c) {
      if (joins_.partners[c] > c) charts_of_.unite(joins_.corner_faces[c], joins_.corner_faces[joins_.partners[c]]);
    }
    for (int f = 0; f < atlas_.face_count(); ++f) {
      Lie& lie = lies_[charts_of_.find(f)];
      const double area = doubled_area_in_space(atlas_, f), uv_area = doubled_uv_area(atlas_, f);
      lie.kept = lie.kept || (!kept.empty() && kept[f]);
      (spans_[f] ? lie.spanned : lie.area) += area;
      if (spans_[f]) continue;
      lie.signed_uv_area += sign(f) * uv_area;
      lie.uv_area += std::abs(uv_area);
    }
  }

  /// The nearest images of the face's corners where it fits its chart clearly better there; else nothing.
  std::vector<Vec2> better_image(int face) {
    const Lie& lie = lies_[charts_of_.find(face)];
    if (!lie.tells()) return {};
    const double in_space = doubled_area_in_space(atlas_, face);
    const double before = lie.misfit(sign(face) * doubled_uv_area(atlas_, face), in_space);
    std::vector<Vec2> moved = nearest_images(atlas_, face);
    const double after = lie.misfit(sign(face) * doubled_area(moved), in_space);
    return after + kClearlyBetter < before ? moved : std::vector<Vec2>();
  }

  /// The charts that other images mend, with these.
  UnwrappedTiles moved(const std::vector<std::vector<Vec2>>& images) {
    UnwrappedTiles out{.faces = {}, .corner_uvs = atlas_.corner_uvs, .torn = {}};
    for (int f = 0; f < atlas_.face_count(); ++f) {
      if (images[f].empty() || !lies_[charts_of_.find(f)].is_mended()) continue;
      std::copy(images[f].begin(), images[f].end(), out.corner_uvs.begin() + atlas_.face_offsets[f]);
      out.faces.push_back(f);
    }
    return out;
  }

  /// Marks the charts that would fall apart.
  void mark_parted(const std::vector<Vec2>& uvs) {
    DisjointSets parts(atlas_.face_count());
    for (int c = 0; c < atlas_.corner_count(); ++c) {
      if (joins_.partners[c] > c && !is_torn(c, uvs))
        parts.unite(joins_.corner_faces[c], joins_.corner_faces[joins_.partners[c]]);
    }
    for (int f = 0; f < atlas_.face_count(); ++f) {
      const int chart = charts_of_.find(f);
      if (parts.find(f) != parts.find(chart)) lies_[chart].parted = true;
    }
  }

  /// At moved faces, by their charts.
  void count_torn(const UnwrappedTiles& out) {
    for (const int f : out.faces) {
      for (int c = atlas_.face_offsets[f]; c < atlas_.face_offsets[f + 1]; ++c) {
        if (joins_.partners[c] < 0 || !is_torn(c, out.corner_uvs)) continue;
        Lie& lie = lies_[charts_of_.find(f)];
        ++lie.torn;
        lie.met += !spans_[joins_.corner_faces[joins_.partners[c]]];
      }
    }
  }

  /// Whether the sides of a joined edge are apart: noise between them is no tile.
  bool is_torn(int c, const std::vector<Vec2>& uvs) const {
    const int other = joins_.partners[c];
    const int end = joins_.next_corner(atlas_, c), other_end = joins_.next_corner(atlas_, other);
    const auto [from, to] = joins_.alike[c] ? std::pair(other, other_end) : std::pair(other_end, other);
    const auto apart = [&](int a, int b) { return (uvs[a] - uvs[b]).cwiseAbs().maxCoeff() > 0.5; };
    return apart(c, from) || apart(end, to);
  }

  /// Edges that were joined and whose sides differ now; those between two moved faces are met twice.
  void find_torn(int face, UnwrappedTiles& out) const {
    const auto is_moved = [&](int f) { return std::binary_search(out.faces.begin(), out.faces.end(), f); };
    for (int c = atlas_.face_offsets[face]; c < atlas_.face_offsets[face + 1]; ++c) {
      const int other = joins_.partners[c];
      if (other < 0 || (other < c && is_moved(joins_.corner_faces[other]))) continue;
      if (is_torn(c, out.corner_uvs)) out.torn.push_back({c, other});
    }
  }

  const Atlas& atlas_;
  const EdgeJoins& joins_;
  const std::vector<char>& spans_;
  DisjointSets charts_of_;
  std::vector<Lie> lies_;  // at the first face of each chart
};

}  // namespace

UnwrappedTiles unwrap_tiles(const Atlas& atlas, const std::vector<int>& groups, const std::vector<char>& kept) {
  const std::vector<char> spans = spanning(atlas);
  if (std::find(spans.begin(), spans.end(), 1) == spans.end()) return {};
  const EdgeJoins joins = join_edges(atlas, Joining::AsMeant, groups);
  return Unwrapping(atlas, joins, spans).run(kept);
}

}  // namespace atlas_refine
