// Which faces of an edge belong together: exact partners, then the nearest; by the sides of the UV edge that they lie on.
#include "input/pair_uses.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>

#include "geometry/triangulate_polygon.h"
#include "input/uv_noise.h"

namespace atlas_refine {

namespace {

// What bounds the work at an edge of very many faces.
constexpr std::size_t kCompared = 16;    // uses next in the order of their UVs that each is compared with
constexpr std::size_t kMostSheets = 64;  // more of them are not told apart

/// How far two uses are apart in the UV plane; crosswise: the low end of one lies at the high end of the other.
struct Meeting {
  double distance;
  bool crosswise;
};

Meeting meeting_of(const Atlas& atlas, const EdgeUse& a, const EdgeUse& b) {
  const auto uv = [&](int corner) -> const Vec2& { return atlas.corner_uvs[corner]; };
  const auto apart = [&](int b_low, int b_high) {
    return std::max((uv(a.low_corner) - uv(b_low)).norm(), (uv(a.high_corner) - uv(b_high)).norm());
  };
  const double along = apart(b.low_corner, b.high_corner);
  if (a.has_length()) return {along, false};
  const double across = apart(b.high_corner, b.low_corner);  // UVs that differ by noise may be sorted differently
  return across < along ? Meeting{across, true} : Meeting{along, false};
}

double uv_length(const Atlas& atlas, const EdgeUse& use) {
  return (atlas.corner_uvs[use.low_corner] - atlas.corner_uvs[use.high_corner]).norm();
}

}  // namespace

void UsePairs::join(EdgeUses uses) {
  if (uses.size() < 2) return;
  if (uses.size() == 2) {
    const EdgeUse &a = uses[0], &b = uses[1];
    // Nearly all edges have two uses that agree: those need no order.
    if (a.vertex_key() == b.vertex_key() && a.uv_key(atlas_) == b.uv_key(atlas_)) join_equal(uses);
    if (joins_.partners[a.corner] >= 0) return;
  }
  for_each_range(
      uses, [](const EdgeUse& a, const EdgeUse& b) { return a.vertex_key() == b.vertex_key(); },
      [&](EdgeUses range) {
        join_exact({range.begin(), range.end()});
      });
  Group rest = unjoined(uses);
  if (rest.size() < 2) return;
  join_exact(rest);
  if (tolerance_ > 0) join_near(unjoined(rest));
}

UsePairs::Group UsePairs::unjoined(EdgeUses uses) const {
  Group out;
  std::copy_if(uses.begin(), uses.end(), std::back_inserter(out),
               [&](const EdgeUse& u) { return joins_.partners[u.corner] < 0; });
  return out;
}

void UsePairs::unite(const EdgeUse& a, const EdgeUse& b, bool crosswise) {
  joins_.partners[a.corner] = b.corner;
  joins_.partners[b.corner] = a.corner;
  joins_.alike[a.corner] = joins_.alike[b.corner] = (a.runs_up() == b.runs_up()) != crosswise;
}

/// The side of the UV edge, seen from its low end, on which the face lies: 1 left, -1 right, 0 without area.
int UsePairs::left_or_right(const EdgeUse& use) const {
  return use.runs_up() ? joins_.side(use.corner) : -joins_.side(use.corner);
}

bool UsePairs::opposite(const EdgeUse& a, const EdgeUse& b) const { return left_or_right(a) * left_or_right(b) < 0; }

/// Whether the faces of two uses have the same corners in space.
bool UsePairs::same_corners(const EdgeUse& a, const EdgeUse& b) const {
  const auto corners = [&](const EdgeUse& use) {
    const int face = joins_.corner_faces[use.corner];
    std::vector<int> out;
    for (int c = atlas_.face_offsets[face]; c < atlas_.face_offsets[face + 1]; ++c)
      out.push_back(joins_.places[atlas_.corner_vertices[c]]);
    std::sort(out.begin(), out.end());
    return out;
  };
  return corners(a) == corners(b);
}

/// Whether a face runs along the edge to and fro, as polygons do that reach their holes that way, and lies on both sides of it.
bool UsePairs::is_bridge(const EdgeUse& a, const EdgeUse& b) const {
  if (a.vertex_key() != b.vertex_key() || a.runs_up() == b.runs_up()) return false;
  const int face = joins_.corner_faces[a.corner];
  std::vector<Vec2> uvs;
  std::vector<Vec3> positions;
  for (int c = atlas_.face_offsets[face]; c < atlas_.face_offsets[face + 1]; ++c) {
    uvs.push_back(atlas_.corner_uvs[c]);
    positions.push_back(atlas_.positions[atlas_.corner_vertices[c]]);
  }
  if (joins_.side(a.corner) < 0) {
    std::reverse(uvs.begin(), uvs.end());
    std::reverse(positions.begin(), positions.end());
  }
  return triangulate_polygon(uvs, positions).has_value();
}

bool UsePairs::all_doubles(const Group& group) const {
  return std::all_of(group.begin() + 1, group.end(), [&](const EdgeUse& use) { return same_corners(group.front(), use); });
}

void UsePairs::sort_by_uvs(Group& group) const {
  std::sort(group.begin(), group.end(), [&](const EdgeUse& a, const EdgeUse& b) {
    const auto ka = a.uv_key(atlas_), kb = b.uv_key(atlas_);
    return ka != kb ? ka < kb : a.corner < b.corner;
  });
}

void UsePairs::join_exact(Group group) {
  if (group.size() < 2) return;
  sort_by_uvs(group);
  for_each_range(
      group, [&](const EdgeUse& a, const EdgeUse& b) { return a.uv_key(atlas_) == b.uv_key(atlas_); },
      [&](EdgeUses range) { join_equal(range); });
}

/// Joins uses that have the same UVs, in the order of their corners.
void UsePairs::join_equal(EdgeUses uses) {
  if (uses.size() < 2) return;
  if (uses.size() == 2) {
    const EdgeUse &a = uses[0], &b = uses[1];
    const bool one_face = joins_.corner_faces[a.corner] == joins_.corner_faces[b.corner];
    if (one_face ? is_bridge(a, b) : opposite(a, b) || !same_corners(a, b)) unite(a, b);
    return;
  }
  for (const int sense : {1, -1}) {
    Group left, right;
    for (const EdgeUse& use : uses) {
      if (joins_.side(use.corner) == sense) (left_or_right(use) > 0 ? left : right).push_back(use);
    }
    join_sheets(left, right);
  }
  const Group rest = unjoined(uses);
  if (rest.size() == 2 && left_or_right(rest[0]) * left_or_right(rest[1]) <= 0) join_equal(rest);
}

/// Joins faces that lie on the two sides of an edge: the first with the first where each side has but doubles of one face.
void UsePairs::join_sheets(const Group& left, const Group& right) {
  if (left.empty() || right.empty()) return;
  if (all_doubles(left) && all_doubles(right)) {
    for (std::size_t k = 0; k < std::min(left.size(), right.size()); ++k) unite(left[k], right[k]);
    return;
  }
  Group& both = ambiguous_.emplace_back(left);
  both.insert(both.end(), right.begin(), right.end());
}

/// Those that are the only ones of their part at their edge, one on either side.
void UsePairs::join_within(DisjointSets& parts) {
  const auto part = [&](const EdgeUse& use) { return parts.find(joins_.corner_faces[use.corner]); };
  for (const Group& group : ambiguous_) {
    const Group open = unjoined(group);
    if (open.size() > kMostSheets) continue;
    const auto only_other = [&](const EdgeUse& use) {
      const EdgeUse* found = nullptr;
      for (const EdgeUse& other : open) {
        if (!opposite(use, other) || part(use) != part(other)) continue;
        if (found) return static_cast<const EdgeUse*>(nullptr);
        found = &other;
      }
      return found;
    };
    for (const EdgeUse& use : open) {
      const EdgeUse* other = only_other(use);
      if (other && other->corner > use.corner && only_other(*other) == &use) unite(use, *other);
    }
  }
}

/// Of each use how many before it in the file are of doubles of its face, wound alike in the UV plane: the sheet that it is in.
std::vector<int> UsePairs::layers(const Group& group) const {
  std::vector<int> out(group.size(), 0);
  if (group.size() == 2 || group.size() > kMostSheets) return out;
  for (std::size_t a = 0; a < group.size(); ++a) {
    for (const EdgeUse& other : group) {
      const bool before = other.corner < group[a].corner && joins_.side(other.corner) == joins_.side(group[a].corner);
      if (before && same_corners(other, group[a])) ++out[a];
    }
  }
  return out;
}

/// Pairs of uses that differ by noise; faces on one side of their edge only where there are no others.
std::vector<UsePairs::Candidate> UsePairs::near_pairs(const Group& group) const {
  std::vector<Candidate> out;
  const std::vector<int> layer = layers(group);
  for (std::size_t a = 0; a < group.size(); ++a) {
    for (std::size_t b = a + 1; b < std::min(group.size(), a + 1 + kCompared); ++b) {
      if (joins_.corner_faces[group[a].corner] == joins_.corner_faces[group[b].corner]) continue;
      const auto [distance, crosswise] = meeting_of(atlas_, group[a], group[b]);
      const double shorter = std::min(uv_length(atlas_, group[a]), uv_length(atlas_, group[b]));
      if (distance == 0 || distance > std::min(tolerance_, kNoiseOfEdge * shorter)) continue;
      const int sides = left_or_right(group[a]) * left_or_right(group[b]) * (crosswise ? -1 : 1);
      const bool alone = group.size() == 2 && (sides == 0 || !same_corners(group[a], group[b]));
      if (sides >= 0 && !alone) continue;
      out.push_back({.other_sense = joins_.side(group[a].corner) * joins_.side(group[b].corner) < 0,
                     .other_vertices = group[a].vertex_key() != group[b].vertex_key(),
                     .layers_apart = std::abs(layer[a] - layer[b]),
                     .distance = distance,
                     .a = a,
                     .b = b,
                     .crosswise = crosswise});
    }
  }
  return out;
}

/// Joins the nearest first.
void UsePairs::join_near(Group group) {
  sort_by_uvs(group);
  std::vector<Candidate> candidates = near_pairs(group);
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.key() < b.key(); });
  for (const Candidate& c : candidates) {
    const EdgeUse &a = group[c.a], &b = group[c.b];
    if (joins_.partners[a.corner] < 0 && joins_.partners[b.corner] < 0) unite(a, b, c.crosswise);
  }
}

}  // namespace atlas_refine
