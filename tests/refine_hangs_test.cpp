// Atlases that once took all memory or never ended: needles, places that are one point in space, gaps that leave no room.
#include <cmath>

#include "output_atlas.h"
#include "refine_checks.h"
#include "shapes.h"
#include "small_atlases.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

constexpr double kPi = 3.14159265358979;

/// A polygon of many corners that is a single point in space.
Atlas polygon_without_size(int corners) {
  std::vector<Vec3> positions;
  std::vector<int> face;
  for (int k = 0; k < corners; ++k) {
    const double turn = 2 * kPi * k / corners, radius = 1 + 0.4 * std::sin(5 * turn);
    positions.push_back(Vec3(radius * std::cos(turn), radius * std::sin(turn), 0));
    face.push_back(k);
  }
  Atlas atlas = flat_atlas(positions, {face});
  for (Vec3& p : atlas.positions) p.setZero();
  return atlas;
}

/// Squares, and one triangle with a corner `reach` away.
Atlas squares_and_needle(double reach) {
  const Atlas needle = flat_atlas({{-3, 0, 0}, {-2, 0, 0}, {-2, 1, 0}}, {{0, 1, 2}});
  Atlas atlas = shapes::combine({shapes::two_squares(0.1), needle});
  atlas.corner_uvs[atlas.corner_count() - 3].x() = -reach;
  return atlas;
}

RefineOptions cut_options(int candidates) {
  RefineOptions options{.pe_bound = 0.7, .seams = Seams::Rectangles};
  options.rectangles.candidates = candidates;
  return options;
}

/// Every triangle a chart, in the UVs as in the plane.
Atlas single_triangles(int count) {
  std::vector<Vec3> positions;
  std::vector<std::vector<int>> faces;
  for (int k = 0; k < count; ++k) {
    Rng rng(9, k);
    const Vec3 corner(2 * (k % 50), 2 * (k / 50), 0);
    const double turn = rng.uniform(0, 2 * kPi), between = rng.uniform(0.8, 2), size = rng.uniform(0.5, 1);
    const int first = static_cast<int>(positions.size());
    positions.push_back(corner);
    positions.push_back(corner + size * Vec3(std::cos(turn), std::sin(turn), 0));
    positions.push_back(corner + rng.uniform(0.5, 1) * Vec3(std::cos(turn + between), std::sin(turn + between), 0));
    faces.push_back({first, first + 1, first + 2});
  }
  return flat_atlas(positions, faces);
}

/// A valid atlas at the bound, cut or not.
void refine_validly(const Atlas& atlas, const RefineOptions& options) {
  const RefineResult result = refine(atlas, options);
  const Validity validity = validate(testing::output(atlas, result));
  EXPECT_TRUE(validity.valid()) << validity.problem;
  EXPECT_GE(result.after.pe, options.pe_bound);
}

TEST(Hangs, AConeWhoseTipIsManyVerticesAtOnePlaceIsCutOrSqueezed) {
  for (const int candidates : {1, 20}) refine_validly(cone(8), cut_options(candidates));
}

TEST(Hangs, ThousandsOfChartsArePlacedWithALittleLessGapInsteadOfBent) {
  const Atlas atlas = shapes::squares(1200);
  const RefineOptions options{.pe_bound = 0.85};
  const RefineResult result = testing::refine_soundly(atlas, options);
  EXPECT_EQ(result.intervention, Intervention::Moved);
  EXPECT_LT(result.gap.value, Gap{}.value);
  EXPECT_GE(result.gap.value, 0.3 * Gap{}.value);
  EXPECT_NE(result.warnings.back().find("charts would have to be bent"), std::string::npos) << result.warnings.back();
}

TEST(Hangs, SingleFacesStandInRowsInsteadOfBeingBent) {
  for (const int count : {600, 1500}) {
    const RefineOptions options{.box_aspect = 1, .gap = Gap{.value = 0.0008}};
    const RefineResult result = testing::refine_soundly(single_triangles(count), options);
    EXPECT_EQ(result.intervention, Intervention::Moved);
    EXPECT_NEAR(result.after.distortion, 1, 1e-9);
  }
}

TEST(Hangs, ThousandsOfChartsThatNeedNoCutAreNotBentEither) {
  Atlas atlas = shapes::squares(1200);
  for (Vec3& p : atlas.positions) p.x() *= 1.5;  // there would be something to gain
  for (const Cut cut : {Cut::Split, Cut::Edges}) {
    const RefineResult result = refine(atlas, {.pe_bound = 0.76, .seams = Seams::Rectangles, .cut = cut});
    EXPECT_EQ(result.intervention, Intervention::Moved);
    EXPECT_EQ(result.iterations, 0);
  }
}

TEST(Hangs, APolygonThatIsOnePointInSpaceIsCutOrSqueezed) {
  const Atlas one = polygon_without_size(30);
  Atlas other = one;
  for (Vec2& uv : other.corner_uvs) uv.x() += 4;
  refine_validly(shapes::combine({one, other}), cut_options(20));
}

TEST(Hangs, ANeedleIsLeftAndTheOthersAreNot) {
  for (const double reach : {1e7, 1e9}) {
    for (const Seams seams : {Seams::None, Seams::Rectangles}) {
      const RefineResult result = refine(squares_and_needle(reach), {.pe_bound = 0.5, .seams = seams, .best_effort = true});
      ASSERT_EQ(result.charts.size(), 3U);
      EXPECT_EQ(result.charts[0].fate, Fate::Refined);
      EXPECT_EQ(result.charts[1].fate, Fate::Refined);
      EXPECT_EQ(result.charts[2].fate, Fate::Left);
    }
  }
}

TEST(Hangs, ALongTriangleIsPackedWithTheOthers) {
  for (const double reach : {10.0, 1e3, 1e5}) {
    const Atlas atlas = squares_and_needle(reach);
    RefineOptions options{.pe_bound = 0.5, .best_effort = true};
    EXPECT_TRUE(validate(testing::with_corner_uvs(atlas, refine(atlas, options).corner_uvs)).valid());
  }
}

TEST(Hangs, AGapThatLeavesNoRoomIsRefused) {
  const RefineError error = testing::refusal(shapes::squares(150), {.pe_bound = 0.5, .gap = Gap{.value = 0.1}});
  EXPECT_EQ(error.code(), ErrorCode::BoundNotReached);
  EXPECT_NE(std::string(error.what()).find("leaves no room for 150 charts"), std::string::npos) << error.what();
}

TEST(Hangs, WhereTheGapTakesTheRoomThatIsSaid) {
  std::vector<Atlas> strips(30, strip(12));  // as cards of hair are
  for (std::size_t k = 0; k < strips.size(); ++k) {
    for (Vec2& uv : strips[k].corner_uvs) uv.y() += 2.0 * static_cast<double>(k);
  }
  const Atlas atlas = shapes::combine(strips);
  RefineOptions options{.pe_bound = 0.85, .box_aspect = 1, .gap = Gap{.value = 0.008}, .density = Density::Keep};
  options.keep_shape.assign(atlas.face_count(), 1);
  const std::string said = testing::refusal(atlas, options).what();
  EXPECT_NE(said.find("with the gap around them the charts would take 10"), std::string::npos) << said;
  EXPECT_NE(said.find(" % of the room: a smaller one leaves more"), std::string::npos) << said;
}

}  // namespace
}  // namespace atlas_refine
