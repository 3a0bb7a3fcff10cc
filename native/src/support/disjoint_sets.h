// Sets that are united and never parted again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace atlas_refine {

/// The smallest member stands for its set.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0); }

  int find(int member) {
    while (parents_[member] != member) member = parents_[member] = parents_[parents_[member]];
    return member;
  }
  void unite(int a, int b) {
    a = find(a);
    b = find(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parents_;
};

}  // namespace atlas_refine
