// What happened in one call, step by step: timings, repairs, fallbacks, warnings, pictures. It judges nothing.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "atlas_refine/debug_sink.h"
#include "atlas_refine/result.h"
#include "geometry/chart.h"
#include "support/monitor.h"

namespace atlas_refine {

/// A part of the whole call's progress.
struct ProgressRange {
  double from = 0;
  double to = 1;

  ProgressRange part(double begin, double end) const { return {from + begin * (to - from), from + end * (to - from)}; }
};

class Journal {
 public:
  Journal(Monitor& monitor, DebugSink* debug, double box_aspect) : monitor_(monitor), debug_(debug), box_aspect_(box_aspect) {}

  void begin_stage(const std::string& stage, const ProgressRange& range);
  void end_stage();

  std::vector<StageTime> timings;
  std::vector<Repair> repairs;
  std::vector<std::string> fallbacks, warnings;
  int iterations = 0;  ///< Newton iterations, all stages

  /// Where the lists end now, and back to there: what an attempt that did not lead to the result has told.
  struct Mark {
    std::size_t repairs, fallbacks, warnings;
  };
  Mark mark() const { return {repairs.size(), fallbacks.size(), warnings.size()}; }
  void back_to(const Mark& mark) {
    repairs.resize(mark.repairs);
    fallbacks.resize(mark.fallbacks);
    warnings.resize(mark.warnings);
  }

  /// Puts `prefix` before all fallbacks and warnings since then.
  void prefix_from(const Mark& mark, const std::string& prefix);

  /// Of the box that the charts shown from here on are packed in.
  void of_box(double box_aspect) { box_aspect_ = box_aspect; }
  bool draws() const { return debug_ != nullptr; }
  void show(const AtlasSnapshot& picture) { debug_->receive(picture); }
  /// Hands the charts to the debug sink, where there is one.
  void show(const std::string& stage, const std::vector<Chart>& charts);

 private:
  Monitor& monitor_;
  DebugSink* debug_;
  double box_aspect_;
  std::string stage_;
  std::chrono::steady_clock::time_point start_;
};

/// "chart 3", "charts 3, 5", or how many they are.
std::string charts_named(const std::vector<int>& charts);
/// printf of one number.
std::string number_text(const char* format, double value);

}  // namespace atlas_refine
