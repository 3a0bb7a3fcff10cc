// Fold by fold, edge by edge.
#include "input/mirrored_copies.h"

#include "support/disjoint_sets.h"

namespace atlas_refine {
namespace {

class FoldedStacks {
 public:
  FoldedStacks(const ChartSet& set, const std::vector<Follower>& followers)
      : set_(set),
        followers_(set.charts.size(), nullptr),
        fold_(set.charts.size(), -1),
        torn_(set.charts.size(), 0),
        joined_(static_cast<int>(set.charts.size())) {
    for (const Follower& follower : followers) followers_[follower.chart] = &follower;
    for (std::size_t k = 0; k < set.folds.size(); ++k) {
      for (const int chart : set.folds[k].charts) fold_[chart] = static_cast<int>(k);
    }
    find_torn();
    find_joined();
  }

  bool is_copy(const Follower& follower) {
    if (fold_[follower.chart] < 0 || fold_[follower.chart] != fold_[follower.leader]) return true;  // was put there on purpose
    return joined_.find(follower.chart) == joined_.find(follower.leader);
  }

 private:
  int leader(int chart) const { return followers_[chart] ? followers_[chart]->leader : chart; }
  int on_leader(int chart, int vertex) const { return followers_[chart] ? followers_[chart]->vertices[vertex] : vertex; }

  bool meets(const FoldEdge& edge) const {
    for (const auto& [own, others] : edge.ends) {
      if (on_leader(edge.charts[0], own) != on_leader(edge.charts[1], others)) return false;
    }
    return true;
  }

  template <class Body>
  void for_each_edge_of_stacks(Body body) const {
    for (const Fold& fold : set_.folds) {
      for (const FoldEdge& edge : fold.edges) {
        if (leader(edge.charts[0]) == leader(edge.charts[1])) body(edge);
      }
    }
  }

  void find_torn() {
    for_each_edge_of_stacks([&](const FoldEdge& edge) {
      if (meets(edge)) return;
      for (const int chart : edge.charts) torn_[chart] = followers_[chart] != nullptr;
    });
  }

  void find_joined() {
    for_each_edge_of_stacks([&](const FoldEdge& edge) {
      if (!torn_[edge.charts[0]] && !torn_[edge.charts[1]]) joined_.unite(edge.charts[0], edge.charts[1]);
    });
  }

  const ChartSet& set_;
  std::vector<const Follower*> followers_;  // of each chart, nothing where it follows none
  std::vector<int> fold_;                   // that each chart was part of, -1 where none
  std::vector<char> torn_;                  // followers that would part from another chart of their stack
  DisjointSets joined_;                     // charts that come together again
};

}  // namespace

void keep_mirrored_copies(const ChartSet& set, std::vector<Follower>& followers) {
  if (set.folds.empty() || followers.empty()) return;
  FoldedStacks stacks(set, followers);
  std::vector<Follower> kept;
  for (const Follower& follower : followers) {
    if (stacks.is_copy(follower)) kept.push_back(follower);
  }
  followers = std::move(kept);
}

}  // namespace atlas_refine
