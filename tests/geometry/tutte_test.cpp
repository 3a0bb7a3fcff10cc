// Tutte's embedding of a disk, of charts with holes, and of a chart that overlaps itself.
#include "geometry/tutte.h"

#include <gtest/gtest.h>

#include <cmath>

#include "charts.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

double surface_area(const Chart& chart) {
  double sum = 0;
  for (const RestTriangle& rest : chart.surface) sum += rest.area;
  return sum;
}

class Tutte : public ::testing::TestWithParam<int> {
 protected:
  static Chart chart() {
    switch (GetParam()) {
      case 0:
        return testing::charts_of(shapes::mesh(shapes::s_shape(), 0.06)).front();
      case 1:
        return testing::charts_of(shapes::mesh(shapes::ring(), 0.08)).front();
      case 2:
        return testing::charts_of(shapes::self_overlapping()).front();
      default: {
        shapes::Polygon two_holes = shapes::rectangle(1, 0.6);
        for (const double x : {0.3, 0.7}) {
          const shapes::Polygon hole = shapes::transformed(shapes::disk(0.12, 16), 1, 0, {x, 0.3});
          two_holes.holes.emplace_back(hole.outer.rbegin(), hole.outer.rend());
        }
        return testing::charts_of(shapes::mesh(two_holes, 0.08)).front();
      }
    }
  }
};

TEST_P(Tutte, IsABijectionOntoADiskOfTheSurfacesArea) {
  Chart embedded = chart();
  embedded.uvs = tutte_disk(embedded, fill_by_fans(embedded, longest_loop(embedded)));
  testing::expect_certified({embedded});
  const double radius = std::sqrt(surface_area(embedded) / std::acos(-1));
  double farthest = 0;
  int on_circle = 0;
  for (const Vec2& uv : embedded.uvs) {
    farthest = std::max(farthest, uv.norm());
    if (std::abs(uv.norm() - radius) < 1e-9 * radius) ++on_circle;
  }
  EXPECT_NEAR(farthest, radius, 1e-9 * radius);
  EXPECT_EQ(on_circle, static_cast<int>(embedded.boundary_loops.front().size()));
}

TEST_P(Tutte, IsOneWithHolesFilledAsTheUvsHaveThem) {
  Chart embedded = chart();
  const Filling filling = fill_as_in_uvs(embedded, longest_loop(embedded));
  EXPECT_TRUE(filling.fans.empty());
  EXPECT_EQ(filling.triangles.empty(), embedded.boundary_loops.size() == 1);
  embedded.uvs = tutte_disk(embedded, filling);
  testing::expect_certified({embedded});
}

INSTANTIATE_TEST_SUITE_P(DiskRingOverlapTwoHoles, Tutte, ::testing::Range(0, 4));

}  // namespace
}  // namespace atlas_refine
