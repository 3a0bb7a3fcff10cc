// The tree finds what a plain loop finds.
#include "geometry/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/rng.h"

namespace atlas_refine {
namespace {

struct Items {
  std::vector<Box> boxes;
  std::vector<int> labels;
};

Items random_items(int count) {
  Items items;
  Rng rng(7);
  for (int i = 0; i < count; ++i) {
    const double size = i % 10 == 0 ? 0.3 : 0.01;  // uneven on purpose
    const Vec2 low(rng.uniform(), rng.uniform());
    items.boxes.push_back({low, low + Vec2(size * rng.uniform(), size * rng.uniform())});
    items.labels.push_back(rng.below(5));
  }
  return items;
}

TEST(BoxTree, FindsAllWithinARadius) {
  const Items items = random_items(500);
  const BoxTree tree(items.boxes, items.labels);
  for (const double radius : {0.0, 0.05}) {
    for (int i = 0; i < 50; ++i) {
      std::vector<int> found, expected;
      tree.visit_within(items.boxes[i], radius, items.labels[i], [&](int item) {
        found.push_back(item);
        return true;
      });
      for (int j = 0; j < 500; ++j) {
        if (items.labels[j] != items.labels[i] && box_distance(items.boxes[i], items.boxes[j]) <= radius) expected.push_back(j);
      }
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(BoxTree, AShrinkingRadiusFindsTheNearest) {
  const Items items = random_items(500);
  const BoxTree tree(items.boxes, items.labels);
  for (int i = 0; i < 50; ++i) {
    double best = std::numeric_limits<double>::infinity(), expected = best;
    tree.visit_within(items.boxes[i], best, items.labels[i], [&](int item) {
      best = std::min(best, box_distance(items.boxes[i], items.boxes[item]));
      return true;
    });
    for (int j = 0; j < 500; ++j) {
      if (items.labels[j] != items.labels[i]) expected = std::min(expected, box_distance(items.boxes[i], items.boxes[j]));
    }
    EXPECT_EQ(best, expected);
  }
}

TEST(BoxTree, LeavesHoldTheItemsInOrderAndOneLabelEach) {
  const Items items = random_items(500);
  const BoxTree tree(items.boxes, items.labels);
  int next = 0;
  for (const BoxTree::Leaf& leaf : tree.leaves()) {
    EXPECT_EQ(leaf.begin, next);
    ASSERT_LT(leaf.begin, leaf.end);
    for (int item = leaf.begin; item < leaf.end; ++item) {
      EXPECT_EQ(items.labels[item], leaf.label);
      EXPECT_EQ(united(leaf.box, items.boxes[item]).size(), leaf.box.size());
    }
    next = leaf.end;
  }
  EXPECT_EQ(next, 500);
}

TEST(BoxTree, LeavesThatOverlapAreFound) {
  Items items = random_items(500);
  std::sort(items.labels.begin(), items.labels.end());  // long runs, so that leaves are full
  const BoxTree tree(items.boxes, items.labels);
  EXPECT_LT(tree.leaves().size(), 50u);
  for (int i = 0; i < 50; ++i) {
    std::vector<int> found, expected;
    tree.visit_leaves(items.boxes[i], [&](const BoxTree::Leaf& leaf) { found.push_back(leaf.begin); });
    for (const BoxTree::Leaf& leaf : tree.leaves()) {
      if (overlap(leaf.box, items.boxes[i])) expected.push_back(leaf.begin);
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

TEST(BoxTree, NothingInNothing) {
  const BoxTree tree({}, {});
  tree.visit_within({}, 1.0, -1, [](int) {
    ADD_FAILURE();
    return true;
  });
  tree.visit_leaves({}, [](const BoxTree::Leaf&) { ADD_FAILURE(); });
}

}  // namespace
}  // namespace atlas_refine
