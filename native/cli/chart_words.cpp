// What is said of charts, with where in the files they are.
#include "chart_words.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <optional>

namespace atlas_refine::cli {

namespace {

std::string place_of_chart(int chart, const RefineResult& result, const Collection& files) {
  const auto face = std::find(result.face_charts.begin(), result.face_charts.end(), chart);
  return face == result.face_charts.end() ? "" : files.words_for_face(static_cast<int>(face - result.face_charts.begin()));
}

/// The charts that a line tells of: the first, whether there are more, and where in the line they end.
struct NamedCharts {
  int first;
  bool more;
  std::size_t end;
};

/// "chart 3" or "charts 3, 5" at that place.
std::optional<NamedCharts> numbers_at(const std::string& line, std::size_t at) {
  const bool several = line.compare(at, 7, "charts ") == 0;
  if (!several && line.compare(at, 6, "chart ") != 0) return std::nullopt;
  at += several ? 7 : 6;
  int first = 0;
  const auto [stop, error] = std::from_chars(line.data() + at, line.data() + line.size(), first);
  const std::size_t end = std::min(line.find_first_not_of("0123456789, ", at), line.size());
  if (error != std::errc() || end == line.size() || line[end] != ':') return std::nullopt;
  return NamedCharts{first, several, end};
}

/// "37 charts" at that place, which are not named: the first of those that were left for the reason, or went with another.
std::optional<NamedCharts> count_at(const std::string& line, std::size_t at, const RefineResult& result) {
  const std::size_t end = line.find_first_not_of("0123456789", at);
  if (end == at || end == std::string::npos || line.compare(end, 8, " charts:") != 0) return std::nullopt;
  for (std::size_t k = 0; k < result.charts.size(); ++k) {
    const ChartReport& chart = result.charts[k];
    const bool meant = chart.fate == Fate::Left      ? line.find(chart.reason, end) != std::string::npos
                       : chart.fate == Fate::Stacked ? line.find("kept there", end) != std::string::npos
                                                     : false;
    if (meant) return NamedCharts{static_cast<int>(k), true, end + 7};
  }
  return std::nullopt;
}

}  // namespace

std::string repair_words(const Repair& repair, const RefineResult& result, const Collection& files) {
  Repair bare = repair;
  bare.faces.clear();
  std::string text = describe(bare);
  const std::size_t end = text.find(": ");
  if (end == std::string::npos || repair.charts.empty()) return describe(repair);
  std::string where =
      repair.faces.empty() ? place_of_chart(repair.charts.front(), result, files) : files.words_for_face(repair.faces.front());
  if (repair.faces.size() == 1) where.insert(0, "1 face, ");
  if (repair.faces.size() > 1) where.insert(0, std::to_string(repair.faces.size()) + " faces, the first ");
  if (repair.faces.empty() && repair.charts.size() > 1) where.insert(0, "the first ");
  return text.insert(end, " (" + where + ")");
}

std::string with_place(const std::string& line, const RefineResult& result, const Collection& files) {
  // Groups are named before: "material red: chart 3: ..."
  for (std::size_t at = 0; at != std::string::npos;
       at = line.find(": ", at) == std::string::npos ? std::string::npos : line.find(": ", at) + 2) {
    std::optional<NamedCharts> charts = numbers_at(line, at);
    if (!charts) charts = count_at(line, at, result);
    if (!charts) continue;
    const std::string place = place_of_chart(charts->first, result, files);
    if (place.empty()) return line;
    return std::string(line).insert(charts->end, (charts->more ? " (the first " : " (") + place + ")");
  }
  return line;
}

}  // namespace atlas_refine::cli
