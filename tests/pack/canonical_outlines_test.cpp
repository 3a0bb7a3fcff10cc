// Outlines are told by their shapes alone: what must not matter changes no digit.
#include "pack/canonical_outlines.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "outlines.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

std::vector<Outline> some_outlines(Rotate rotate) {
  std::vector<Outline> out;
  for (const auto& shape : shapes::named_polygons()) out.push_back(testing::outline_of(shape.polygon));
  for (int seed = 1; seed < 6; ++seed) out.push_back(testing::outline_of(shapes::random_polygon(seed)));
  out.push_back(testing::outline_of(shapes::rectangle(0.3, 0.1)));
  out.push_back(testing::outline_of({{{0, 0}, {1, 0}, {0.4, 0.9}}, {}}));  // acute: three boxes of one area
  for (Outline& outline : out) outline.rotate = rotate;
  return out;
}

/// Moved by `motion`, then scaled; in another order, loops from other vertices on.
std::vector<Outline> changed(const std::vector<Outline>& outlines, const Placement& motion, double scale) {
  std::vector<Outline> out;
  Rng rng(3);
  for (const Outline& outline : outlines) {
    out.push_back(testing::placed(outline, motion));
    for (auto& loop : out.back().loops) {
      for (Vec2& p : loop) p *= scale;
      std::rotate(loop.begin(), loop.begin() + rng.below(static_cast<int>(loop.size())), loop.end());
    }
  }
  std::reverse(out.begin(), out.end());
  return out;
}

void expect_same(const CanonicalOutlines& one, const CanonicalOutlines& two) {
  ASSERT_EQ(one.outlines.size(), two.outlines.size());
  for (std::size_t k = 0; k < one.outlines.size(); ++k)
    EXPECT_EQ(one.outlines[k].loops, two.outlines[k].loops) << "outline " << k;
}

TEST(CanonicalOutlines, MotionsThatAreAllowedUnitsAndOrdersChangeNoDigit) {
  const Placement moved{1, 0, {37, -12}}, quarter{0, 1, {3, 5}}, half{-1, 0, {0, 0}}, any{std::cos(1.1), std::sin(1.1), {-4, 2}};
  for (const Rotate rotate : {Rotate::Any, Rotate::QuarterTurns, Rotate::None}) {
    const std::vector<Outline> outlines = some_outlines(rotate);
    const CanonicalOutlines plain = canonical_outlines(outlines, 1);
    for (const double scale : {1.0, 1e-6, 1e6, 7.0}) {
      expect_same(plain, canonical_outlines(changed(outlines, moved, scale), scale));
      if (rotate == Rotate::None) continue;
      expect_same(plain, canonical_outlines(changed(outlines, quarter, scale), scale));
      expect_same(plain, canonical_outlines(changed(outlines, half, scale), scale));
      if (rotate == Rotate::Any) expect_same(plain, canonical_outlines(changed(outlines, any, scale), scale));
    }
  }
}

TEST(CanonicalOutlines, PlacementsFindTheirWayBackToTheInput) {
  const std::vector<Outline> outlines = some_outlines(Rotate::Any);
  const CanonicalOutlines canonical = canonical_outlines(outlines, 5);
  std::vector<Placement> placements;
  for (std::size_t k = 0; k < outlines.size(); ++k)
    placements.push_back({std::cos(0.3 * k), std::sin(0.3 * k), Vec2(k, 2.0 * k)});
  const std::vector<Placement> of_input = canonical.of_input(placements);
  for (std::size_t k = 0; k < outlines.size(); ++k) {
    const int source = canonical.sources[k];
    const Outline own = testing::placed(canonical.outlines[k], placements[k]);
    const Outline input = testing::placed(outlines[source], of_input[source]);
    for (const Vec2& p : own.loops[0]) {
      double nearest = INFINITY;
      for (const Vec2& q : input.loops[0]) nearest = std::min(nearest, (5 * p - q).norm());
      EXPECT_LT(nearest, 5 * canonical.off_grid + 1e-12);
    }
  }
}

}  // namespace
}  // namespace atlas_refine
