// Charts by themselves are as they would be without a bound.
#include "reduce/relax_apart.h"

#include <gtest/gtest.h>

#include "charts.h"
#include "measure/distortion.h"
#include "sheets.h"

namespace atlas_refine {
namespace {

Chart bent_strip(double turn_rad) { return testing::charts_of(bent_into_arc(sheet(20, 4), turn_rad)).front(); }

TEST(RelaxApart, WhatWasBentIsStraightAgain) {
  const std::vector<Chart> bent = {bent_strip(2), bent_strip(1)};
  ASSERT_GT(dirichlet_sums(bent).best_energy(), 1.02);
  Monitor monitor;
  const std::vector<Chart> relaxed = relaxed_apart(bent, make_objective(bent), {}, {}, monitor);
  testing::expect_certified(relaxed);
  EXPECT_LT(dirichlet_sums(relaxed).best_energy(), 1.001);
}

TEST(RelaxApart, ChartsThatOnlyMoveKeepTheirShapes) {
  const std::vector<Chart> bent = {bent_strip(2), bent_strip(1)};
  Monitor monitor;
  const std::vector<Chart> relaxed = relaxed_apart(bent, make_objective(bent), {}, {Freedom::Moves, Freedom::Bends}, monitor);
  testing::expect_certified(relaxed);
  for (std::size_t v = 0; v < bent[0].uvs.size(); ++v)
    EXPECT_LT(((relaxed[0].uvs[v] - relaxed[0].uvs[0]) - (bent[0].uvs[v] - bent[0].uvs[0])).norm(), 1e-9);
  EXPECT_LT(dirichlet_sums(relaxed[1]).best_energy(), 1.002);
}

}  // namespace
}  // namespace atlas_refine
