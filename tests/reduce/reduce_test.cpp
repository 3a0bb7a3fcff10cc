// The engine on small atlases: the bound, the gap, the box rule, and every way it may end.
#include "reduce/reduce.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "charts.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

using testing::box_sides;
using testing::charts_of;
using testing::energy_as_is;
using testing::expect_certified;
using testing::packing_efficiency;
using testing::with_uvs;

std::vector<Chart> s_chart(double edge_length = 0.08) { return charts_of(shapes::mesh(shapes::s_shape(), edge_length)); }

/// The result is valid, and says of itself what independent measures say of it.
std::vector<Chart> checked(const ReduceProblem& problem, const ReduceResult& result) {
  const std::vector<Chart> after = with_uvs(problem.charts, result.uvs);
  expect_certified(after);
  EXPECT_NEAR(result.energy, energy_as_is(after), 1e-9 * result.energy);
  if (problem.pe_target > 0) {
    EXPECT_NEAR(result.pe, packing_efficiency(after, problem.box_aspect), 1e-9);
    EXPECT_EQ(result.reached, result.pe >= problem.pe_target);
    EXPECT_GE(gap_between_charts(after), problem.gap.length(box_sides(after, problem.box_aspect)) * (1 - 1e-9));
  }
  EXPECT_NEAR(result.distortion, dirichlet_sums(after).best_energy(), 1e-9 * result.distortion);
  return after;
}

TEST(Reduce, TwoSquaresComeAsCloseAsTheGapAllows) {
  // The strip between them is lost; the bound leaves a fifth more than the gap needs.
  for (const Gap gap : {Gap{0.0025}, Gap{0.02}, Gap{0.02, Gap::Unit::LongSide}}) {
    const std::vector<Chart> charts = charts_of(shapes::two_squares(0.3));
    const double strip = gap.length({2, 1}) / 2;
    const ReduceProblem problem{.charts = charts, .gap = gap, .pe_target = 1 - 1.2 * strip};
    const ReduceResult result = reduce_distortion(problem);
    EXPECT_EQ(result.status, ReduceStatus::Converged);
    EXPECT_TRUE(result.reached) << result.pe << " of " << problem.pe_target;
    const std::vector<Chart> after = checked(problem, result);
    EXPECT_LT(gap_between_charts(after), 1.25 * gap.length(box_sides(after)));
  }
}

TEST(Reduce, AspectIsKeptExactly) {
  for (const double aspect : {1.0, 0.5, 2.0}) {
    const std::vector<Chart> charts = s_chart();
    const ReduceProblem problem{.charts = charts, .box_aspect = aspect, .pe_target = 0.75};
    const ReduceResult result = reduce_distortion(problem);
    EXPECT_TRUE(result.reached) << aspect;
    const std::vector<Chart> after = checked(problem, result);
    // PE is taken against the box of the asked aspect; the charts fill it from wall to wall.
    const Vec2 tight = box_sides(after), asked = box_sides(after, aspect);
    EXPECT_NEAR(asked.x(), aspect * asked.y(), 1e-12);
    EXPECT_GT(tight.prod() / asked.prod(), 0.99);
  }
}

TEST(Reduce, ASmallChartStaysInTheHoleOfAnother) {
  const std::vector<Chart> charts = charts_of(shapes::disk_in_ring());
  ASSERT_EQ(charts.size(), 2u);
  const ReduceProblem problem{.charts = charts, .pe_target = 0.85};
  const ReduceResult result = reduce_distortion(problem);
  EXPECT_TRUE(result.reached);
  const std::vector<Chart> after = checked(problem, result);
  const Box ring = uv_box({after[0]}), disk = uv_box({after[1]});
  EXPECT_TRUE((disk.min.array() > ring.min.array()).all());
  EXPECT_TRUE((disk.max.array() < ring.max.array()).all());
}

// The paper's stage 3: the start holds the bound and is distorted.
TEST(Reduce, FromAboveTheTargetDistortionFallsAndTheBoundHolds) {
  Atlas atlas = shapes::mesh(shapes::rectangle(1, 1), 0.1, 1.5);
  for (Vec2& uv : atlas.corner_uvs) uv = {uv.x() * (0.7 + 0.3 * uv.x()), uv.y() * (1.2 - 0.2 * uv.y())};
  const std::vector<Chart> charts = charts_of(atlas);
  const double at_start = energy_as_is(charts);
  for (const double target : {0.9, 0.97}) {
    const ReduceProblem problem{.charts = charts, .pe_target = target};
    double lowest_pe = 1, last = at_start;
    const ReduceResult result = reduce_distortion(problem, [&](const ReduceProgress& progress) {
      lowest_pe = std::min(lowest_pe, progress.pe);
      last = progress.energy;
      return true;
    });
    EXPECT_EQ(result.status, ReduceStatus::Converged);
    EXPECT_TRUE(result.reached);
    EXPECT_GE(lowest_pe, 0.998 * target);  // a step's PE is foreseen to first order; what is kept holds the bound
    EXPECT_GE(result.pe, target);
    EXPECT_LT(last, at_start);
    EXPECT_LT(result.energy, 1 + 0.5 * (at_start - 1));
    checked(problem, result);
  }
}

TEST(Reduce, TheOptimumBelowTheBoundIsFree) {
  const std::vector<Chart> charts = charts_of(shapes::mesh(shapes::rectangle(1, 1), 0.1, 0));
  const ReduceResult result = reduce_distortion({.charts = charts, .pe_target = 0.5});
  EXPECT_TRUE(result.reached);
  EXPECT_NEAR(result.energy, 1, 1e-4);
  EXPECT_NEAR(result.price, 0, 1e-3);
}

TEST(Reduce, WithoutABoxItIsTheChartsOwnOptimum) {
  const std::vector<Chart> charts = s_chart();
  const ReduceProblem problem{.charts = charts};
  const ReduceResult result = reduce_distortion(problem);
  EXPECT_EQ(result.status, ReduceStatus::Converged);
  EXPECT_EQ(result.price, 0);
  checked(problem, result);
  EXPECT_LT(result.energy, energy_as_is(charts));
  const ReduceResult bounded = reduce_distortion({.charts = charts, .pe_target = 0.85});
  EXPECT_GT(bounded.energy, result.energy);
  EXPECT_GT(bounded.price, 0);
}

TEST(Reduce, PriceIsTheSlopeOfEnergyOverLogPe) {
  const std::vector<Chart> charts = s_chart();
  const ReduceResult low = reduce_distortion({.charts = charts, .pe_target = 0.84});
  const ReduceResult high = reduce_distortion({.charts = charts, .pe_target = 0.86});
  const double slope = (high.energy - low.energy) / std::log(high.pe / low.pe);
  EXPECT_NEAR(0.5 * (low.price + high.price), slope, 0.25 * slope);
}

TEST(Reduce, TellsWhereTheObjectiveIsLostAndWhatPushes) {
  const std::vector<Chart> charts = charts_of(shapes::two_squares(0.3));
  const ReduceResult result = reduce_distortion({.charts = charts, .gap = Gap{0.02}, .pe_target = 0.97});
  ASSERT_EQ(result.triangle_energy.size(), charts.size());
  ASSERT_EQ(result.contact_forces.size(), charts.size());
  double sum = 0, area = 0;
  Vec2 push = Vec2::Zero();
  for (std::size_t c = 0; c < charts.size(); ++c) {
    ASSERT_EQ(result.triangle_energy[c].size(), charts[c].triangles.size());
    ASSERT_EQ(static_cast<int>(result.contact_forces[c].size()), charts[c].vertex_count());
    for (std::size_t t = 0; t < charts[c].triangles.size(); ++t) {
      sum += charts[c].surface[t].area * result.triangle_energy[c][t];
      area += charts[c].surface[t].area;
    }
    for (const Vec2& force : result.contact_forces[c]) push += c == 0 ? force : Vec2::Zero();
  }
  EXPECT_NEAR(sum / area, result.energy, 1e-9);
  EXPECT_LT(push.x(), 0);  // the left square is pushed to the left by the other
}

/// The limit keeps the charts from a target that is out of reach within it; what `used` tells of them is most of what is allowed.
void expect_stop_at(const DistortionLimits& limits, double limit, double (*used)(const std::vector<Chart>&)) {
  const std::vector<Chart> charts = s_chart();
  const ReduceProblem problem{.charts = charts, .pe_target = 0.97, .limits = limits};
  const ReduceResult result = reduce_distortion(problem);
  EXPECT_EQ(result.status, ReduceStatus::TooDistorted);
  EXPECT_FALSE(result.reached);
  EXPECT_TRUE(result.within_limit);
  const double is = used(with_uvs(charts, result.uvs));
  EXPECT_LE(is, limit);
  EXPECT_GT(is, 1 + 0.7 * (limit - 1));
  EXPECT_GT(result.pe, packing_efficiency(charts));
  checked(problem, result);
}

TEST(Reduce, StopsAtTheLargestDistortion) {
  expect_stop_at({.distortion = 1.01}, 1.01, [](const std::vector<Chart>& bent) { return dirichlet_sums(bent).best_energy(); });
}

TEST(Reduce, StopsAtTheLargestStretch) {
  expect_stop_at({.stretch = 1.15}, 1.15,
                 [](const std::vector<Chart>& bent) { return stretch_99(bent, dirichlet_sums(bent).best_scale()); });
}

TEST(Reduce, StopsWhereDistortionHasRisenTooFar) {
  const std::vector<Chart> charts = s_chart();
  const ReduceProblem problem{.charts = charts, .pe_target = 0.97, .max_rise = 0.01};
  const ReduceResult result = reduce_distortion(problem);
  EXPECT_EQ(result.status, ReduceStatus::TooExpensive);
  EXPECT_FALSE(result.reached);
  EXPECT_LT(result.pe, 0.97);
  EXPECT_LE(result.least_energy, result.first_energy);
  EXPECT_LT(result.energy, 1.05 * result.least_energy);
  checked(problem, result);
}

TEST(Reduce, StopsWhereDistortionIsEnough) {
  const std::vector<Chart> charts = s_chart();
  const ReduceResult best = reduce_distortion({.charts = charts, .pe_target = 0.8});
  const double enough = 1 + 2 * (best.energy - 1);
  const ReduceResult early = reduce_distortion({.charts = charts, .pe_target = 0.8, .enough_distortion = enough});
  EXPECT_TRUE(early.reached);
  EXPECT_EQ(early.status, ReduceStatus::Enough);
  EXPECT_LE(early.energy, enough);
  EXPECT_LT(early.iterations, best.iterations);
}

TEST(Reduce, ABoundThatTheGapForbidsIsNotReported) {
  const std::vector<Chart> charts = charts_of(shapes::two_squares(0.3));
  const ReduceProblem problem{.charts = charts, .gap = {0.1}, .pe_target = 0.99, .max_iterations = 300};
  const ReduceResult result = reduce_distortion(problem);
  EXPECT_NE(result.status, ReduceStatus::Converged);
  EXPECT_FALSE(result.reached);
  EXPECT_LT(result.pe, 0.99);
  EXPECT_GT(result.pe, packing_efficiency(charts));
  checked(problem, result);
}

TEST(Reduce, WhatFallsTooSlowlyToBeOfUseIsGivenUp) {
  std::vector<Chart> charts = s_chart();
  for (Vec2& uv : charts[0].uvs) uv.x() *= 1e-7;
  const double out_of_reach = 1e-300;
  ReduceProblem problem{.charts = charts, .least_change = 0, .negligible = 0, .most_energy = out_of_reach, .max_iterations = 120};
  const ReduceResult given_up = reduce_distortion(problem);
  EXPECT_EQ(given_up.status, ReduceStatus::OutOfTime);
  EXPECT_LT(given_up.iterations, problem.max_iterations);
  problem.most_energy = 1.1;
  EXPECT_NE(reduce_distortion(problem).status, ReduceStatus::OutOfTime);
}

TEST(Reduce, OutOfTimeKeepsTheBestState) {
  const std::vector<Chart> charts = s_chart();
  const ReduceProblem problem{.charts = charts, .pe_target = 0.9, .max_iterations = 5};
  const ReduceResult result = reduce_distortion(problem);
  EXPECT_EQ(result.status, ReduceStatus::OutOfTime);
  EXPECT_EQ(result.iterations, 5);
  EXPECT_FALSE(result.reached);
  EXPECT_GT(result.pe, packing_efficiency(charts));
  checked(problem, result);
}

TEST(Reduce, AMonitorThatThrowsCancels) {
  const std::vector<Chart> charts = s_chart();
  int calls = 0;
  const auto stop = [&](const ReduceProgress& progress) {
    EXPECT_EQ(progress.iteration, calls);
    if (++calls == 4) throw std::domain_error("enough");
    return true;
  };
  EXPECT_THROW(reduce_distortion({.charts = charts, .pe_target = 0.9}, stop), std::domain_error);
  EXPECT_EQ(calls, 4);
}

TEST(Reduce, AMonitorThatStopsGetsTheBestStateSoFar) {
  const std::vector<Chart> charts = s_chart();
  ReduceProblem problem{.charts = charts, .pe_target = 0.9};
  const auto stop_at_5 = [](const ReduceProgress& progress) { return progress.iteration < 5; };
  const ReduceResult stopped = reduce_distortion(problem, stop_at_5), again = reduce_distortion(problem, stop_at_5);
  EXPECT_EQ(stopped.status, ReduceStatus::Stopped);
  EXPECT_EQ(stopped.iterations, 5);
  EXPECT_FALSE(stopped.reached);
  EXPECT_TRUE(testing::same_bits(stopped.uvs[0], again.uvs[0]));
  checked(problem, stopped);
  const ReduceResult at_once = reduce_distortion(problem, [](const ReduceProgress&) { return false; });
  EXPECT_EQ(at_once.iterations, 0);
  EXPECT_LT(at_once.pe, stopped.pe);
  problem.max_iterations = 5;
  EXPECT_TRUE(testing::same_bits(stopped.uvs[0], reduce_distortion(problem).uvs[0]));
}

TEST(Reduce, TheBitsDoNotDependOnTheThreads) {
  const std::vector<Chart> charts = s_chart(0.018);
  ASSERT_GT(charts[0].triangles.size(), 2100u);  // so many that the work is really shared
  const auto run = [&](int threads) {
    return reduce_distortion({.charts = charts, .pe_target = 0.8, .max_iterations = 12, .threads = threads});
  };
  const ReduceResult one = run(1), two = run(2), again = run(2);
  EXPECT_TRUE(testing::same_bits(one.uvs[0], two.uvs[0]));
  EXPECT_TRUE(testing::same_bits(two.uvs[0], again.uvs[0]));
  EXPECT_EQ(one.iterations, two.iterations);
  EXPECT_EQ(one.price, two.price);
}

// Within a chart borders that are far apart along it end no nearer than the gap, or than they were if that was less.
TEST(Reduce, BordersOfOneChartKeepTheGap) {
  for (const double slot : {0.2, 0.001}) {
    const shapes::Polygon slotted{{{0, 0}, {1, 0}, {1, 0.7}, {0.5 + slot, 1}, {0.5 + slot, 0.3}, {0.5, 0.3}, {0.5, 1}, {0, 0.7}},
                                  {}};
    const std::vector<Chart> charts = charts_of(shapes::mesh(slotted, 0.1));
    const ReduceProblem problem{.charts = charts, .pe_target = 0.95};
    const ReduceResult result = reduce_distortion(problem);
    EXPECT_TRUE(result.reached);
    const std::vector<Chart> after = checked(problem, result);
    const double gap = problem.gap.length(box_sides(after)), far_arc = kFarArc * box_sides(after).norm() * 1.05;
    EXPECT_GE(gap_within_charts(after, far_arc, 1)[0],
              std::min(gap, 0.99 * slot * box_sides(after).norm() / box_sides(charts).norm()));
  }
}

// Charts without any stiffness between them must not fly off (squeeze.md, "Traps", 4).
TEST(Reduce, FreeRigidChartsComeTogether) {
  const std::vector<Chart> charts = charts_of(shapes::squares(9, 0.6));
  const ReduceProblem problem{.charts = charts, .pe_target = 0.7};
  const ReduceResult result = reduce_distortion(problem);
  EXPECT_TRUE(result.reached);
  checked(problem, result);
}

// A gap that is a part of the box shrinks with it: a hundred charts that are pressed by it would take the box to nothing.
TEST(Reduce, ABoxThatWouldSpareAllTheGapDoesNotCollapse) {
  const std::vector<Chart> charts = charts_of(shapes::squares(144, 0.2));
  const double gap = 0.99 * gap_between_charts(charts) / box_sides(charts).maxCoeff();
  const ReduceProblem problem{.charts = charts, .gap = {gap, Gap::Unit::LongSide}, .box_aspect = 1, .pe_target = 0.5};
  std::vector<ReduceProgress> steps;
  const ReduceResult result = reduce_distortion(problem, [&](const ReduceProgress& progress) {
    steps.push_back(progress);
    return true;
  });
  EXPECT_TRUE(result.reached);
  checked(problem, result);
  ASSERT_GT(steps.size(), 1U);
  EXPECT_GT(steps[1].fraction, 0.1);
}

}  // namespace
}  // namespace atlas_refine
