// Pairing the uses of one edge in space.
#pragma once

#include <vector>

#include "input/join_edges.h"
#include "support/disjoint_sets.h"

namespace atlas_refine {

/// Joins uses of one edge after the other; edges may be dealt out to several of these.
class UsePairs {
 public:
  using Group = std::vector<EdgeUse>;

  /// `tolerance`: of UVs, 0 where they must be equal. `ambiguous` gets what more than two sheets claim.
  UsePairs(const Atlas& atlas, double tolerance, EdgeJoins& joins, std::vector<Group>& ambiguous)
      : atlas_(atlas), joins_(joins), tolerance_(tolerance), ambiguous_(ambiguous) {}

  /// All uses of one edge in space.
  void join(EdgeUses uses);
  /// Once all edges have been joined: the ambiguous ones, where one pair of the uses belongs to one of these parts.
  void join_within(DisjointSets& parts);

 private:
  /// Two uses of a group that may be joined, the better the smaller the key.
  struct Candidate {
    bool other_sense;  // wound the other way round in the UV plane: the back of a sheet
    bool other_vertices;
    int layers_apart;
    double distance;
    std::size_t a, b;
    bool crosswise;
    auto key() const { return std::tie(other_sense, other_vertices, layers_apart, distance, a, b); }
  };

  Group unjoined(EdgeUses uses) const;
  void sort_by_uvs(Group& group) const;
  void join_exact(Group group);
  void join_equal(EdgeUses uses);
  void join_sheets(const Group& left, const Group& right);
  void join_near(Group group);
  std::vector<Candidate> near_pairs(const Group& group) const;
  std::vector<int> layers(const Group& group) const;
  void unite(const EdgeUse& a, const EdgeUse& b, bool crosswise = false);

  bool opposite(const EdgeUse& a, const EdgeUse& b) const;
  int left_or_right(const EdgeUse& use) const;
  bool same_corners(const EdgeUse& a, const EdgeUse& b) const;
  bool is_bridge(const EdgeUse& a, const EdgeUse& b) const;
  bool all_doubles(const Group& group) const;

  const Atlas& atlas_;
  EdgeJoins& joins_;
  double tolerance_;
  std::vector<Group>& ambiguous_;
};

}  // namespace atlas_refine
