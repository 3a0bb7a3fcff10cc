// Joining, winding alike, counting what stays a seam.
#include "input/join_edges.h"

#include <algorithm>

#include "input/face_areas.h"
#include "input/keep_corners_apart.h"
#include "input/pair_uses.h"
#include "input/places.h"
#include "input/uv_noise.h"
#include "support/gathered.h"
#include "support/parallel.h"

namespace atlas_refine {

namespace {

std::vector<int> faces_of_corners(const Atlas& atlas) {
  std::vector<int> faces(atlas.corner_count());
  for (int f = 0; f < atlas.face_count(); ++f) {
    std::fill(faces.begin() + atlas.face_offsets[f], faces.begin() + atlas.face_offsets[f + 1], f);
  }
  return faces;
}

std::vector<int> senses_of_faces(const Atlas& atlas) {
  std::vector<int> senses(atlas.face_count());
  for (int f = 0; f < atlas.face_count(); ++f) {
    const double area = doubled_uv_area(atlas, f);
    senses[f] = area > 0 ? 1 : area < 0 ? -1 : 0;
  }
  return senses;
}

/// Goes through the charts face by face and winds each as the one that it is reached from.
class Winding {
 public:
  Winding(const Atlas& atlas, EdgeJoins& joins) : atlas_(atlas), joins_(joins), visited_(atlas.face_count(), false) {}

  void run() {
    for (int seed = 0; seed < atlas_.face_count(); ++seed) {
      if (visited_[seed]) continue;
      visited_[seed] = true;
      queue_.assign(1, seed);
      reached_ = 0;
      later_.clear();
      spread();
      for (std::size_t at = 0; at < later_.size(); ++at) {
        cross_edge(later_[at]);
        spread();
      }
    }
  }

 private:
  /// Across edges with a face on either side, where windings cannot contradict each other.
  void spread() {
    for (; reached_ < queue_.size(); ++reached_) {
      const int face = queue_[reached_];
      for (int c = atlas_.face_offsets[face]; c < atlas_.face_offsets[face + 1]; ++c) {
        if (joins_.partners[c] < 0) continue;
        if (joins_.is_fold(c) || joins_.side(c) * joins_.side(joins_.partners[c]) == 0) {
          later_.push_back(c);
        } else {
          cross_edge(c);
        }
      }
    }
  }

  void cross_edge(int corner) {
    const int partner = joins_.partners[corner];
    if (partner < 0) return;
    const int other = joins_.corner_faces[partner];
    const bool turned = joins_.alike[corner] != joins_.turned_faces[joins_.corner_faces[corner]];
    if (!visited_[other]) {
      visited_[other] = true;
      joins_.turned_faces[other] = turned;
      queue_.push_back(other);
    } else if (joins_.turned_faces[other] != turned) {
      joins_.partners[corner] = joins_.partners[partner] = -1;
    }
  }

  const Atlas& atlas_;
  EdgeJoins& joins_;
  std::vector<bool> visited_;
  std::vector<int> queue_;   // faces
  std::size_t reached_ = 0;  // of them
  std::vector<int> later_;   // corners of edges that are crossed once nothing else is left
};

void count_seam(const Atlas& atlas, EdgeUses uses, EdgeJoins& joins) {
  const auto joined = [&](const EdgeUse& use) { return joins.partners[use.corner] >= 0; };
  const auto open = uses.size() - std::count_if(uses.begin(), uses.end(), joined);
  if (open == 0 || !uses[0].has_length()) return;
  const double length = (atlas.positions[uses[0].low_vertex] - atlas.positions[uses[0].high_vertex]).norm();
  joins.open_length += static_cast<double>(open) * length;
  if (uses.size() < 2) return;
  ++joins.seam_edges;
  joins.seam_length += length;
}

/// Calls body(range) for the uses of one edge by faces of one group, group by group.
template <class Body>
void for_each_group(EdgeUses uses, const std::vector<int>& corner_faces, const std::vector<int>& groups, Body body) {
  if (groups.empty()) return body(uses);
  const auto group = [&](const EdgeUse& use) { return groups[corner_faces[use.corner]]; };
  std::vector<EdgeUse> sorted(uses.begin(), uses.end());
  std::stable_sort(sorted.begin(), sorted.end(), [&](const EdgeUse& a, const EdgeUse& b) { return group(a) < group(b); });
  for_each_range(
      sorted, [&](const EdgeUse& a, const EdgeUse& b) { return group(a) == group(b); }, body);
}

/// Of the faces that edges of two faces hold together in space.
DisjointSets shells_of(const Atlas& atlas, EdgeUses uses, const std::vector<int>& groups, const EdgeJoins& joins) {
  DisjointSets out(atlas.face_count());
  for_each_edge(uses, [&](EdgeUses edge) {
    for_each_group(edge, joins.corner_faces, groups, [&](EdgeUses own) {
      if (own.size() == 2) out.unite(joins.corner_faces[own[0].corner], joins.corner_faces[own[1].corner]);
    });
  });
  return out;
}

/// Side by side on the pool's threads; ambiguous uses last, within one chart, or else within one shell.
void join_pairs(const Atlas& atlas, Joining joining, EdgeUses uses, const std::vector<int>& groups, EdgeJoins& joins) {
  constexpr int kGrain = 8192;  // uses: fewer are not worth a thread
  const double tolerance = joining == Joining::Exact ? 0 : uv_noise(atlas);
  const auto first_of_edge = [&](int at) {
    while (at > 0 && at < static_cast<int>(uses.size()) && uses[at].place_key() == uses[at - 1].place_key()) ++at;
    return at;
  };
  auto ambiguous = gathered<UsePairs::Group>(static_cast<int>(uses.size()), kGrain, [&](int begin, int end, auto& claimed) {
    UsePairs pairs(atlas, tolerance, joins, claimed);
    const int first = first_of_edge(begin);
    for_each_edge(uses.subspan(first, first_of_edge(end) - first), [&](EdgeUses edge) {
      for_each_group(edge, joins.corner_faces, groups, [&](EdgeUses own) { pairs.join(own); });
    });
  });
  if (ambiguous.empty()) return;
  UsePairs pairs(atlas, tolerance, joins, ambiguous);
  DisjointSets charts = joined_faces(atlas, joins), shells = shells_of(atlas, uses, groups, joins);
  pairs.join_within(charts);
  pairs.join_within(shells);
}

}  // namespace

DisjointSets joined_faces(const Atlas& atlas, const EdgeJoins& joins) {
  DisjointSets out(atlas.face_count());
  for (int c = 0; c < atlas.corner_count(); ++c) {
    if (joins.partners[c] > c) out.unite(joins.corner_faces[c], joins.corner_faces[joins.partners[c]]);
  }
  return out;
}

void orient_faces(const Atlas& atlas, EdgeJoins& joins) {
  joins.turned_faces.assign(atlas.face_count(), false);
  // Where all faces are wound as their neighbours, as nearly everywhere, there is nothing to turn and nothing that contradicts.
  if (std::find(joins.alike.begin(), joins.alike.end(), 1) == joins.alike.end()) return;
  Winding(atlas, joins).run();
}

EdgeJoins join_edges(const Atlas& atlas, Joining joining, const std::vector<int>& groups, int threads) {
  EdgeJoins joins;
  side_by_side(threads, {[&] { joins.places = places(atlas); },
                         [&] {
                           joins.corner_faces = faces_of_corners(atlas);
                           joins.partners.assign(atlas.corner_count(), -1);
                           joins.alike.assign(atlas.corner_count(), false);
                           joins.senses = senses_of_faces(atlas);
                         }});
  const std::vector<EdgeUse> uses = edge_uses(atlas, joins.places, threads);
  join_pairs(atlas, joining, uses, groups, joins);
  orient_faces(atlas, joins);
  keep_corners_apart(atlas, joins);
  for_each_edge(uses, [&](EdgeUses edge) { count_seam(atlas, edge, joins); });
  return joins;
}

}  // namespace atlas_refine
