// A value by its rank among others.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace atlas_refine {

/// The value that `part` of them, in [0, 1), come before; the upper one of two. There must be a value.
inline double quantile(std::vector<double> values, double part) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

}  // namespace atlas_refine
