// What charts are forecast to come to where they are placed anew.
#include <gtest/gtest.h>

#include "atlas_refine/refine.h"
#include "place_and_squeeze.h"
#include "placing.h"
#include "reduce/goal.h"
#include "shapes.h"
#include "sheets.h"
#include "whole.h"

namespace atlas_refine {
namespace {

TEST(ForecastAnew, WhatWasBentIsPlacedAsItWillBe) {
  const Atlas atlas = bent_into_arc(sheet(24, 3), 4);
  const RefineOptions options{.pe_bound = 0.9, .box_aspect = 8};
  const InputAtlas input = read_atlas(atlas, options);
  Monitor monitor;
  Journal journal(monitor, nullptr, options.box_aspect);
  const Refinement run{input, options, monitor, journal, 1, options};
  const auto forecast = forecast_anew(run, whole_charts(run, ProgressRange(0, 1)).atlas);
  ASSERT_TRUE(forecast.has_value());
  EXPECT_LT(forecast->end.outcome.energy, 1.001);
}

TEST(ForecastAnew, StretchIsToldAsWell) {
  const Atlas atlas = shapes::mesh(shapes::s_shape(), 0.1, 0);
  const InputAtlas input = read_atlas(atlas, {});
  Monitor monitor;
  Journal journal(monitor, nullptr, 0);
  const RefineOptions options;
  const Refinement run{input, options, monitor, journal, 1, options};
  const auto forecast = forecast_anew(run, whole_charts(run, ProgressRange(0, 1)).atlas);
  ASSERT_TRUE(forecast.has_value());
  const double stretch = refine(atlas, options).after.stretch_99;
  EXPECT_GT(stretch, 1.05);
  EXPECT_NEAR(forecast->stretch - 1, stretch - 1, 0.5 * (stretch - 1));
}

// In a narrow box with a wide gap it would slide on and on.
TEST(ForecastAnew, ItEndsSoonerThanTheSqueezeThatItIsOf) {
  const Atlas atlas = shapes::mesh(shapes::s_shape(), 0.1, 0.5);
  const RefineOptions options{.pe_bound = 0.9, .box_aspect = 30, .gap = Gap{0.02}};
  const InputAtlas input = read_atlas(atlas, options);
  Monitor monitor;
  Journal journal(monitor, nullptr, options.box_aspect);
  const Refinement run{input, options, monitor, journal, 1, options};
  const CutAtlas whole = whole_charts(run, ProgressRange(0, 1)).atlas;
  const Objective objective = goal_of(input.set.charts, whole, options);
  const SqueezeOptions patient{
      .pe_bound = options.pe_bound, .box_aspect = options.box_aspect, .gaps = {*options.gap}, .least_change = 0, .negligible = 0};
  const auto placer = [&](const std::vector<Chart>& charts, const Objective&) {
    return place(run, charts, {}, *options.gap, options.pe_bound);
  };
  const Forecast forecast = forecast_squeeze(meshes_of(whole), objective, placer, patient, monitor);
  const Squeezed squeezed = squeeze_directly({placer(meshes_of(whole), objective)}, objective, patient, monitor);
  EXPECT_GT(squeezed.iterations, 150);
  EXPECT_LE(forecast.end.iterations, 150);
}

}  // namespace
}  // namespace atlas_refine
