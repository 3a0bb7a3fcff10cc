// Charts placed in a fixed box around obstacles: inside, apart by the gap, as large as they fit.
#include "pack/pack_in_frame.h"

#include <gtest/gtest.h>

#include "outlines.h"

namespace atlas_refine {
namespace {

using testing::distance;
using testing::outline_of;

std::vector<Outline> shapes_to_place(Rotate rotate = Rotate::Any) {
  std::vector<Outline> outlines;
  for (const auto& [name, polygon] : shapes::named_polygons()) outlines.push_back(outline_of(polygon));
  for (Outline& outline : outlines) outline.rotate = rotate;
  return outlines;
}

Outline rectangle(double width, double height, const Vec2& at) {
  return outline_of(shapes::transformed(shapes::rectangle(width, height), 1, 0, at));
}

Outline scaled(Outline outline, double scale) {
  for (auto& loop : outline.loops) {
    for (Vec2& p : loop) p *= scale;
  }
  return outline;
}

/// The outlines where they lie in the frame.
std::vector<Outline> in_frame(const std::vector<Outline>& outlines, const FramePacking& packing) {
  std::vector<Outline> out;
  for (std::size_t k = 0; k < outlines.size(); ++k)
    out.push_back(scaled(testing::placed(outlines[k], packing.placements[k]), packing.scale));
  return out;
}

void expect_apart(const std::vector<Outline>& placed, const std::vector<Outline>& obstacles, const FrameOptions& options) {
  for (std::size_t a = 0; a < placed.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) EXPECT_GE(distance(placed[a], placed[b]), options.gap);
    for (const Outline& obstacle : obstacles) EXPECT_GE(distance(placed[a], obstacle), options.gap);
    for (const auto& loop : placed[a].loops) {
      for (const Vec2& p : loop) {
        EXPECT_GE(p.minCoeff(), options.margin * (1 - 1e-9));
        EXPECT_GE((options.frame - p).minCoeff(), options.margin * (1 - 1e-9));
      }
    }
  }
}

class PackInFrame : public ::testing::TestWithParam<FrameOptions> {};

TEST_P(PackInFrame, KeepsTheGapToObstaclesAndTheMarginToTheWalls) {
  const std::vector<Outline> outlines = shapes_to_place();
  // Two obstacles that overlap, one half outside, one outside altogether.
  const std::vector<Outline> obstacles = {rectangle(0.2, 0.33, {0.4, 0.3}), rectangle(0.33, 0.15, {0.45, 0.35}),
                                          rectangle(0.4, 0.2, {-0.2, 0.05}), rectangle(0.5, 0.5, {3, -2})};
  const auto packing = pack_in_frame(outlines, obstacles, GetParam());
  ASSERT_TRUE(packing);
  EXPECT_GT(packing->scale, 0.1);
  expect_apart(in_frame(outlines, *packing), obstacles, GetParam());
}

INSTANTIATE_TEST_SUITE_P(GapsAndFrames, PackInFrame,
                         ::testing::Values(FrameOptions{.frame = {1, 1}, .margin = 0.002, .gap = 0.004},
                                           FrameOptions{.frame = {1, 1}, .margin = 0.002, .gap = 0.03},
                                           FrameOptions{.frame = {2.5, 1}, .margin = 0.001, .gap = 0.003},
                                           FrameOptions{.frame = {0.7, 1}, .margin = 0.001, .gap = 0, .threads = 2}));

TEST(PackInFrameOnly, ChartsGoIntoTheHolesOfObstacles) {
  const shapes::Polygon window{{{-1, -1}, {2, -1}, {2, 2}, {-1, 2}}, {{{0.3, 0.3}, {0.3, 0.8}, {0.8, 0.8}, {0.8, 0.3}}}};
  const FrameOptions options{.frame = {1, 1}, .margin = 0.001, .gap = 0.002};
  const std::vector<Outline> outlines = {rectangle(1, 1, {5, 5})}, obstacles = {outline_of(window)};
  const auto packing = pack_in_frame(outlines, obstacles, options);
  ASSERT_TRUE(packing);
  EXPECT_GT(packing->scale, 0.45);
  expect_apart(in_frame(outlines, *packing), obstacles, options);
}

TEST(PackInFrameOnly, NothingFitsWhereNothingIsFree) {
  EXPECT_FALSE(pack_in_frame(shapes_to_place(), {rectangle(1, 1, {0, 0})}, {.frame = {1, 1}, .margin = 0.001, .gap = 0.002}));
}

TEST(PackInFrameOnly, AnObstacleFarLargerThanTheFrameTakesWhatItCovers) {
  const FrameOptions options{.frame = {1, 1}, .margin = 0.001, .gap = 0.002};
  const Outline half{{{{-1e9, -1e9}, {0.5, -1e9}, {0.5, 1e9}, {-1e9, 1e9}}}};
  const auto packing = pack_in_frame(shapes_to_place(), {half}, options);
  ASSERT_TRUE(packing);
  for (const Outline& outline : in_frame(shapes_to_place(), *packing)) {
    for (const Vec2& p : outline.loops.front()) EXPECT_GE(p.x(), 0.502);
  }
  EXPECT_FALSE(pack_in_frame(shapes_to_place(), {scaled(half, 1e18)}, options)) << "round-off alone is larger than the frame";
}

TEST(PackInFrameOnly, ANeedleFarLongerThanTheFrameIsShrunkToIt) {
  const FrameOptions options{.frame = {1, 1}, .margin = 0.001, .gap = 0.002, .enough = 1e7};
  const std::vector<Outline> needle = {rectangle(1, 1e-3, {0, 0})};
  const auto packing = pack_in_frame(needle, {rectangle(0.5, 0.5, {0.2, 0.2})}, options);
  ASSERT_TRUE(packing);
  EXPECT_GT(packing->scale, 0.9);
  expect_apart(in_frame(needle, *packing), {rectangle(0.5, 0.5, {0.2, 0.2})}, options);
}

TEST(PackInFrameOnly, StopsAtWhatIsEnough) {
  const auto packing = pack_in_frame(shapes_to_place(), {}, {.frame = {1, 1}, .margin = 0.001, .gap = 0.002, .enough = 0.1});
  ASSERT_TRUE(packing);
  EXPECT_EQ(packing->scale, 0.1);
}

TEST(PackInFrameOnly, ChartsTurnAsTheyMay) {
  for (const Rotate rotate : {Rotate::QuarterTurns, Rotate::None}) {
    const auto packing = pack_in_frame(shapes_to_place(rotate), {rectangle(0.2, 0.3, {0.4, 0.3})},
                                       {.frame = {1, 1}, .margin = 0.002, .gap = 0.004});
    ASSERT_TRUE(packing);
    for (const Placement& placement : packing->placements) {
      EXPECT_EQ(placement.cosine * placement.sine, 0);
      if (rotate == Rotate::None) {
        EXPECT_EQ(placement.cosine, 1);
      }
    }
  }
}

TEST(PackInFrameOnly, SameBitsForEveryNumberOfThreads) {
  FrameOptions options{.frame = {1, 1}, .margin = 0.002, .gap = 0.004};
  const auto run = [&](int threads) {
    options.threads = threads;
    return pack_in_frame(shapes_to_place(), {rectangle(0.2, 0.3, {0.4, 0.3})}, options);
  };
  const auto one = run(1), four = run(4);
  ASSERT_TRUE(one && four);
  EXPECT_EQ(one->scale, four->scale);
  for (std::size_t k = 0; k < one->placements.size(); ++k) {
    EXPECT_EQ(one->placements[k].offset, four->placements[k].offset);
    EXPECT_EQ(one->placements[k].cosine, four->placements[k].cosine);
  }
}

}  // namespace
}  // namespace atlas_refine
