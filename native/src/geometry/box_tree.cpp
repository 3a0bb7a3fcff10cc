// Leaves along the order of the items, halved in space above them.
#include "geometry/box_tree.h"

#include <numeric>

namespace atlas_refine {

namespace {

constexpr int kLeafItems = 16;

}  // namespace

BoxTree::BoxTree(std::vector<Box> boxes, const std::vector<int>& labels) : boxes_(std::move(boxes)) {
  const int count = static_cast<int>(boxes_.size());
  leaves_.reserve(2 * count / kLeafItems + 1);
  for (int begin = 0, end = 0; begin < count; begin = end) {
    Box box = boxes_[begin];
    for (end = begin + 1; end < count && end - begin < kLeafItems && labels[end] == labels[begin]; ++end) {
      box = united(box, boxes_[end]);
    }
    leaves_.push_back({box, begin, end, labels[begin]});
  }
  std::vector<int> order(leaves_.size());
  std::iota(order.begin(), order.end(), 0);
  nodes_.reserve(2 * leaves_.size());
  if (!leaves_.empty()) build(order, 0, static_cast<int>(leaves_.size()));
}

int BoxTree::build(std::vector<int>& order, int begin, int end) {
  const int index = static_cast<int>(nodes_.size());
  const Leaf& first = leaves_[order[begin]];
  Node node{first.box, end - begin == 1 ? order[begin] : -1, 0, first.label, first.label};
  for (int i = begin + 1; i < end; ++i) {
    const Leaf& leaf = leaves_[order[i]];
    node.box = united(node.box, leaf.box);
    node.low_label = std::min(node.low_label, leaf.label);
    node.high_label = std::max(node.high_label, leaf.label);
  }
  nodes_.push_back(node);
  if (node.leaf >= 0) return index;
  const int axis = node.box.size().x() >= node.box.size().y() ? 0 : 1;
  const int middle = begin + (end - begin) / 2;
  std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end, [&](int a, int b) {
    const Box &p = leaves_[a].box, &q = leaves_[b].box;
    const double ca = p.min[axis] + p.max[axis], cb = q.min[axis] + q.max[axis];
    return ca != cb ? ca < cb : a < b;
  });
  build(order, begin, middle);
  nodes_[index].right = build(order, middle, end);
  return index;
}

}  // namespace atlas_refine
