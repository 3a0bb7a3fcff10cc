// Deformation: no flips, edges parallel to the axes to the last bit and in the asked directions.
#include "align/deform.h"

#include "align/prepare.h"
#include "align/target_angles.h"
#include "cut_checks.h"

namespace atlas_refine {
namespace {

struct Deformed {
  Chart disk;
  BoundaryAngles boundary;
  std::vector<int> asked;
  std::optional<AlignedShape> shape;
};

Deformed deformed(const Chart& chart, double sigma) {
  Deformed out{prepare_chart(chart).mesh.to_chart(chart), {}, {}, {}};
  out.boundary = polar_angles(out.disk);
  const double length = sigma * out.boundary.perimeter();
  const std::vector<double> angles = smoothed_angles(out.boundary, length);
  out.asked = target_angles({out.boundary.lengths, angles, 2.5 * length, 2 * length});
  out.shape = deform_to_axes(out.disk, {out.boundary, out.asked}, [] {});
  return out;
}

void expect_aligned(const Deformed& d) {
  ASSERT_TRUE(d.shape.has_value());
  testing::expect_positive(d.shape->uvs, d.disk.triangles);
  AxisAlignedChart chart{.way = AxisAlignedChart::Way::Deformed,
                         .mesh = SplitMesh(d.disk),
                         .boundary = d.boundary.vertices,
                         .quarter_turns = d.shape->quarter_turns};
  chart.mesh.uvs = d.shape->uvs;
  testing::expect_axis_aligned(chart);
}

TEST(Deform, EveryShapeBecomesAxisAligned) {
  for (const shapes::Named& shape : testing::many_polygons()) {
    SCOPED_TRACE(shape.name);
    expect_aligned(deformed(testing::chart_of(shape.polygon, 0.1), 0.015));
  }
}

TEST(Deform, ABandThatOverlapsItself) {
  const Deformed d = deformed(testing::charts_of(shapes::self_overlapping()).front(), 0.015);
  expect_aligned(d);
}

TEST(Deform, ARectangleStaysAsItIs) {
  const Deformed d = deformed(testing::chart_of(shapes::rectangle(1, 0.6), 0.1), 0.01);
  expect_aligned(d);
  EXPECT_EQ(d.shape->quarter_turns, d.asked);
  Chart after = d.disk;
  after.uvs = d.shape->uvs;
  EXPECT_NEAR(dirichlet_sums({after}).best_energy(), dirichlet_sums({d.disk}).best_energy(), 2e-2);
}

TEST(Deform, FlatteningTakesEachSegmentsMean) {
  Chart square;
  square.uvs = {{0, 0.1}, {1, 0}, {1.2, 1}, {0, 1}};
  const BoundaryAngles boundary{{0, 1, 2, 3}, {1, 1, 1, 1}, {}};
  const std::vector<int> turns = {0, 1, 2, 3};
  const std::vector<Vec2> flat = flattened(square.uvs, {boundary, turns});
  EXPECT_DOUBLE_EQ(flat[0].y(), 0.05);
  EXPECT_EQ(flat[0].y(), flat[1].y());
  EXPECT_DOUBLE_EQ(flat[1].x(), 1.1);
  EXPECT_EQ(flat[1].x(), flat[2].x());
  EXPECT_EQ(flat[2].y(), flat[3].y());
  EXPECT_EQ(flat[3].x(), flat[0].x());
}

TEST(Deform, ACallerMayStopIt) {
  const Chart chart = testing::chart_of(shapes::star());
  const Chart disk = prepare_chart(chart).mesh.to_chart(chart);
  const BoundaryAngles boundary = polar_angles(disk);
  const std::vector<int> turns = target_angles({boundary.lengths, boundary.angle_rad, 0.1, 0});
  EXPECT_THROW(deform_to_axes(disk, {boundary, turns}, [] { throw std::runtime_error("stop"); }), std::runtime_error);
}

}  // namespace
}  // namespace atlas_refine
