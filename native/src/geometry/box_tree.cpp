// A tree of bounding boxes over items of the plane.
#include "geometry/box_tree.h"

#include <numeric>

namespace atlas_refine {

namespace {

constexpr int kLeafItems = 4;

}  // namespace

BoxTree::BoxTree(std::vector<Box> boxes, std::vector<int> labels) : boxes_(std::move(boxes)), labels_(std::move(labels)) {
  order_.resize(boxes_.size());
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(boxes_.size() + 1);
  if (!boxes_.empty()) build(0, static_cast<int>(boxes_.size()));
}

int BoxTree::build(int begin, int end) {
  const int index = static_cast<int>(nodes_.size());
  Node node{boxes_[order_[begin]], begin, end, 0, labels_[order_[begin]], labels_[order_[begin]]};
  for (int i = begin + 1; i < end; ++i) {
    const Box& box = boxes_[order_[i]];
    node.box.min = node.box.min.cwiseMin(box.min);
    node.box.max = node.box.max.cwiseMax(box.max);
    node.low_label = std::min(node.low_label, labels_[order_[i]]);
    node.high_label = std::max(node.high_label, labels_[order_[i]]);
  }
  nodes_.push_back(node);
  if (end - begin <= kLeafItems) return index;
  const int axis = node.box.size().x() >= node.box.size().y() ? 0 : 1;
  const int middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int a, int b) {
    const double ca = boxes_[a].min[axis] + boxes_[a].max[axis], cb = boxes_[b].min[axis] + boxes_[b].max[axis];
    return ca != cb ? ca < cb : a < b;
  });
  build(begin, middle);
  nodes_[index].right = build(middle, end);
  return index;
}

}  // namespace atlas_refine
