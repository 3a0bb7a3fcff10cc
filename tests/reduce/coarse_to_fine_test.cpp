// The squeeze from coarse to fine against the direct one.
#include <gtest/gtest.h>

#include "charts.h"
#include "reduce/squeeze.h"
#include "shapes.h"

namespace atlas_refine {
namespace {

using testing::charts_of;

constexpr double kFine = 0.014;

SqueezeOptions options_at(double pe_bound) { return {.pe_bound = pe_bound, .gaps = {Gap{}}}; }

void expect_the_same_optimum(const std::vector<Chart>& charts, const SqueezeOptions& options) {
  Monitor monitor;
  const Objective objective = make_objective(charts);
  const Squeezed direct = squeeze_directly({{charts}}, objective, options, monitor);
  const Squeezed fast = squeeze({{charts}}, objective, options, monitor);
  ASSERT_TRUE(direct.outcome.reached && fast.outcome.reached);
  EXPECT_FALSE(testing::same_bits(fast.outcome.uvs[0], direct.outcome.uvs[0]));  // it did go another way
  EXPECT_LE(fast.outcome.energy, direct.outcome.energy + 3e-4);
  const std::vector<Chart> after = testing::with_uvs(charts, fast.outcome.uvs);
  testing::expect_certified(after);
  EXPECT_GE(testing::packing_efficiency(after), options.pe_bound);
  if (charts.size() > 1) {
    EXPECT_GE(gap_between_charts(after), fast.gap.length(testing::box_sides(after)) * (1 - 1e-9));
  }
}

TEST(CoarseToFine, AnEndIsAStartThatIsThereAlready) {
  std::vector<Chart> charts = charts_of(shapes::mesh(shapes::u_shape(), 0.05));
  const ReduceResult first = reduce_distortion({.charts = charts, .gap = Gap{}, .pe_target = 0.8});
  charts[0].uvs = first.uvs[0];
  const ReduceResult second = reduce_distortion({.charts = charts, .gap = Gap{}, .pe_target = 0.8, .warm = first.end});
  EXPECT_EQ(second.status, ReduceStatus::Converged);
  EXPECT_LE(second.iterations, 5);
  EXPECT_NEAR(second.energy, first.energy, 1e-5);
  EXPECT_TRUE(second.reached);
}

TEST(CoarseToFine, EndsAtTheOptimumOfTheDirectSqueeze) {
  expect_the_same_optimum(charts_of(shapes::mesh(shapes::u_shape(), kFine)), options_at(0.8));
  expect_the_same_optimum(charts_of(shapes::mesh(shapes::star(), kFine)), options_at(0.6));
}

TEST(CoarseToFine, OfTwoStartsTheBetterOneIsTaken) {
  const std::vector<Chart> good = charts_of(shapes::mesh(shapes::u_shape(), kFine));
  std::vector<Chart> bad = good;  // aslant
  for (Vec2& uv : bad[0].uvs) uv = Vec2(uv.x() - uv.y(), uv.x() + uv.y());
  Monitor monitor;
  const Objective objective = make_objective(good);
  const Squeezed alone = squeeze({{good}}, objective, options_at(0.8), monitor);
  const Squeezed both = squeeze({{bad}, {good}}, objective, options_at(0.8), monitor);
  ASSERT_TRUE(both.outcome.holds());
  EXPECT_LE(both.outcome.energy, alone.outcome.energy + 1e-4);
  EXPECT_GT(both.iterations, alone.iterations);
  const Squeezed worse = squeeze({{bad}}, objective, options_at(0.8), monitor);
  EXPECT_GT(worse.outcome.energy, alone.outcome.energy + 2e-4);
}

TEST(CoarseToFine, TakesHolesAndSeveralCharts) {
  expect_the_same_optimum(charts_of(shapes::mesh(shapes::ring(), kFine)), options_at(0.65));
  expect_the_same_optimum(
      charts_of(shapes::combine({shapes::mesh(shapes::c_shape(), kFine),
                                 shapes::mesh(shapes::transformed(shapes::star(), 1, 0.3, {1.3, 0.1}), kFine),
                                 shapes::mesh(shapes::transformed(shapes::disk(0.1), 1, 0, {0.5, 1}), 0.05)})),
      options_at(0.6));
}

TEST(CoarseToFine, KeepsTheShapesOfChartsThatOnlyMove) {
  const std::vector<Chart> charts = charts_of(shapes::combine(
      {shapes::mesh(shapes::c_shape(), kFine), shapes::mesh(shapes::transformed(shapes::star(), 1, 0.3, {1.3, 0.1}), kFine)}));
  SqueezeOptions options = options_at(0.45);
  options.freedom = {Freedom::Bends, Freedom::Moves};
  expect_the_same_optimum(charts, options);
  Monitor monitor;
  const std::vector<Vec2> moved = squeeze({{charts}}, make_objective(charts), options, monitor).outcome.uvs[1];
  for (std::size_t v = 0; v < moved.size(); ++v)
    EXPECT_LT(((moved[v] - moved[0]) - (charts[1].uvs[v] - charts[1].uvs[0])).norm(), 1e-9);
}

TEST(CoarseToFine, AForecastTellsWhatTheChartsComeToFromThere) {
  const std::vector<Chart> charts = charts_of(shapes::mesh(shapes::u_shape(), kFine));
  const Objective objective = make_objective(charts);
  Monitor monitor;
  const auto where_they_lie = [](const std::vector<Chart>& placed, const Objective&) { return PlacedCharts{.charts = placed}; };
  const Forecast forecast = forecast_squeeze(charts, objective, where_they_lie, options_at(0.8), monitor);
  ASSERT_TRUE(forecast.end.outcome.holds());
  double lost = 0;
  for (const Forecast::Loss& loss : forecast.losses) lost += loss.amount;
  EXPECT_NEAR(lost, forecast.end.outcome.energy - 1, 1e-5);  // coarse triangles weigh what theirs have lost at least
  const auto squeezed = squeeze_as_forecast(charts, objective, forecast, options_at(0.8), monitor);
  ASSERT_TRUE(squeezed.has_value());
  ASSERT_TRUE(squeezed->outcome.holds());
  EXPECT_NEAR(squeezed->outcome.energy, forecast.end.outcome.energy, 0.1 * lost);
  EXPECT_EQ(squeezed->rough_energy, forecast.end.outcome.energy);
  const std::vector<Chart> after = testing::with_uvs(charts, squeezed->outcome.uvs);
  testing::expect_certified(after);
  EXPECT_GE(testing::packing_efficiency(after), 0.8);
}

TEST(CoarseToFine, TheBitsDoNotDependOnTheThreads) {
  const std::vector<Chart> charts = charts_of(shapes::mesh(shapes::comb(), kFine));
  const auto run = [&](int threads) {
    Monitor monitor;
    SqueezeOptions options = options_at(0.8);
    options.threads = threads;
    return squeeze({{charts}, {charts}}, make_objective(charts), options, monitor).outcome.uvs[0];
  };
  const std::vector<Vec2> one = run(1);
  EXPECT_TRUE(testing::same_bits(one, run(2)));
  EXPECT_TRUE(testing::same_bits(one, run(8)));
  EXPECT_TRUE(testing::same_bits(one, run(1)));
  Monitor monitor;
  const Squeezed direct = squeeze_directly({{charts}, {charts}}, make_objective(charts), options_at(0.8), monitor);
  EXPECT_FALSE(testing::same_bits(one, direct.outcome.uvs[0]));  // it did go another way
}

}  // namespace
}  // namespace atlas_refine
