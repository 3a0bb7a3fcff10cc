// Leaves along the order of the items, halved in space above them.
#include "geometry/box_tree.h"

namespace atlas_refine {

namespace {

constexpr int kLeafItems = 16;
constexpr int kNodeLeaves = 4;

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
  sorted_ = leaves_;
  nodes_.reserve(leaves_.size() + 1);
  if (!leaves_.empty()) build(0, static_cast<int>(leaves_.size()));
}

int BoxTree::build(int begin, int end) {
  const int index = static_cast<int>(nodes_.size());
  Node node{sorted_[begin].box, begin, end, 0, sorted_[begin].label, sorted_[begin].label};
  for (int k = begin + 1; k < end; ++k) {
    node.box = united(node.box, sorted_[k].box);
    node.low_label = std::min(node.low_label, sorted_[k].label);
    node.high_label = std::max(node.high_label, sorted_[k].label);
  }
  nodes_.push_back(node);
  if (end - begin <= kNodeLeaves) return index;
  const int axis = node.box.size().x() >= node.box.size().y() ? 0 : 1;
  const int middle = begin + (end - begin) / 2;
  std::nth_element(sorted_.begin() + begin, sorted_.begin() + middle, sorted_.begin() + end, [&](const Leaf& a, const Leaf& b) {
    const double ca = a.box.min[axis] + a.box.max[axis], cb = b.box.min[axis] + b.box.max[axis];
    return ca != cb ? ca < cb : a.begin < b.begin;
  });
  build(begin, middle);
  nodes_[index].right = build(middle, end);
  return index;
}

}  // namespace atlas_refine
