// Which vertices lie where others are mirrored to.
#include "needed/mirror_image.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "sheets.h"

namespace atlas_refine {
namespace {

/// Columns 0 to 6, rolled up about the middle one.
Atlas gutter() {
  Atlas out = sheet(6, 4);
  for (Vec3& p : out.positions) p.z() = (p.x() - 0.3) * (p.x() - 0.3) + 0.3 * p.y() * p.y();
  return out;
}

struct Mirrored {
  Atlas atlas;
  ChartSet set = split_charts(atlas);
  MirrorImage image{atlas, set};

  explicit Mirrored(Atlas mesh) : atlas(std::move(mesh)) {}

  /// Of the vertex of the first face's first corner, as its place in the UVs.
  std::optional<Vec2> of_corner(int corner) const {
    const auto found = image.of(set.corners[corner]);
    if (!found) return std::nullopt;
    return set.charts[found->chart].uvs[found->vertex];
  }
};

TEST(MirrorImage, EveryVertexOfASymmetricSheetHasOne) {
  const Mirrored mirrored(gutter());
  for (int c = 0; c < mirrored.atlas.corner_count(); ++c) {
    const Vec2 at = mirrored.atlas.corner_uvs[c];
    const auto image = mirrored.of_corner(c);
    ASSERT_TRUE(image.has_value());
    EXPECT_NEAR((*image - Vec2(0.6 - at.x(), at.y())).norm(), 0, 1e-9);
  }
}

TEST(MirrorImage, ThePlaneMayLieAtASlant) {
  Atlas atlas = gutter();
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(0.7, Vec3::UnitZ()) * Eigen::AngleAxisd(0.4, Vec3::UnitX())).toRotationMatrix();
  for (Vec3& p : atlas.positions) p = turn * p + Vec3(1, 2, 3);
  const Mirrored mirrored(atlas);
  const auto image = mirrored.of_corner(0);
  ASSERT_TRUE(image.has_value());
  EXPECT_NEAR((*image - Vec2(0.6, 0)).norm(), 0, 1e-9);
}

// A flat mesh lies in a plane that each of its vertices is its own image by.
TEST(MirrorImage, ThePlaneOfAFlatMeshIsNone) {
  const Mirrored mirrored(sheet(6, 4));
  const auto image = mirrored.of_corner(0);
  ASSERT_TRUE(image.has_value());
  EXPECT_GT((*image - mirrored.atlas.corner_uvs[0]).norm(), 0.1);
}

TEST(MirrorImage, ASurfaceWithoutSymmetryHasNone) {
  Atlas atlas = gutter();
  for (std::size_t k = 0; k < atlas.positions.size(); ++k)
    atlas.positions[k].z() += 0.01 * std::sin(7.0 * static_cast<double>(k));
  const Mirrored mirrored(atlas);
  for (int c = 0; c < atlas.corner_count(); ++c) EXPECT_FALSE(mirrored.of_corner(c).has_value());
}

// Where a few vertices were moved the rest is as it was.
TEST(MirrorImage, AFewVerticesMayHaveNone) {
  Atlas atlas = gutter();
  atlas.positions[34].z() += 0.05;  // of the last row, next to the first corner of the sheet's image
  const Mirrored mirrored(atlas);
  int with = 0;
  for (int c = 0; c < atlas.corner_count(); ++c) with += mirrored.of_corner(c).has_value();
  EXPECT_LT(with, atlas.corner_count());
  EXPECT_GT(with, atlas.corner_count() / 2);
}

}  // namespace
}  // namespace atlas_refine
