// Parts of folded charts that come together again as they were, and those that do not.
#include "input/mirrored_copies.h"

#include <gtest/gtest.h>

#include <numeric>
#include <utility>

#include "sheets.h"

namespace atlas_refine {
namespace {

std::vector<Follower> stacks_of(const ChartSet& set) {
  std::vector<int> all(set.charts.size());
  std::iota(all.begin(), all.end(), 0);
  return find_stacks(charts_as_placed(set), all, 1e-6);
}

std::vector<int> kept(const ChartSet& set, std::vector<Follower> followers) {
  keep_mirrored_copies(set, followers);
  std::vector<int> out;
  for (const Follower& follower : followers) out.push_back(follower.chart);
  return out;
}

/// A strip folded back and forth onto one quad.
ChartSet pleated(int quads) {
  Atlas atlas = strip(quads);
  for (int c = 0; c < atlas.corner_count(); ++c) atlas.corner_uvs[c].x() = atlas.corner_vertices[c] / 2 % 2;
  return split_charts(atlas);
}

TEST(MirroredCopies, AreKept) {
  const ChartSet set = pleated(4);
  const std::vector<Follower> followers = stacks_of(set);
  ASSERT_EQ(followers.size(), 3u);
  EXPECT_EQ(kept(set, followers), (std::vector<int>{1, 2, 3}));
}

TEST(MirroredCopies, ThatTheLineBetweenThemWouldTearAreNot) {
  const ChartSet set = pleated(2);
  std::vector<Follower> followers = stacks_of(set);
  ASSERT_EQ(followers.size(), 1u);
  const FoldEdge& edge = set.folds.front().edges.front();
  std::vector<int>& onto = followers.front().vertices;
  std::swap(onto[edge.ends[0][1]], onto[edge.ends[1][1]]);
  EXPECT_TRUE(kept(set, followers).empty());
}

TEST(MirroredCopies, ThatOnlyATornOneJoinsWithTheLeaderAreNot) {
  const ChartSet set = pleated(3);
  std::vector<Follower> followers = stacks_of(set);
  ASSERT_EQ(followers.size(), 2u);
  std::erase_if(followers, [](const Follower& follower) { return follower.chart == 1; });
  EXPECT_TRUE(kept(set, followers).empty());
}

TEST(MirroredCopies, OfAnotherChartAreLeftAlone) {
  ChartSet set = pleated(3);
  const std::vector<Follower> followers = stacks_of(set);
  set.folds.front().charts = {1, 2};
  std::erase_if(set.folds.front().edges, [](const FoldEdge& edge) { return edge.charts[0] == 0 || edge.charts[1] == 0; });
  EXPECT_EQ(kept(set, followers), (std::vector<int>{1, 2}));
}

}  // namespace
}  // namespace atlas_refine
