// Cuts of the plane, mirrored by u = 0.
#include "needed/symmetric_cuts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace atlas_refine {
namespace {

/// Vertices are numbered by their places, in tenths.
int number_at(const Vec2& at) { return static_cast<int>(std::lround(10 * at.x() + 1000 * at.y())); }

CutPlace cut(const Vec2& a, const Vec2& b) { return {0, {.ends = {number_at(a), number_at(b)}, .at = {a, b}}}; }

const MirroredCuts kByU = {
    [](const CutPlace& place) {
      const auto image = [](const Vec2& at) { return Vec2(-at.x(), at.y()); };
      return cut(image(place.chord.at[0]), image(place.chord.at[1]));
    },
    [](const CutPlace& place) {
      return cut({0, place.chord.at[0].y()}, {0, place.chord.at[1].y()});
    },
};

TEST(SymmetricCuts, OfTwoThatAreNearlyImagesEitherIsTakenForBoth) {
  const auto sets = symmetric_sets({cut({2, 0}, {2, 3}), cut({-2.2, 0.1}, {-2, 3})}, kByU);
  ASSERT_EQ(sets.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(symmetric_count(sets[k], kByU), 2);
    EXPECT_TRUE(same(*kByU.image(sets[k][0]), sets[k][1]));
  }
  EXPECT_EQ(sets[0][0].chord.at[0], Vec2(2, 0));
  EXPECT_EQ(sets[1][1].chord.at[0], Vec2(-2.2, 0.1));
}

TEST(SymmetricCuts, OneAsLongIsPutToTheImageOfAnother) {
  const auto sets = symmetric_sets({cut({2, 0}, {2, 3}), cut({-8, 0}, {-8, 3})}, kByU);
  ASSERT_EQ(sets.size(), 2u);
  EXPECT_TRUE(same(sets[0][1], cut({-2, 0}, {-2, 3})));
  EXPECT_TRUE(same(sets[1][0], cut({8, 0}, {8, 3})));
}

TEST(SymmetricCuts, OneAcrossThePlaneIsMadeStraight) {
  const auto sets = symmetric_sets({cut({-2, 0}, {2, 0.5})}, kByU);
  ASSERT_EQ(sets.size(), 2u);
  EXPECT_TRUE(same(sets[0][0], cut({-2, 0}, {2, 0})));
  EXPECT_TRUE(same(sets[1][0], cut({-2, 0.5}, {2, 0.5})));
}

TEST(SymmetricCuts, OneAlongThePlaneIsPutOntoIt) {
  const auto sets = symmetric_sets({cut({0.2, 0}, {-0.1, 3})}, kByU);
  ASSERT_FALSE(sets.empty());
  EXPECT_TRUE(same(sets[0][0], cut({0, 0}, {0, 3})));
}

TEST(SymmetricCuts, WhatIsSymmetricOrAloneIsLeft) {
  EXPECT_TRUE(symmetric_sets({cut({2, 0}, {2, 3}), cut({-2, 3}, {-2, 0})}, kByU).empty());
  EXPECT_TRUE(symmetric_sets({cut({2, 0}, {2, 3})}, kByU).empty());
}

TEST(SymmetricCuts, FarFromTheImageOfALongerOneNoneIsPutThere) {
  const auto sets = symmetric_sets({cut({2, 0}, {2, 3}), cut({-8, 0}, {-9, 4})}, kByU);
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_TRUE(same(sets[0][0], cut({2, 0}, {2, 3})));
  EXPECT_TRUE(same(sets[0][1], cut({-2, 0}, {-2, 3})));
}

TEST(SymmetricCuts, CutsWithoutAnImageAreLeft) {
  const MirroredCuts none = {[](const CutPlace&) { return std::nullopt; }, [](const CutPlace&) { return std::nullopt; }};
  EXPECT_TRUE(symmetric_sets({cut({2, 0}, {2, 3}), cut({-2.1, 0}, {-2, 3})}, none).empty());
}

}  // namespace
}  // namespace atlas_refine
