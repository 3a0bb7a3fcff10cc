// A tree of bounding boxes over items of the plane: overlap and nearest queries, also where item sizes are very uneven.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

/// Distance between two boxes, 0 where they overlap.
inline double box_distance(const Box& a, const Box& b) {
  const double dx = std::max({0.0, b.min.x() - a.max.x(), a.min.x() - b.max.x()});
  const double dy = std::max({0.0, b.min.y() - a.max.y(), a.min.y() - b.max.y()});
  return std::sqrt(dx * dx + dy * dy);
}

class BoxTree {
 public:
  /// One box and one label for each item. Labels only serve to leave items out of a query.
  BoxTree(std::vector<Box> boxes, std::vector<int> labels);

  /// Calls visit(item) -> bool for the items whose box is within `radius` of `query`, near subtrees first, until it returns
  /// false. `radius` is read anew at every step, so a visit may shrink it. Items labelled `left_out` are skipped, -1 = none.
  template <class Visit>
  void visit_within(const Box& query, const double& radius, int left_out, Visit&& visit) const {
    if (!nodes_.empty()) descend(0, query, radius, left_out, visit);
  }

 private:
  struct Node {
    Box box;
    int begin, end;  ///< range in order_
    int right;       ///< second child, the first one follows its parent; 0 in a leaf
    int low_label, high_label;
  };

  int build(int begin, int end);

  bool reachable(const Node& node, const Box& query, double radius, int left_out) const {
    return !(node.low_label == left_out && node.high_label == left_out) && box_distance(node.box, query) <= radius;
  }

  template <class Visit>
  bool descend(int index, const Box& query, const double& radius, int left_out, Visit& visit) const {
    const Node& node = nodes_[index];
    if (!reachable(node, query, radius, left_out)) return true;
    if (node.right == 0) {
      for (int i = node.begin; i < node.end; ++i) {
        const int item = order_[i];
        if (labels_[item] != left_out && box_distance(boxes_[item], query) <= radius && !visit(item)) return false;
      }
      return true;
    }
    int first = index + 1, second = node.right;
    if (box_distance(nodes_[second].box, query) < box_distance(nodes_[first].box, query)) std::swap(first, second);
    return descend(first, query, radius, left_out, visit) && descend(second, query, radius, left_out, visit);
  }

  std::vector<Box> boxes_;
  std::vector<int> labels_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace atlas_refine
