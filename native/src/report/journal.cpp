// Stages and their pictures.
#include "report/journal.h"

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
  timings.push_back({stage_, std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count()});
  stage_.clear();
}

void Journal::show(const std::string& stage, const std::vector<Chart>& charts) {
  if (!debug_) return;
  const Measures measures = measure_charts(charts, box_aspect_);
  const std::string caption =
      "PE " + number_text("%.1f %%", 100 * measures.pe_fixed_aspect) + ", E_d " + number_text("%.4f", measures.distortion);
  debug_->receive(make_snapshot(stage, caption, charts, box_of_aspect(uv_box(charts), box_aspect_)));
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
