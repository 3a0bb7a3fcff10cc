// Charts of generated atlases and the checks that most tests of placed charts need.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "input/split_charts.h"
#include "measure/certificate.h"
#include "measure/distortion.h"

namespace atlas_refine::testing {

inline std::vector<Chart> charts_of(const Atlas& atlas) { return split_charts(atlas).charts; }

inline std::vector<Chart> with_uvs(std::vector<Chart> charts, const std::vector<std::vector<Vec2>>& uvs) {
  for (std::size_t c = 0; c < charts.size(); ++c) charts[c].uvs = uvs[c];
  return charts;
}

inline void expect_certified(const std::vector<Chart>& charts) {
  const Validity validity = certify_charts(charts);
  EXPECT_TRUE(validity.valid()) << validity.problem;
}

inline Vec2 box_sides(const std::vector<Chart>& charts, double aspect = 0) {
  return box_of_aspect(uv_box(charts), aspect).size();
}

inline double packing_efficiency(const std::vector<Chart>& charts, double aspect = 0) {
  return uv_area(charts) / box_sides(charts, aspect).prod();
}

/// E_d at the scale that the charts have.
inline double energy_as_is(const std::vector<Chart>& charts) {
  const DirichletSums sums = dirichlet_sums(charts);
  return (sums.dirichlet + sums.inverse) / (4 * sums.area);
}

inline bool same_bits(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec2)) == 0;
}

}  // namespace atlas_refine::testing
