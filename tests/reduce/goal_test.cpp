// What pieces are to become: one density or each its own, reference shapes, importance that only compares.
#include "reduce/goal.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numeric>

#include "charts.h"
#include "shapes.h"
#include "small_atlases.h"

namespace atlas_refine {
namespace {

using testing::charts_of;

std::vector<Chart> of_two_scales() {
  const shapes::Polygon star = shapes::star();
  Atlas large = shapes::mesh(star, 0.1, 0);
  for (Vec2& uv : large.corner_uvs) uv = 3 * uv + Vec2(4, 0);
  return charts_of(shapes::combine({shapes::mesh(star, 0.1, 0), large}));
}

double energy(const Objective& objective, const std::vector<Chart>& charts) {
  double sum = 0;
  std::size_t t = 0;
  for (const Chart& chart : charts) {
    for (const Triangle& v : chart.triangles) {
      const auto at = [&](int k) -> Vec2 { return chart.uvs[v[k]] / objective.unit; };
      Mat2 edges;
      edges << at(1) - at(0), at(2) - at(0);
      const Mat2 j = edges * objective.inverse_edges[t];
      sum += objective.weight[t++] * 0.25 * (j.squaredNorm() + j.inverse().squaredNorm());
    }
  }
  return sum;
}

TEST(Goal, EqualScalesTheUvs) {
  std::vector<Chart> charts = of_two_scales();
  const auto wanted = wanted_density(charts, Density::Equal);
  EXPECT_TRUE(set_density(charts, wanted, Density::Equal));
  EXPECT_NEAR(uv_area(charts[0]), uv_area(charts[1]), 1e-9);
  for (const Chart& chart : charts) EXPECT_NEAR(dirichlet_sums(chart).best_scale(), 1, 1e-12);
  EXPECT_FALSE(set_density(charts, wanted, Density::Equal));
}

TEST(Goal, KeepWantsEachChartsOwnDensityWhateverBecameOfIt) {
  const std::vector<Chart> before = of_two_scales();
  const auto wanted = wanted_density(before, Density::Keep);
  EXPECT_NEAR(wanted[1] / wanted[0], 3, 1e-9);
  std::vector<Chart> charts = before;
  EXPECT_FALSE(set_density(charts, wanted, Density::Keep));
  for (Vec2& uv : charts[0].uvs) uv *= 100;  // embedded anew, in model units
  EXPECT_TRUE(set_density(charts, wanted, Density::Keep));
  EXPECT_NEAR(uv_area(charts[1]) / uv_area(charts[0]), 9, 1e-9);
  EXPECT_NEAR(uv_area(charts), before[0].surface.area() + before[1].surface.area(), 1e-9);
  const Objective objective = goal_of(before, whole_atlas(charts), {.density = Density::Keep});
  EXPECT_NEAR(energy(objective, charts), 1, 1e-9);
}

TEST(Goal, ChartsThatAreMostlyFlippedAreToHaveTheMeanDensity) {
  std::vector<Chart> charts = of_two_scales();
  const auto alone = wanted_density(charts, Density::Keep);
  charts.push_back(charts[0]);
  for (Vec2& uv : charts[2].uvs) uv.x() *= -1e-3;
  const auto wanted = wanted_density(charts, Density::Keep);
  EXPECT_NEAR(wanted[0], alone[0], 1e-12);
  EXPECT_NEAR(wanted[1], alone[1], 1e-12);
  EXPECT_EQ(wanted[2], 1);
}

TEST(Goal, ChartsWhoseUvsHaveNoShapeAreToHaveTheMeanDensity) {
  std::vector<Chart> charts = of_two_scales();
  const auto alone = wanted_density(charts, Density::Keep);
  const auto slivers = charts_of(flat_atlas({{0, 0, 0}, {1, 0, 0}, {1, 1e-6, 0}, {0, 1e-6, 0}}, {{0, 1, 2}, {0, 2, 3}}));
  for (const double crossed : {0.0, 0.1}) {
    charts.resize(2);
    charts.push_back(slivers[0]);
    charts[2].uvs = {{0, 0}, {0.1, 0}, {0.1, 0.1}, {crossed, -0.1 * crossed}};  // as wide as it is long, one face flipped or not
    const auto wanted = wanted_density(charts, Density::Keep);
    EXPECT_NEAR(wanted[0], alone[0], 1e-12);
    EXPECT_EQ(wanted[2], 1);
  }
}

TEST(Goal, AStrayVertexTellsNothingOfTheDensityButAMapThatVariesDoes) {
  std::vector<Chart> charts = of_two_scales();
  const auto alone = wanted_density(charts, Density::Keep);
  std::vector<Chart> stray = charts;
  stray[1].uvs[stray[1].boundary_loops[0][0]] += Vec2(30, 0);
  const auto strayed = wanted_density(stray, Density::Keep);
  EXPECT_NEAR(strayed[1] / strayed[0], alone[1] / alone[0], 0.1 * alone[1] / alone[0]);
  for (Vec2& uv : charts[1].uvs) uv.x() = std::max(uv.x(), 20 * uv.x() - 19 * 0.7 * uv_box({of_two_scales()[1]}).max.x());
  const auto varied = wanted_density(charts, Density::Keep);
  EXPECT_NEAR(varied[1] / varied[0], texel_density(charts[1]) / texel_density(charts[0]), 1e-9);
}

TEST(Goal, TheInputAsReferenceLeavesTheDensityToItsOption) {
  std::vector<Chart> charts = of_two_scales();
  for (Vec2& uv : charts[0].uvs) uv.x() *= 1.5;
  const std::vector<Chart> input = charts;
  for (const Density density : {Density::Equal, Density::Keep}) {
    charts = input;
    const auto wanted = wanted_density(input, density);
    set_density(charts, wanted, Density::Keep);  // to the wanted areas
    const Objective objective = goal_of(input, whole_atlas(charts), {.density = density, .reference = Reference::Input});
    EXPECT_NEAR(energy(objective, charts), 1, 1e-9);
  }
}

TEST(Goal, UniformImportanceChangesNothing) {
  const std::vector<Chart> charts = of_two_scales();
  const Objective plain = goal_of(charts, whole_atlas(charts), {});
  EXPECT_NEAR(std::accumulate(plain.weight.begin(), plain.weight.end(), 0.0), 1, 1e-12);
  for (const double weight : {1e-4, 1.0, 1e6}) {
    RefineOptions options;
    options.importance.assign(10000, weight);
    const Objective objective = goal_of(charts, whole_atlas(charts), options);
    for (std::size_t t = 0; t < plain.weight.size(); ++t)
      EXPECT_NEAR(objective.weight[t], plain.weight[t], 1e-12 * plain.weight[t]);
  }
}

TEST(Goal, TinyTrianglesWeighAThousandthOfTheMeanOneUnlessTheyAreUnimportant) {
  const double tiny = 1e-4;
  const std::vector<Chart> charts =
      charts_of(flat_atlas({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1 + tiny, 0, 0}, {1 + tiny, tiny, 0}},
                           {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}}));
  const auto weight_of_tiny = [&](double importance) {
    RefineOptions options;
    options.importance = {1, 1, importance, 1};
    return goal_of(charts, whole_atlas(charts), options).weight[2];
  };
  EXPECT_NEAR(weight_of_tiny(1), 1e-3 / 4, 1e-6);
  EXPECT_NEAR(weight_of_tiny(1e-3), 1e-6 / 4, 1e-9);
}

}  // namespace
}  // namespace atlas_refine
