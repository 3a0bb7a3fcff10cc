// Files of one number for each face.
#include "importance_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "io/input_file.h"

namespace atlas_refine::cli {

namespace {

bool is_separator(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// `wrong` says in a few words why a number is not allowed, or nullptr.
std::vector<double> read_numbers(const std::filesystem::path& path, int face_count, const char* (*wrong)(double)) {
  const std::string text = io::read_text(path, "a file of numbers");
  std::vector<double> values;
  int line = 1;
  const auto refuse = [&](const std::string& what) { throw io::InputError(path, "line " + std::to_string(line) + ": " + what); };
  for (auto at = text.begin(); at != text.end();) {
    if (is_separator(*at)) {
      line += *at == '\n' || (*at == '\r' && (at + 1 == text.end() || at[1] != '\n'));
      ++at;
      continue;
    }
    const auto end = std::find_if(at, text.end(), is_separator);
    const std::string_view token(at, end);
    double value = 0;
    const auto [stop, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (error != std::errc() || stop != token.data() + token.size() || !std::isfinite(value))
      refuse(io::quoted(token) + " is not a number");
    if (const char* must = wrong(value)) refuse(std::string(must) + ", not " + io::quoted(token));
    values.push_back(value);
    if (values.size() > static_cast<std::size_t>(face_count))
      refuse("more numbers than faces, there are " + std::to_string(face_count));
    at = end;
  }
  if (values.size() < static_cast<std::size_t>(face_count))
    refuse("ends after " + std::to_string(values.size()) + " numbers, there are " + std::to_string(face_count) + " faces");
  return values;
}

}  // namespace

std::vector<double> read_importance(const std::filesystem::path& path, int face_count) {
  return read_numbers(path, face_count, [](double value) { return value > 0 ? nullptr : "an importance must be positive"; });
}

std::vector<char> read_flags(const std::filesystem::path& path, int face_count) {
  const std::vector<double> numbers =
      read_numbers(path, face_count, [](double value) { return value == 0 || value == 1 ? nullptr : "a flag must be 0 or 1"; });
  return {numbers.begin(), numbers.end()};
}

}  // namespace atlas_refine::cli
