// Charts that need a repair, and what the repair does to them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "charts.h"
#include "repair/repair_charts.h"
#include "shapes.h"

namespace atlas_refine::testing {

inline RepairedCharts repaired(const std::vector<Chart>& charts, RepairOptions options = {}) {
  Monitor monitor;
  return repair_charts(charts, options, monitor);
}

/// The repair of the atlas' only chart that needs one; all charts must be valid by themselves then.
inline ChartRepair only_repair(const Atlas& atlas, const RepairOptions& options = {}) {
  const std::vector<Chart> charts = charts_of(atlas);
  const RepairedCharts one = repaired(charts, options);
  EXPECT_TRUE(one.unmended.empty()) << one.unmended.front().reason;
  EXPECT_EQ(one.repairs.size(), 1u);
  for (const Chart& chart : meshes_of(one.atlas)) expect_certified({chart});
  RepairOptions more = options;
  more.threads = 4;
  const std::vector<Chart> again = meshes_of(repaired(charts, more).atlas);
  for (std::size_t c = 0; c < again.size(); ++c) EXPECT_TRUE(same_bits(again[c].uvs, one.atlas.pieces[c].mesh.uvs));
  return one.repairs.empty() ? ChartRepair{} : one.repairs.front();
}

/// The corners of the faces at the vertex nearest to `at` in the UV plane, moved together.
inline Atlas with_vertex_moved(Atlas atlas, const Vec2& at, const Vec2& by) {
  const auto nearest = std::min_element(atlas.corner_uvs.begin(), atlas.corner_uvs.end(), [&](const Vec2& a, const Vec2& b) {
    return (a - at).squaredNorm() < (b - at).squaredNorm();
  });
  const Vec2 old = *nearest;
  std::replace(atlas.corner_uvs.begin(), atlas.corner_uvs.end(), old, Vec2(old + by));
  return atlas;
}

}  // namespace atlas_refine::testing
