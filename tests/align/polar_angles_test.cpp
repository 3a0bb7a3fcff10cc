// Directions of the boundary: one turn in sum, smoothing that keeps it, the best rotation.
#include "align/polar_angles.h"

#include <numbers>

#include "align/prepare.h"
#include "cut_checks.h"
#include "support/rng.h"

namespace atlas_refine {
namespace {

using std::numbers::pi;

Chart disk_of(const Chart& chart) { return prepare_chart(chart).mesh.to_chart(chart); }

/// From the last edge on to the first, the exterior angle there included.
double closing_turn(const Chart& disk, const BoundaryAngles& boundary, const std::vector<double>& angles) {
  const Vec2 last = disk.uvs[boundary.vertices.front()] - disk.uvs[boundary.vertices.back()];
  const Vec2 first = disk.uvs[boundary.vertices[1]] - disk.uvs[boundary.vertices.front()];
  return angles.back() + std::atan2(cross(last, first), last.dot(first)) - angles.front();
}

double axis_error(const std::vector<double>& lengths, const std::vector<double>& angles, double turn) {
  double sum = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const double c = std::cos(angles[i] + turn), s = std::sin(angles[i] + turn);
    sum += lengths[i] * c * c * s * s;
  }
  return sum;
}

TEST(PolarAngles, AreTheEdgesDirectionsAndOneTurnInSum) {
  std::vector<Chart> charts = {testing::charts_of(shapes::self_overlapping()).front()};
  for (const shapes::Named& shape : testing::many_polygons()) charts.push_back(testing::chart_of(shape.polygon));
  for (const Chart& chart : charts) {
    const Chart disk = disk_of(chart);
    const BoundaryAngles boundary = polar_angles(disk);
    for (int i = 0; i < boundary.size(); ++i) {
      const Vec2 edge = disk.uvs[boundary.vertices[(i + 1) % boundary.size()]] - disk.uvs[boundary.vertices[i]];
      EXPECT_NEAR(boundary.lengths[i], edge.norm(), 1e-12);
      EXPECT_NEAR(boundary.lengths[i] * std::cos(boundary.angle_rad[i]), edge.x(), 1e-9);
      EXPECT_NEAR(boundary.lengths[i] * std::sin(boundary.angle_rad[i]), edge.y(), 1e-9);
    }
    EXPECT_NEAR(closing_turn(disk, boundary, boundary.angle_rad), 2 * pi, 1e-9);
  }
}

TEST(SmoothedAngles, StepByLessThanHalfATurnAndKeepTheSum) {
  for (const shapes::Named& shape : testing::many_polygons()) {
    SCOPED_TRACE(shape.name);
    const Chart disk = disk_of(testing::chart_of(shape.polygon));
    const BoundaryAngles boundary = polar_angles(disk);
    for (const double sigma : {0.001, 0.004, 0.01}) {
      const std::vector<double> angles = smoothed_angles(boundary, sigma * boundary.perimeter());
      ASSERT_EQ(angles.size(), boundary.angle_rad.size());
      // From one edge to the next by less than half a turn, and one turn in all.
      for (std::size_t i = 0; i + 1 < angles.size(); ++i) EXPECT_LT(std::abs(angles[i + 1] - angles[i]), pi);
      EXPECT_LT(std::abs(angles.front() + 2 * pi - angles.back()), pi);
    }
  }
}

TEST(SmoothedAngles, ARegularPolygonIsAsSmoothAsItGets) {
  const Chart disk = disk_of(testing::chart_of(shapes::disk(1, 40), 0.3));
  const BoundaryAngles boundary = polar_angles(disk);
  const std::vector<double> angles = smoothed_angles(boundary, 0.02 * boundary.perimeter());
  for (std::size_t i = 0; i < angles.size(); ++i) EXPECT_NEAR(angles[i], boundary.angle_rad[i], 2e-2);
}

TEST(SmoothedAngles, RoundOffAStaircase) {
  // A flight of small steps along the diagonal: sigma much larger than a step makes it a straight line.
  BoundaryAngles boundary;
  for (int k = 0; k < 40; ++k) boundary.angle_rad.push_back(k % 2 == 0 ? 0 : pi / 2);
  for (int k = 0; k < 40; ++k) boundary.angle_rad.push_back(pi + (k % 2 == 0 ? 0 : pi / 2));
  boundary.lengths.assign(80, 0.05);
  boundary.vertices.resize(80);
  const std::vector<double> angles = smoothed_angles(boundary, 0.3);
  EXPECT_NEAR(angles[20], pi / 4, 0.1);
  EXPECT_NEAR(angles[60], pi + pi / 4, 0.1);
}

TEST(AligningRotation, IsTheMinimumByTrial) {
  Rng rng(3);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> lengths, angles;
    for (int i = 0; i < 12; ++i) {
      lengths.push_back(rng.uniform(0.1, 2));
      angles.push_back(rng.uniform(-pi, 3 * pi));
    }
    const double turn = aligning_rotation(lengths, angles);
    EXPECT_LE(std::abs(turn), pi / 4 + 1e-12);
    const double error = axis_error(lengths, angles, turn);
    for (int k = 0; k < 400; ++k) EXPECT_LE(error, axis_error(lengths, angles, -pi / 4 + pi / 2 * k / 400) + 1e-12);
  }
}

TEST(AligningRotation, TurnsARectangleStraight) {
  const std::vector<double> lengths = {2, 1, 2, 1}, angles = {0.3, 0.3 + pi / 2, 0.3 + pi, 0.3 + 1.5 * pi};
  EXPECT_NEAR(aligning_rotation(lengths, angles), -0.3, 1e-12);
}

}  // namespace
}  // namespace atlas_refine
