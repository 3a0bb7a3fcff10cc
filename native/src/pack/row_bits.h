// Bits of a bitmap's row.
#pragma once

#include <cstdint>

namespace atlas_refine {

/// 64 bits of a row from bit `at` on; the row has a spare word at its end.
inline std::uint64_t bits_from(const std::uint64_t* row, int at) {
  const int word = at >> 6, shift = at & 63;
  return shift == 0 ? row[word] : (row[word] >> shift) | (row[word + 1] << (64 - shift));
}

}  // namespace atlas_refine
