// How much the packer's searches may work.
#pragma once

#include <cstdint>

namespace atlas_refine {

/// A budget of row words looked at. A fuzzer wants many packings, not good ones.
constexpr std::int64_t budget(std::int64_t words) {
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
  return words / 50;
#else
  return words;
#endif
}

}  // namespace atlas_refine
