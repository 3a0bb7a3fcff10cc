// A tree of bounding boxes over items of the plane: overlap and nearest queries, also where item sizes are very uneven.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/chart.h"

namespace atlas_refine {

/// The closed boxes have a point in common.
inline bool overlap(const Box& a, const Box& b) {
  // Without branches: in the searches each of the four is as likely to hold as not.
  return (a.min.x() <= b.max.x()) & (b.min.x() <= a.max.x()) & (a.min.y() <= b.max.y()) & (b.min.y() <= a.max.y());
}

/// The smallest box that holds both.
inline Box united(const Box& a, const Box& b) { return {a.min.cwiseMin(b.min), a.max.cwiseMax(b.max)}; }

inline Box box_of(const Chart& chart, const Triangle& t) {
  const Vec2 &a = chart.uvs[t[0]], &b = chart.uvs[t[1]], &c = chart.uvs[t[2]];
  return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
}

/// Distance between two boxes, 0 where they overlap.
inline double box_distance(const Box& a, const Box& b) {
  const double dx = std::max({0.0, b.min.x() - a.max.x(), a.min.x() - b.max.x()});
  const double dy = std::max({0.0, b.min.y() - a.max.y(), a.min.y() - b.max.y()});
  return std::sqrt(dx * dx + dy * dy);
}

/// Quick to build where items that follow each other lie near each other, as the edges of a boundary do: runs of such items
/// share a leaf, and only leaves are sorted in space.
class BoxTree {
 public:
  /// Items [begin, end), of one label.
  struct Leaf {
    Box box;
    int begin, end;
    int label;
  };

  /// One box and one label for each item. Labels serve to leave items out of a query; leaves hold one label each.
  BoxTree(std::vector<Box> boxes, const std::vector<int>& labels);

  const Box& box(int item) const { return boxes_[item]; }
  /// In the order of their items, which they hold without gaps.
  const std::vector<Leaf>& leaves() const { return leaves_; }

  /// Calls visit(item) -> bool for the items whose box is within `radius` of `query`, near subtrees first, until it returns
  /// false. `radius` is read anew at every step, so a visit may shrink it. Items labelled `left_out` are skipped, -1 = none.
  template <class Visit>
  void visit_within(const Box& query, const double& radius, int left_out, Visit&& visit) const {
    if (!nodes_.empty()) descend(0, query, radius, left_out, visit);
  }

  /// Calls visit(leaf) for the leaves whose box overlaps the query, in any order.
  template <class Visit>
  void visit_leaves(const Box& query, Visit&& visit) const {
    if (!nodes_.empty()) descend_to_leaves(0, query, visit);
  }

 private:
  struct Node {
    Box box;
    int begin, end;  ///< range in sorted_
    int right;       ///< second child, the first one follows its parent; 0 for a node without children
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
      for (int k = node.begin; k < node.end; ++k) {
        const Leaf& leaf = sorted_[k];
        if (leaf.label == left_out || box_distance(leaf.box, query) > radius) continue;
        for (int item = leaf.begin; item < leaf.end; ++item) {
          if (box_distance(boxes_[item], query) <= radius && !visit(item)) return false;
        }
      }
      return true;
    }
    int first = index + 1, second = node.right;
    if (box_distance(nodes_[second].box, query) < box_distance(nodes_[first].box, query)) std::swap(first, second);
    return descend(first, query, radius, left_out, visit) && descend(second, query, radius, left_out, visit);
  }

  template <class Visit>
  void descend_to_leaves(int index, const Box& query, Visit& visit) const {
    const Node& node = nodes_[index];
    if (!overlap(node.box, query)) return;
    if (node.right == 0) {
      for (int k = node.begin; k < node.end; ++k) {
        if (overlap(sorted_[k].box, query)) visit(sorted_[k]);
      }
      return;
    }
    descend_to_leaves(index + 1, query, visit);
    descend_to_leaves(node.right, query, visit);
  }

  std::vector<Box> boxes_;
  std::vector<Leaf> leaves_;
  std::vector<Leaf> sorted_;  ///< the same, in space
  std::vector<Node> nodes_;
};

}  // namespace atlas_refine
