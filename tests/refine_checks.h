// What every result of refine() must hold, by measures that are independent of the engine's own.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "atlas_refine/refine.h"
#include "input/split_charts.h"
#include "measure/distortion.h"

namespace atlas_refine::testing {

inline Atlas with_corner_uvs(Atlas atlas, const std::vector<Vec2>& uvs) {
  atlas.corner_uvs = uvs;
  return atlas;
}

/// Whether one of the warnings or fallbacks has these words.
inline bool says(const std::vector<std::string>& lines, const std::string& words) {
  return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) { return line.find(words) != std::string::npos; });
}

/// The gap of measured charts as a fraction of the unit of `gap`, on the box that `aspect` asks for.
inline double gap_in_unit(const Measures& m, const Gap& gap, double aspect) {
  const Vec2 tight(m.box_width * (aspect > 0 ? aspect : 1), m.box_height);
  const Vec2 asked = box_of_aspect({Vec2::Zero(), tight}, aspect).size();
  return m.gap_between * tight.norm() / (gap.length(asked) / gap.value);
}

inline void expect_sound(const Atlas& atlas, const RefineResult& result, const RefineOptions& options) {
  const Atlas after = with_corner_uvs(atlas, result.corner_uvs);
  const Validity validity = validate(after);
  EXPECT_TRUE(validity.valid()) << validity.problem;
  const Measures before = measure(atlas, options.box_aspect), m = measure(after, options.box_aspect);
  if (result.bound_met) {
    EXPECT_GE(m.pe_fixed_aspect, options.pe_bound);
  }
  EXPECT_EQ(m.seam_edges, before.seam_edges);
  if (options.stacks == Stacks::Keep) {
    EXPECT_EQ(m.chart_count, before.chart_count);
  }
  EXPECT_NEAR(m.boundary_length, before.boundary_length, 1e-9);
  if (m.chart_count > 1 && result.gap.value > 0) {
    EXPECT_GE(gap_in_unit(m, result.gap, options.box_aspect), result.gap.value * (1 - 1e-9));
  }
  EXPECT_EQ(m.pe, result.after.pe);
  EXPECT_EQ(m.distortion, result.after.distortion);
  EXPECT_EQ(static_cast<int>(result.charts.size()), m.chart_count);
  const bool gap_warning = std::any_of(result.warnings.begin(), result.warnings.end(),
                                       [](const std::string& text) { return text.starts_with("the gap was reduced"); });
  EXPECT_EQ(gap_warning, !options.gap && result.gap.value < Gap{}.value && result.intervention != Intervention::Unchanged);
  if (result.intervention == Intervention::Unchanged) return;
  Vec2 low = result.corner_uvs.front(), high = low;
  for (const Vec2& uv : result.corner_uvs) {
    low = low.cwiseMin(uv);
    high = high.cwiseMax(uv);
  }
  EXPECT_EQ(low, Vec2(0, 0));
  EXPECT_LE(high.maxCoeff(), 1);
}

/// Refines and checks; the options' bound must be met.
inline RefineResult refine_soundly(const Atlas& atlas, const RefineOptions& options) {
  RefineResult result;
  try {
    result = refine(atlas, options);
  } catch (const RefineError& error) {
    ADD_FAILURE() << to_string(error.code()) << ": " << error.what();
    result.corner_uvs = atlas.corner_uvs;
    result.charts.resize(1);
    return result;
  }
  EXPECT_TRUE(result.bound_met);
  expect_sound(atlas, result, options);
  return result;
}

/// The error that refine() must throw.
inline RefineError refusal(const Atlas& atlas, const RefineOptions& options = {}) {
  try {
    refine(atlas, options);
  } catch (const RefineError& error) {
    return error;
  }
  ADD_FAILURE() << "refine() must throw";
  return {ErrorCode::BadInput, "", ""};
}

}  // namespace atlas_refine::testing
