// One Newton step: assembly against the energy, damping until positive definite, line search, step limits.
#include "solve/newton.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "charts.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

struct Bent {
  std::vector<Chart> charts = testing::charts_of(shapes::mesh(shapes::star(), 0.2, 0.8));
  Objective objective = make_objective(charts);
  std::vector<Vec2> x;
  BlockSystem system;
  Bent() {
    for (const Vec2& uv : charts[0].uvs) x.emplace_back((uv.x() * (1 + 0.3 * uv.x())) / objective.unit, uv.y() / objective.unit);
    system.matrix.analyse(static_cast<int>(x.size()), triangle_sides(charts[0].triangles));
    system.set_zero();
    add_dirichlet(objective, charts[0].triangles, triangle_slots(system.matrix, charts[0].triangles), x, 1, system);
  }
};

TEST(Newton, GradientIsTheSlopeOfTheEnergyAndStepsReduceIt) {
  Bent bent;
  const auto energy = [&](const std::vector<Vec2>& x) { return dirichlet_energy(bent.objective, bent.charts[0].triangles, x); };
  const auto damping = factor_damped(bent.system, std::vector<double>(bent.x.size(), 1.0), {1e-9, 100, 1e3});
  ASSERT_TRUE(damping);
  const std::vector<Vec2> step = newton_direction(bent.system);
  const double slope = dot(bent.system.gradient, step);
  EXPECT_LT(slope, 0);
  const auto at = [&](double t) {
    std::vector<Vec2> moved = bent.x;
    for (std::size_t v = 0; v < moved.size(); ++v) moved[v] += t * step[v];
    return moved;
  };
  constexpr double kStep = 1e-6;
  EXPECT_NEAR((energy(at(kStep)) - energy(at(-kStep))) / (2 * kStep), slope, 1e-5 * std::abs(slope));
  const double limit = flip_free_fraction(bent.charts[0].triangles, bent.x, step, 1, 0.9);
  const double taken = line_search(limit, energy(bent.x), slope, [&](double t) { return energy(at(t)); });
  EXPECT_GT(taken, 0);
  EXPECT_LT(energy(at(taken)), energy(bent.x));
}

TEST(Newton, EnergiesOfTrianglesAddUp) {
  const Bent bent;
  const auto energies = triangle_energies(bent.objective, bent.charts[0].triangles, bent.x);
  double sum = 0;
  for (std::size_t t = 0; t < energies.size(); ++t) sum += bent.objective.weight[t] * energies[t];
  EXPECT_NEAR(sum, dirichlet_energy(bent.objective, bent.charts[0].triangles, bent.x), 1e-12);
}

TEST(Newton, DampingRisesUntilTheMatrixIsPositiveDefiniteOrTooMuch) {
  BlockSystem system;
  system.matrix.analyse(2, {{0, 1}});
  const auto set = [&] {
    system.set_zero();
    system.matrix.diagonal[0] = system.matrix.diagonal[1] = -5 * Mat2::Identity();
  };
  set();
  const auto damping = factor_damped(system, {1, 1}, {1e-3, 10, 1e3});
  ASSERT_TRUE(damping);
  EXPECT_GT(*damping, 5);
  set();
  EXPECT_FALSE(factor_damped(system, {1, 1}, {1e-3, 10, 1}));
}

TEST(Newton, LineSearchHalvesUntilArmijoHoldsAndGivesUp) {
  EXPECT_EQ(line_search(1, 0, -1, [](double t) { return t > 0.3 ? std::numeric_limits<double>::infinity() : -t; }), 0.25);
  EXPECT_EQ(line_search(0.8, 0, -1, [](double t) { return -t; }), 0.8);
  EXPECT_EQ(line_search(1, 0, -1, [](double) { return 1.0; }), 0);
}

TEST(Newton, StepBoundsGiveTheirLeast) {
  EXPECT_EQ((StepBounds{{0.5, 0.2, 1}}).least(), 0.2);
  EXPECT_EQ(StepBounds{}.least(), 1);
}

}  // namespace
}  // namespace atlas_refine
