// Stages and their pictures.
#include "report/journal.h"

#include <algorithm>
#include <cstdio>

#include "measure/distortion.h"
#include "measure/metrics.h"
#include "measure/snapshot.h"

namespace atlas_refine {

void Journal::begin_stage(const std::string& stage, const ProgressRange& range) {
  end_stage();
  monitor_.begin_stage(stage, range.from, range.to);
  stage_ = stage;
  start_ = std::chrono::steady_clock::now();
}

void Journal::end_stage() {
  if (stage_.empty()) return;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const auto before = std::find_if(timings.begin(), timings.end(), [&](const StageTime& time) { return time.stage == stage_; });
  if (before != timings.end()) {
    before->seconds += seconds;
  } else {
    timings.push_back({stage_, seconds});
  }
  stage_.clear();
}

void Journal::show(const std::string& stage, const std::vector<Chart>& charts) {
  if (!debug_) return;
  const Measures measures = measure_charts(charts, box_aspect_);
  const std::string caption =
      "PE " + number_text("%.1f %%", 100 * measures.pe_fixed_aspect) + ", E_d " + number_text("%.4f", measures.distortion);
  debug_->receive(make_snapshot(stage, caption, charts, box_of_aspect(uv_box(charts), box_aspect_)));
}

void Journal::prefix_from(const Mark& mark, const std::string& prefix) {
  for (std::size_t k = mark.fallbacks; k < fallbacks.size(); ++k) fallbacks[k].insert(0, prefix);
  for (std::size_t k = mark.warnings; k < warnings.size(); ++k) warnings[k].insert(0, prefix);
}

std::string describe(const Repair& repair) {
  std::string text = charts_named(repair.charts) + ": " + repair.what;
  if (!repair.faces.empty())
    text += " (" + std::to_string(repair.faces.size()) + (repair.faces.size() == 1 ? " face, " : " faces, first ") +
            std::to_string(repair.faces.front()) + ")";
  return repair.distortion_to_input > 1 ? text + ", E_2 " + number_text("%.4f", repair.distortion_to_input) : text;
}

std::string charts_named(const std::vector<int>& charts) {
  constexpr std::size_t kMostNamed = 6;
  if (charts.size() > kMostNamed) return std::to_string(charts.size()) + " charts";
  std::string text = charts.size() == 1 ? "chart" : "charts";
  for (std::size_t k = 0; k < charts.size(); ++k) text += (k > 0 ? ", " : " ") + std::to_string(charts[k]);
  return text;
}

std::string number_text(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace atlas_refine
