// Charts in rows: apart, in the box that is told, and dense where they are of like height.
#include "pack/rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "measure/distortion.h"
#include "outlines.h"
#include "pack/turns.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

using testing::Charts;

/// Any three points, but for needles; of a quad without the third quarter, which may be concave.
shapes::Polygon random_face(std::uint64_t seed, int corners) {
  Rng rng(seed);
  const double size = rng.uniform(0.5, 1);
  shapes::Polygon face;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * (k + rng.uniform(0, 0.6)) / corners, radius = size * rng.uniform(0.4, 1);
    face.outer.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return face;
}

/// Together of area 1.
Charts random_faces(int count, int corners) {
  std::vector<shapes::Polygon> faces;
  double area = 0;
  for (int k = 0; k < count; ++k) {
    faces.push_back(random_face(count + k, corners));
    area += shapes::area(faces.back());
  }
  Charts charts;
  for (const shapes::Polygon& face : faces) charts.add(shapes::transformed(face, 1 / std::sqrt(area), 0, {0, 0}));
  return charts;
}

Charts squares(int count) {
  Charts charts;
  for (int k = 0; k < count; ++k)
    charts.add(shapes::transformed(shapes::rectangle(1, 1), 1 / std::sqrt(count), 0.1 * k, {0.1 * k, 0}));
  return charts;
}

std::vector<Placement> in_rows(const Charts& charts, const RowOptions& options) {
  Watch watch({});
  return pack_in_rows(charts.outlines, options, watch);
}

Box box_of(const Charts& charts, const std::vector<Placement>& placements) {
  Box box{Vec2::Constant(INFINITY), Vec2::Constant(-INFINITY)};
  for (std::size_t i = 0; i < placements.size(); ++i) {
    const Outline outline = testing::placed(charts.outlines[i], placements[i]);
    for (const Vec2& p : outline.loops[0]) {
      box.min = box.min.cwiseMin(p);
      box.max = box.max.cwiseMax(p);
    }
  }
  return box;
}

double pe_of(const Charts& charts, const RowOptions& options) {
  return charts.area / box_of_aspect(box_of(charts, in_rows(charts, options)), options.box_aspect).area();
}

TEST(Rows, ChartsAreTheGapApart) {
  for (const int corners : {3, 4, 7}) {
    for (const double gap : {0.0, 1e-3, 0.02, 0.3}) {
      const Charts charts = random_faces(120, corners);
      const auto placements = in_rows(charts, {.gap = gap});
      ASSERT_EQ(placements.size(), 120);
      const double nearest = testing::smallest_distance(charts.outlines, placements);
      EXPECT_GE(nearest, gap);
      EXPECT_GT(nearest, 0);
      EXPECT_LT(nearest, gap + 1e-5);
    }
  }
}

TEST(Rows, SquaresStandInRowsAndColumns) {
  constexpr double kGap = 0.005;
  const double side = 1 + 19 * kGap;
  EXPECT_GT(pe_of(squares(400), {.gap = kGap, .box_aspect = 1}), 0.95 / (side * side));
}

TEST(Rows, SingleFacesFillTheBoxThatIsEnough) {
  const Charts charts = random_faces(1500, 3);
  for (const double aspect : {0.0, 1.0, 3.0}) {
    EXPECT_GE(pe_of(charts, {.gap = 1e-6, .box_aspect = aspect, .enough = 1 / 0.89}), 0.89);
    EXPECT_TRUE(in_rows(charts, {.gap = 1e-6, .box_aspect = aspect, .enough = 1 / 0.97}).empty());
  }
}

TEST(Rows, ChartsTurnAsTheyMay) {
  for (const Rotate rotate : {Rotate::QuarterTurns, Rotate::None}) {
    Charts charts = random_faces(100, 3);
    for (Outline& outline : charts.outlines) outline.rotate = rotate;
    const auto placements = in_rows(charts, {.gap = 1e-3});
    ASSERT_EQ(placements.size(), 100);
    EXPECT_GE(testing::smallest_distance(charts.outlines, placements), 1e-3);
    for (const Placement& placement : placements)
      EXPECT_NEAR(placement.cosine, rotate == Rotate::None ? 1 : std::round(placement.cosine), 1e-12);
  }
}

TEST(Rows, NoneIsLongerThanARow) {
  Charts charts = squares(100);
  charts.add(shapes::rectangle(3, 0.01));
  EXPECT_TRUE(in_rows(charts, {.box_aspect = 1}).empty());
}

TEST(Rows, ChartsWithoutAreaStandSomewhere) {
  Charts charts = squares(20);
  charts.outlines.push_back({{{{0.5, 0.5}}}});
  charts.outlines.push_back({{{{0, 0}, {0.1, 0}, {0.2, 0}}}});
  EXPECT_EQ(in_rows(charts, {.gap = 0.01}).size(), 22);
}

}  // namespace
}  // namespace atlas_refine
