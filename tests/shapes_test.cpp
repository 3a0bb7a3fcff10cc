// The test shapes are what they say: positive faces, the polygon's area, curved surfaces, and the same bits every time.
#include "shapes.h"

#include <gtest/gtest.h>

namespace atlas_refine::shapes {
namespace {

double uv_area(const Atlas& atlas, int face) {
  double twice = 0;
  const int begin = atlas.face_offsets[face], end = atlas.face_offsets[face + 1];
  for (int c = begin; c < end; ++c) {
    const Vec2 &a = atlas.corner_uvs[c], &b = atlas.corner_uvs[c + 1 < end ? c + 1 : begin];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

double uv_area(const Atlas& atlas) {
  double sum = 0;
  for (int f = 0; f < atlas.face_count(); ++f) sum += uv_area(atlas, f);
  return sum;
}

int negative_faces(const Atlas& atlas) {
  int count = 0;
  for (int f = 0; f < atlas.face_count(); ++f) count += uv_area(atlas, f) <= 0;
  return count;
}

void expect_meshed(const Polygon& polygon, const std::string& name) {
  const Atlas atlas = mesh(polygon);
  EXPECT_EQ(negative_faces(atlas), 0) << name;
  EXPECT_NEAR(uv_area(atlas), area(polygon), 1e-9) << name;
  EXPECT_GT(atlas.face_count(), 100) << name;
}

TEST(Shapes, MeshesFillTheirPolygons) {
  for (const Named& shape : named_polygons()) expect_meshed(shape.polygon, shape.name);
  for (int seed = 0; seed < 50; ++seed) {
    expect_meshed(random_polygon(seed), "random " + std::to_string(seed));
    expect_meshed(random_star_polygon(seed), "random star " + std::to_string(seed));
  }
}

TEST(Shapes, AtlasesOfSeveralChartsArePositive) {
  for (const Atlas& atlas : {two_squares(0.1), squares(30), disk_in_ring(), touching_charts(), quad_grid(5, 4), quad_band(9, 2),
                             honeycomb(4, 3), self_overlapping()}) {
    EXPECT_EQ(negative_faces(atlas), 0);
  }
}

TEST(Shapes, AwkwardOnesAreAwkward) {
  const Atlas plain = mesh(star());
  EXPECT_EQ(negative_faces(mirrored(plain)), plain.face_count());
  EXPECT_GT(negative_faces(with_flipped_face(plain)), 0);
  EXPECT_LT(negative_faces(with_flipped_face(plain)), 5);
}

TEST(Shapes, SameArgumentsSameBits) {
  const Atlas a = mesh(random_polygon(5)), b = mesh(random_polygon(5));
  EXPECT_EQ(a.corner_vertices, b.corner_vertices);
  EXPECT_EQ(a.corner_uvs, b.corner_uvs);
  EXPECT_EQ(a.positions, b.positions);
}

}  // namespace
}  // namespace atlas_refine::shapes
