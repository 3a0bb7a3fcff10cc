// The fewest nodes that part two sides are as many as there are paths from one to the other that share no node (Menger 1927): a
// maximum flow (Dinic 1970) in which each node has two ends, in and out, with room for one path between them.
#include "solve/vertex_cut.h"

#include <array>
#include <limits>

namespace atlas_refine {
namespace {

constexpr int kNone = -1, kOutside = -2;
constexpr int kExhausted = std::numeric_limits<int>::max();

// A place is an end of a node.
int in(int node) { return 2 * node; }
int out(int node) { return 2 * node + 1; }
int node_of(int place) { return place / 2; }
bool is_in(int place) { return place % 2 == 0; }

/// The nodes in the middle, and paths through them from what lies left to what lies right of it.
class Middle {
 public:
  Middle(const Adjacency& graph, const std::vector<GraphSide>& sides);

  /// As many paths as there are.
  void fill_with_paths() {
    while (find_levels()) extend_paths();
  }
  /// After that: of the two smallest cuts, next to what the left still leads to and next to what still leads to the right, the
  /// one that leaves sides of about one size.
  void assign_sides(std::vector<GraphSide>& sides) const;

 private:
  int count() const { return part_.graph.size(); }
  bool is_used(int node) const { return next_[node] != kNone; }
  int ways(int place) const {
    return is_in(place) ? 1 : 2 + part_.graph.start[node_of(place) + 1] - part_.graph.start[node_of(place)];
  }
  int step(int place, int way) const;
  bool find_levels();
  void extend_paths();
  void extend_path(std::vector<int> places);
  void take(const std::vector<int>& places);
  std::vector<char> leading_right() const;

  const Subgraph part_;
  std::vector<char> at_left_, at_right_;
  std::vector<int> previous_, next_;  // on the path through each node; kOutside at its ends
  std::vector<int> level_;            // of each place: steps from the left
  std::vector<int> tried_;            // of each place: ways
};

std::vector<int> nodes_on(const std::vector<GraphSide>& sides, GraphSide side) {
  std::vector<int> nodes;
  for (std::size_t v = 0; v < sides.size(); ++v) {
    if (sides[v] == side) nodes.push_back(static_cast<int>(v));
  }
  return nodes;
}

Middle::Middle(const Adjacency& graph, const std::vector<GraphSide>& sides)
    : part_(subgraph(graph, nodes_on(sides, GraphSide::Middle))),
      at_left_(part_.nodes.size(), 0),
      at_right_(part_.nodes.size(), 0),
      previous_(part_.nodes.size(), kNone),
      next_(part_.nodes.size(), kNone) {
  for (std::size_t k = 0; k < part_.nodes.size(); ++k) {
    for (int e = graph.start[part_.nodes[k]]; e < graph.start[part_.nodes[k] + 1]; ++e) {
      const GraphSide side = sides[graph.nodes[e]];
      if (side == GraphSide::Left) at_left_[k] = 1;
      if (side == GraphSide::Right) at_right_[k] = 1;
    }
  }
}

/// Where a way from a place leads: kOutside to the right, kNone where it cannot be taken. A way against a path takes that back:
/// the path will go on elsewhere.
int Middle::step(int place, int way) const {
  const int node = node_of(place);
  if (is_in(place)) {
    if (!is_used(node)) return out(node);
    return previous_[node] == kOutside ? kNone : out(previous_[node]);
  }
  if (way == 0) return at_right_[node] ? kOutside : kNone;
  if (way == 1) return is_used(node) ? in(node) : kNone;
  const int other = part_.graph.nodes[part_.graph.start[node] + way - 2];
  return other == next_[node] ? kNone : in(other);
}

/// False where no way is left to the right; then every place that can still be reached has a level.
bool Middle::find_levels() {
  level_.assign(2 * part_.nodes.size(), kNone);
  std::vector<int> reached;
  const auto reach = [&](int place, int level) {
    if (level_[place] != kNone) return;
    level_[place] = level;
    reached.push_back(place);
  };
  for (int node = 0; node < count(); ++node) {
    if (at_left_[node]) reach(in(node), 0);
  }
  bool found = false;
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const int place = reached[k], count = ways(place);
    for (int way = 0; way < count; ++way) {
      const int to = step(place, way);
      found = found || to == kOutside;
      if (to >= 0) reach(to, level_[place] + 1);
    }
  }
  return found;
}

void Middle::extend_paths() {
  tried_.assign(2 * part_.nodes.size(), 0);
  for (int node = 0; node < count(); ++node) {
    if (at_left_[node]) extend_path({in(node)});
  }
}

/// One more path, from level to level, where there is one.
void Middle::extend_path(std::vector<int> places) {
  while (!places.empty()) {
    const int place = places.back(), count = ways(place);
    int to = kNone;
    for (; tried_[place] < count; ++tried_[place]) {
      to = step(place, tried_[place]);
      if (to == kOutside || (to >= 0 && level_[to] == level_[place] + 1)) break;
    }
    if (tried_[place] >= count) {
      places.pop_back();
      if (!places.empty()) ++tried_[places.back()];
    } else if (to == kOutside) {
      take(places);
      return;
    } else {
      places.push_back(to);
    }
  }
}

void Middle::take(const std::vector<int>& places) {
  std::vector<std::array<int, 2>> joined, parted;
  for (std::size_t k = 0; k + 1 < places.size(); ++k) {
    const int from = node_of(places[k]), to = node_of(places[k + 1]);
    if (from == to) continue;
    if (is_in(places[k])) parted.push_back({to, from});
    if (!is_in(places[k])) joined.push_back({from, to});
  }
  for (const auto& [from, to] : parted) next_[from] = previous_[to] = kNone;
  for (const auto& [from, to] : joined) {
    next_[from] = to;
    previous_[to] = from;
  }
  previous_[node_of(places.front())] = next_[node_of(places.back())] = kOutside;
  for (const int place : places) tried_[place] = kExhausted;  // each has room for one path
}

/// Of each place whether the right can still be reached from it.
std::vector<char> Middle::leading_right() const {
  std::vector<char> leads(2 * part_.nodes.size(), 0);
  std::vector<int> reached;
  const auto reach = [&](int place) {
    if (!leads[place]) reached.push_back(place);
    leads[place] = 1;
  };
  for (int node = 0; node < count(); ++node) {
    if (at_right_[node]) reach(out(node));
  }
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const int node = node_of(reached[k]);
    if (!is_in(reached[k])) {
      if (!is_used(node)) reach(in(node));
      if (next_[node] >= 0) reach(in(next_[node]));
      continue;
    }
    if (is_used(node)) reach(out(node));
    for (int e = part_.graph.start[node]; e < part_.graph.start[node + 1]; ++e) {
      if (next_[part_.graph.nodes[e]] != node) reach(out(part_.graph.nodes[e]));
    }
  }
  return leads;
}

void Middle::assign_sides(std::vector<GraphSide>& sides) const {
  const std::vector<char> leads = leading_right();
  const auto reached = [&](int place) { return level_[place] != kNone; };
  int left = 0, right = 0;
  for (int node = 0; node < count(); ++node) {
    left += reached(out(node));
    right += leads[in(node)];
  }
  for (int node = 0; node < count(); ++node) {
    GraphSide& side = sides[part_.nodes[node]];
    if (left >= right)
      side = reached(out(node)) ? GraphSide::Left : reached(in(node)) ? GraphSide::Middle : GraphSide::Right;
    else
      side = leads[in(node)] ? GraphSide::Right : leads[out(node)] ? GraphSide::Middle : GraphSide::Left;
  }
}

}  // namespace

void narrow_to_cut(const Adjacency& graph, std::vector<GraphSide>& sides) {
  Middle middle(graph, sides);
  middle.fill_with_paths();
  middle.assign_sides(sides);
}

}  // namespace atlas_refine
