// Files of numbers, read with their lines.
#include "number_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "io/input_file.h"

namespace atlas_refine::cli {

namespace {

bool is_separator(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

struct Number {
  double value;
  std::string_view text;
  int line;
};

[[noreturn]] void refuse(const std::filesystem::path& path, int line, const std::string& what) {
  throw io::InputError(path, "line " + std::to_string(line) + ": " + what);
}

/// The numbers of `text`; `last_line` is the one that it ends on.
std::vector<Number> numbers_in(const std::filesystem::path& path, const std::string& text, int& last_line) {
  std::vector<Number> out;
  int& line = last_line = 1;
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
      refuse(path, line, io::quoted(token) + " is not a number");
    out.push_back({value, token, line});
    at = end;
  }
  return out;
}

/// `wrong` says in a few words why a number is not allowed, or nullptr.
std::vector<double> read_numbers(const std::filesystem::path& path, int face_count, const char* (*wrong)(double)) {
  const std::string text = io::read_text(path, "a file of numbers");
  int last_line = 1;
  std::vector<double> values;
  for (const Number& number : numbers_in(path, text, last_line)) {
    if (const char* must = wrong(number.value)) refuse(path, number.line, std::string(must) + ", not " + io::quoted(number.text));
    values.push_back(number.value);
    if (values.size() > static_cast<std::size_t>(face_count))
      refuse(path, number.line, "more numbers than faces, there are " + std::to_string(face_count));
  }
  if (values.size() < static_cast<std::size_t>(face_count))
    refuse(path, last_line,
           "ends after " + std::to_string(values.size()) + " numbers, there are " + std::to_string(face_count) + " faces");
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

std::vector<std::array<int, 2>> read_edges(const std::filesystem::path& path, int vertex_count) {
  const std::string text = io::read_text(path, "a file of numbers");
  int last_line = 1;
  std::vector<int> ends;
  for (const Number& number : numbers_in(path, text, last_line)) {
    if (!(number.value >= 0 && number.value < vertex_count) || number.value != std::floor(number.value))
      refuse(path, number.line,
             io::quoted(number.text) + " is no vertex: they count from 0, there are " + std::to_string(vertex_count));
    ends.push_back(static_cast<int>(number.value));
  }
  if (ends.size() % 2 != 0) refuse(path, last_line, "ends within an edge, which is two vertices");
  std::vector<std::array<int, 2>> edges;
  for (std::size_t k = 0; k < ends.size(); k += 2) edges.push_back({ends[k], ends[k + 1]});
  return edges;
}

}  // namespace atlas_refine::cli
