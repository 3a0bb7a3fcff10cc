// What the mesh of every result must hold whose charts may have been cut, by its public measures.
#pragma once

#include "output_atlas.h"
#include "refine_checks.h"

namespace atlas_refine::testing {

inline void expect_sound_output(const Atlas& atlas, const RefineResult& result, const RefineOptions& options) {
  const Atlas after = output(atlas, result);
  const Validity validity = validate(after);
  EXPECT_TRUE(validity.valid()) << validity.problem;
  const Measures before = measure(atlas, options.box_aspect), m = measure(after, options.box_aspect);
  EXPECT_TRUE(result.bound_met);
  EXPECT_GE(m.pe_fixed_aspect, options.pe_bound);
  EXPECT_EQ(m.pe, result.after.pe);
  EXPECT_NEAR(m.distortion, result.after.distortion, 1e-6 * m.distortion);
  EXPECT_EQ(m.chart_count, result.after.chart_count);
  EXPECT_GE(m.seam_edges, before.seam_edges);
  EXPECT_GE(m.boundary_length, before.boundary_length - 1e-9);
  EXPECT_GE(result.after.distortion_to_input, 1 - 1e-9);
  if (m.chart_count > 1 && result.gap.value > 0) {
    EXPECT_GE(gap_in_unit(m, result.gap, options.box_aspect), result.gap.value * (1 - 1e-9));
  }
  if (result.intervention == Intervention::Unchanged) return;
  for (const Vec2& uv : after.corner_uvs) {
    EXPECT_GE(uv.minCoeff(), 0);
    EXPECT_LE(uv.maxCoeff(), 1);
  }
}

}  // namespace atlas_refine::testing
