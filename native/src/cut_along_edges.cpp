// Trails become paths along edges; the parts are placed and squeezed.
#include "cut_along_edges.h"

#include <algorithm>

#include "layout/edge_paths.h"
#include "layout/trail_paths.h"
#include "measure/certificate.h"
#include "place_and_squeeze.h"
#include "report/note_repairs.h"

namespace atlas_refine {
namespace {

bool has_trails(const Layout& layout) {
  return std::any_of(layout.trails.begin(), layout.trails.end(), [](const auto& trails) { return !trails.empty(); });
}

/// The charts that are wanted cut and are not.
std::vector<int> charts_left_whole(const Refinement& run, const Layout& layout, const CutAtlas& cut) {
  std::vector<int> pieces(layout.trails.size(), 0), out;
  for (const Piece& piece : cut.pieces) ++pieces[piece.chart];
  for (int c = 0; c < static_cast<int>(pieces.size()); ++c) {
    if (pieces[c] == 1 && !layout.trails[c].empty()) out.push_back(run.input.set.charts[c].number);
  }
  return out;
}

/// Parts of charts that overlap themselves may do so too.
void mend_pieces(const Refinement& run, const Freedoms& freedom, CutAtlas& cut, std::vector<int>& mended) {
  for (Piece& piece : cut.pieces) {
    if (!bends(freedom, piece.chart) || certify_charts({piece.mesh}).valid()) continue;
    piece.mesh = made_valid(run, piece.mesh);
    mended.push_back(piece.chart);
  }
}

}  // namespace

Attempt cut_along_edges(const Refinement& run, CutPlan plan, const ProgressRange& range) {
  const auto paths =
      edge_paths(plan.aligned, plan.charts, trace_trails(plan.aligned, plan.layout.trails), plan.prices, run.threads);
  if (paths.empty()) return {.needless = !has_trails(plan.layout), .failure = "along edges no more than slivers can be cut off"};
  CutAtlas cut = cut_along(plan.atlas, plan.sources, paths);
  mend_pieces(run, plan.freedom, cut, plan.mended);
  std::optional<Solution> out = place_and_squeeze_cut(run, cut, range);
  if (!out) return {.failure = "cut along edges, they do not reach the bound"};
  out->re_embedded = std::move(plan.mended);
  out->rectangles = report_of(plan);
  out->rectangles->holes_cut = 0;
  if (const std::vector<int> whole = charts_left_whole(run, plan.layout, cut); !whole.empty())
    run.journal.fallbacks.push_back(charts_named(whole) + ": along edges no more than slivers can be cut off; left whole");
  return {.solution = std::move(*out)};
}

}  // namespace atlas_refine
