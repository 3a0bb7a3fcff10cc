// Leaves of a tree over the edges against each other; what is near by later is found among what was a little farther off.
#include "geometry/near_pairs.h"

#include <algorithm>
#include <cmath>

#include "geometry/box_tree.h"
#include "support/gathered.h"

namespace atlas_refine {
namespace {

/// The boxes that the boundary vertices sweep.
std::vector<Box> swept_points(const Boundary& boundary, const std::vector<Vec2>& positions,
                              const std::vector<Vec2>& displacements) {
  std::vector<Box> points;
  points.reserve(boundary.size());
  for (int v : boundary.vertex) {
    const Vec2& from = positions[v];
    const Vec2 to = displacements.empty() ? from : Vec2(from + displacements[v]);
    points.push_back({from.cwiseMin(to), from.cwiseMax(to)});
  }
  return points;
}

BoxTree tree_of_edges(const Boundary& boundary, const std::vector<Box>& points) {
  std::vector<Box> edges;
  edges.reserve(boundary.size());
  for (int e = 0; e < boundary.size(); ++e) edges.push_back(united(points[e], points[boundary.next[e]]));
  return {std::move(edges), boundary.loop};
}

Box grown(const Box& box, double radius) { return {box.min.array() - radius, box.max.array() + radius}; }

/// All pairs whose point is of the leaf; `near` is scratch memory.
void add_pairs_of(const BoxTree::Leaf& leaf, const Boundary& boundary, const std::vector<Box>& points, const BoxTree& tree,
                  double radius, std::vector<BoxTree::Leaf>& near, std::vector<PointEdge>& pairs) {
  Box reach = points[leaf.begin];
  for (int i = leaf.begin + 1; i < leaf.end; ++i) reach = united(reach, points[i]);
  near.clear();
  tree.visit_leaves(grown(reach, radius), [&](const BoxTree::Leaf& other) {
    if (other.label == leaf.label || boundary.chart[other.begin] != boundary.chart[leaf.begin]) near.push_back(other);
  });
  std::sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  for (int i = leaf.begin; i < leaf.end; ++i) {
    const Box around = grown(points[i], radius);
    const int before = boundary.previous[i];
    for (const BoxTree::Leaf& other : near) {
      if (!overlap(other.box, around)) continue;
      for (int e = other.begin; e < other.end; ++e) {
        if (overlap(around, tree.box(e)) && e != i && e != before) pairs.push_back({i, e});
      }
    }
  }
}

std::vector<PointEdge> pairs_of_boxes(const Boundary& boundary, const std::vector<Box>& points, double radius) {
  constexpr int kGrain = 16;  // leaves
  const BoxTree tree = tree_of_edges(boundary, points);
  const std::vector<BoxTree::Leaf>& leaves = tree.leaves();
  return gathered<PointEdge>(static_cast<int>(leaves.size()), kGrain, [&](int begin, int end, auto& pairs) {
    std::vector<BoxTree::Leaf> near;
    for (int k = begin; k < end; ++k) add_pairs_of(leaves[k], boundary, points, tree, radius, near, pairs);
  });
}

/// How far along an axis boxes reach beyond others.
double overhang(const std::vector<Box>& boxes, const std::vector<Box>& others) {
  double most = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    most = std::max({most, (others[i].min - boxes[i].min).maxCoeff(), (boxes[i].max - others[i].max).maxCoeff()});
  }
  return most;
}

}  // namespace

std::vector<PointEdge> near_pairs(const Boundary& boundary, const std::vector<Vec2>& positions,
                                  const std::vector<Vec2>& displacements, double radius) {
  return pairs_of_boxes(boundary, swept_points(boundary, positions, displacements), radius);
}

std::vector<PointEdge> NearPairs::find(const Boundary& boundary, const std::vector<Vec2>& positions,
                                       const std::vector<Vec2>& displacements, double radius) {
  constexpr double kFarther = 1.5, kRounding = 1e-9;
  constexpr int kGrain = 8192;  // pairs
  const std::vector<Box> points = swept_points(boundary, positions, displacements);
  largest_radius_ = std::max(largest_radius_, radius);
  if (reach_ < 0 || radius + (2 + kRounding) * overhang(points, swept_) > reach_) {
    reach_ = kFarther * largest_radius_;
    known_ = pairs_of_boxes(boundary, points, reach_);
    swept_ = points;
  }
  return gathered<PointEdge>(static_cast<int>(known_.size()), kGrain, [&](int begin, int end, auto& pairs) {
    for (int k = begin; k < end; ++k) {
      const Box edge = united(points[known_[k].edge], points[boundary.next[known_[k].edge]]);
      if (overlap(grown(points[known_[k].point], radius), edge)) pairs.push_back(known_[k]);
    }
  });
}

}  // namespace atlas_refine
