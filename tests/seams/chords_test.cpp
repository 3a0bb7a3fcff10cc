// Necks of plane regions whose necks are known.
#include "seams/chords.h"

#include <gtest/gtest.h>

#include <cmath>

namespace atlas_refine {
namespace {

/// Points along the polygon, `step` apart, numbered from `first`.
void add_loop(const std::vector<Vec2>& corners, double step, Border& border) {
  int number = 0;
  for (const auto& loop : border.loops) number += static_cast<int>(loop.size());
  auto& loop = border.loops.emplace_back();
  auto& at = border.at.emplace_back();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2 &a = corners[k], &b = corners[(k + 1) % corners.size()];
    const int count = std::max(1, static_cast<int>(std::lround((b - a).norm() / step)));
    for (int i = 0; i < count; ++i) {
      at.emplace_back(a + (b - a) * i / count);
      loop.push_back(number++);
    }
  }
}

Border border_of(const std::vector<Vec2>& corners, double step = 0.05) {
  Border border;
  add_loop(corners, step, border);
  return border;
}

/// Two squares of side 1, joined by a bridge 0.4 long and 0.2 wide.
Border dumbbell() {
  return border_of(
      {{0, 0}, {1, 0}, {1, 0.4}, {1.4, 0.4}, {1.4, 0}, {2.4, 0}, {2.4, 1}, {1.4, 1}, {1.4, 0.6}, {1, 0.6}, {1, 1}, {0, 1}});
}

TEST(Necks, TheBridgeBetweenTwoSquaresIsTheFirst) {
  const std::vector<Chord> found = necks(dumbbell(), 0.05, 8);
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found[0].length(), 0.2, 1e-9);
  EXPECT_GT(found[0].cut_off, 1 - 1e-9);
  EXPECT_LT(found[0].cut_off, 1.04 + 1e-9);
  for (const Vec2& at : found[0].at) {
    EXPECT_GE(at.x(), 1 - 1e-9);
    EXPECT_LE(at.x(), 1.4 + 1e-9);
  }
}

TEST(Necks, EachRunsInside) {
  const Border border = border_of({{0, 0}, {1, 0}, {1, 1}, {0.6, 1}, {0.6, 0.3}, {0.4, 0.3}, {0.4, 1}, {0, 1}});  // a U
  const std::vector<Chord> found = necks(border, 0.05, 20);
  EXPECT_GE(found.size(), 3u);
  for (const Chord& chord : found) {
    const Vec2 middle = 0.5 * (chord.at[0] + chord.at[1]);
    const bool in_notch = middle.x() > 0.4 + 1e-9 && middle.x() < 0.6 - 1e-9 && middle.y() > 0.3 + 1e-9;
    EXPECT_FALSE(in_notch) << middle.transpose();
    EXPECT_GT(chord.cut_off, 0.05);
  }
}

TEST(Necks, NothingIsCutOffThatIsTooSmall) {
  for (const Chord& chord : necks(dumbbell(), 0.9, 30)) EXPECT_GE(chord.cut_off, 0.9);
}

TEST(Necks, AWayFromAHoleToTheOutsideIsOne) {
  Border border = border_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  add_loop({{0.1, 0.4}, {0.1, 0.6}, {0.3, 0.6}, {0.3, 0.4}}, 0.05, border);  // clockwise
  const std::vector<Chord> found = necks(border, 0.05, 8);
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found[0].length(), 0.1, 1e-9);
  EXPECT_EQ(found[0].cut_off, 0);
}

TEST(ChordsFrom, TheShortestWaysLeadToDifferentSides) {
  const std::vector<Chord> found = chords_from(border_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), 1000, {0.3, 0.45}, 2);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].at[0].x(), 0, 1e-9);
  EXPECT_NEAR(found[1].at[0].y(), 0, 1e-9);
  for (const Chord& chord : found) {
    EXPECT_EQ(chord.ends[1], 1000);
    EXPECT_EQ(chord.at[1], Vec2(0.3, 0.45));
  }
}

}  // namespace
}  // namespace atlas_refine
