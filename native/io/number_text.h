// Numbers as text: the shortest decimals that read back as the same doubles.
#pragma once

#include <charconv>
#include <string>

namespace atlas_refine::io {

inline void append_number(std::string& out, double value) {
  char digits[32];
  const auto result = std::to_chars(digits, digits + sizeof digits, value);
  out.append(digits, result.ptr);
}

}  // namespace atlas_refine::io
