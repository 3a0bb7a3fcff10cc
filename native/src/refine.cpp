// The whole method, top to bottom: charts, the road that cuts or the least intervention that holds the bound, the certificate.
#include "atlas_refine/refine.h"

#include "input/split_charts.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "pack/place_charts.h"
#include "rectangles.h"
#include "reduce/density.h"
#include "reduce/re_embed.h"
#include "reduce/reference.h"
#include "reduce/squeeze.h"
#include "report/measure_atlas.h"
#include "report/options.h"
#include "report/outcome.h"
#include "support/monitor.h"
#include "support/parallel.h"

namespace atlas_refine {
namespace {

/// One call of refine(): the state that its steps hand on.
class Refinement {
 public:
  Refinement(const Atlas& atlas, const RefineOptions& options, Monitor& monitor, DebugSink* debug)
      : atlas_(atlas),
        options_(options),
        monitor_(monitor),
        outcome_(atlas, options, monitor, debug),
        gap_(options.gap.value_or(Gap{})),
        threads_(resolve_threads(options.threads)) {}

  RefineResult run() {
    outcome_.begin_stage("input", 0, 0.02);
    ChartSet set = split_charts(atlas_);
    require_no_flips(atlas_, set);
    outcome_.measure_input(set);
    if (holds_already(set)) return outcome_.unchanged(gap_);
    set_reference(set.charts, options_.reference, options_.importance);
    if (options_.seams == Seams::Rectangles) {
      if (auto cut = cut_into_rectangles(atlas_, set, options_, outcome_, monitor_)) return std::move(*cut);
    }
    return without_seams(std::move(set));
  }

 private:
  /// The least intervention that holds the bound: charts are moved, or squeezed.
  RefineResult without_seams(ChartSet set) {
    const bool own_layout = !embed_where_needed(set) && certify_charts(set.charts).valid();
    charts_ = std::move(set.charts);
    outcome_.begin_stage("pack", 0.2, 0.4);
    const bool scaled = set_density(charts_, options_.density);
    const std::vector<Chart> placed = place_anew();
    if (holds_placed(placed)) return outcome_.certified(Intervention::Moved, placed, gap_);
    return squeezed(own_layout && !scaled, placed);
  }

  bool gap_kept(const std::vector<Chart>& charts, double factor) const {
    const Vec2 box = box_of_aspect(uv_box(charts), options_.box_aspect).size();
    return gap_between_charts(charts) >= factor * gap_.length(box);
  }
  double pe(const std::vector<Chart>& charts) const {
    return uv_area(charts) / box_of_aspect(uv_box(charts), options_.box_aspect).area();
  }
  bool distortion_allowed(double distortion) const { return !options_.max_distortion || distortion <= *options_.max_distortion; }

  /// Unchanged: the input is valid and at the bound; a gap counts only where one was asked for.
  bool holds_already(const ChartSet& set) const {
    const Measures& before = outcome_.before();
    return before.pe_fixed_aspect >= options_.pe_bound && distortion_allowed(before.distortion) && validate_split(set).valid() &&
           (!options_.gap || gap_kept(set.charts, 1));
  }

  /// Charts that overlap themselves, or hold polygons that do, are embedded anew; true where there was one.
  bool embed_where_needed(ChartSet& set) {
    outcome_.begin_stage("embed", 0.02, 0.2);
    bool any = false;
    for (int c = 0; c < static_cast<int>(set.charts.size()); ++c) {
      monitor_.report(static_cast<double>(c) / set.charts.size());
      if (certify_charts({set.charts[c]}).valid()) continue;
      set.charts[c] = re_embed(set.charts[c], c, threads_, monitor_);
      outcome_.re_embedded(c);
      any = true;
    }
    return any;
  }

  std::vector<Chart> place_anew() {
    const PlaceOptions place{gap_, options_.box_aspect, options_.pe_bound, options_.seed, threads_};
    std::vector<Chart> placed = place_charts(charts_, place, monitor_);
    outcome_.show("placed", placed);
    return placed;
  }

  bool holds_placed(const std::vector<Chart>& placed) const {
    constexpr double kRounding = 1 + 1e-6;  // storing single precision must not lose the bound
    return pe(placed) >= kRounding * options_.pe_bound && distortion_allowed(dirichlet_sums(placed).best_energy());
  }

  RefineResult squeezed(bool own_layout, const std::vector<Chart>& placed) {
    outcome_.begin_stage("squeeze", 0.4, 0.95);
    std::vector<std::vector<Chart>> starts = {placed};
    if (own_layout && gap_kept(charts_, kStartGap)) add_own_layout(starts);
    Squeezed best = squeeze(starts, squeeze_options(options_, threads_), monitor_);
    outcome_.squeezed(best);
    return outcome_.certified(Intervention::Squeezed, best.charts, best.gap);
  }

  /// The artist's layout is a start beside the packer's; of a large atlas only the tighter one is tried.
  void add_own_layout(std::vector<std::vector<Chart>>& starts) const {
    constexpr std::size_t kLarge = 30000;
    std::size_t triangles = 0;
    for (const Chart& chart : charts_) triangles += chart.triangles.size();
    if (triangles <= kLarge)
      starts.push_back(charts_);
    else if (pe(charts_) > pe(starts.front()))
      starts.front() = charts_;
  }

  const Atlas& atlas_;
  const RefineOptions& options_;
  Monitor& monitor_;
  Outcome outcome_;
  Gap gap_;
  int threads_;
  std::vector<Chart> charts_;
};

}  // namespace

const char* version() { return ATLAS_REFINE_VERSION; }

RefineResult refine(const Atlas& atlas, const RefineOptions& options, const ProgressFn& progress, DebugSink* debug) {
  check_options(atlas, options);
  RefineResult result;
  run_monitored(progress, [&](Monitor& monitor) { result = Refinement(atlas, options, monitor, debug).run(); });
  return result;
}

}  // namespace atlas_refine
