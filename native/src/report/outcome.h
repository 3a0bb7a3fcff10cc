// Gathers the result of one call: measures, timings, repairs; stores and certifies the UVs.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "atlas_refine/debug_sink.h"
#include "atlas_refine/result.h"
#include "cut/cut_charts.h"
#include "input/split_charts.h"
#include "layout/search_layout.h"
#include "reduce/squeeze.h"
#include "support/monitor.h"

namespace atlas_refine {

class Outcome {
 public:
  Outcome(const Atlas& atlas, const RefineOptions& options, Monitor& monitor, DebugSink* debug);

  void begin_stage(const std::string& stage, double from, double to);
  void measure_input(const ChartSet& set);
  const Measures& before() const { return result_.before; }
  void re_embedded(int chart);
  void squeezed(const Squeezed& squeezed);
  void aligned(const std::vector<AxisAlignedChart>& aligned);
  void laid_out(const Layout& layout);
  /// Why the charts were not cut into rectangles.
  void not_cut(const char* why) { result_.warnings.push_back(std::string("not cut into rectangles: ") + why); }
  void reduced(const ReduceResult& reduced) { result_.iterations += reduced.iterations; }
  /// Hands the charts to the debug sink, where there is one.
  void show(const std::string& stage, const std::vector<Chart>& charts);
  bool draws() const { return debug_ != nullptr; }
  void show(const AtlasSnapshot& picture) { debug_->receive(picture); }

  /// The input's own values.
  RefineResult unchanged(const Gap& gap);
  /// The charts' UVs, scaled into the unit square and rounded as they will be stored, after the exact certificate on just those
  /// values. Throws BoundNotReached (unless best effort) or NotCertified.
  RefineResult certified(Intervention intervention, const std::vector<Chart>& charts, const Gap& gap);
  /// The same for charts that were cut; the pieces' UVs are where they have ended up.
  RefineResult certified_cut(const ChartSet& set, const CutCharts& cut, const Gap& gap);

 private:
  /// An atlas to be certified: `charts` as they are to be stored, and with the input's UVs.
  struct Output {
    Atlas atlas;
    std::vector<CornerRef> corners;
    std::vector<Chart> charts;
    std::vector<Chart> input;
    std::vector<int> input_charts;  ///< the chart of the input that each one is part of
  };
  void end_stage();
  void store(Output& output) const;
  RefineResult certify(Intervention intervention, Output output, const Gap& gap);
  void require_certificate(const ChartSet& output, int chart_count, const Gap& gap);
  void require_bound();
  void warn_of_gap(const Gap& gap, std::vector<std::string>& warnings) const;
  void report_charts(const std::vector<Chart>& charts, const std::vector<int>& input_charts);

  const Atlas& atlas_;
  const RefineOptions& options_;
  Monitor& monitor_;
  DebugSink* debug_;
  RefineResult result_;
  /// What is told of the cuts, once they are certified.
  struct {
    RectangleReport report;
    std::vector<std::string> repairs, warnings;
  } cut_;
  std::vector<CornerRef> corners_;
  std::vector<Chart> input_charts_;  // turned over where mirrored
  std::string stage_;
  std::chrono::steady_clock::time_point stage_start_;
};

}  // namespace atlas_refine
