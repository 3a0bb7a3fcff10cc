// Numbers as OBJ files have them.
#include "io/read_number.h"

#include <charconv>
#include <cstdlib>
#include <limits>
#include <string>

namespace atlas_refine::io {

namespace {

bool is_not_finite_on_windows(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  const std::size_t mark = text.find(".#");
  if (mark != 1) return false;
  text.remove_prefix(mark + 2);
  return text.starts_with("IND") || text.starts_with("QNAN") || text.starts_with("SNAN") || text.starts_with("INF");
}

}  // namespace

std::optional<double> read_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  if (is_not_finite_on_windows(text)) return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) return std::nullopt;
  // from_chars does not tell an overflow from an underflow.
  return error == std::errc() ? value : std::strtod(std::string(text).c_str(), nullptr);
}

}  // namespace atlas_refine::io
