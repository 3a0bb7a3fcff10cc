// Few triangles are reduced as they are; many on coarse charts, which are made anew once the pieces nearly have their shapes.
#include "reduce_pieces.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "coarsen/coarse_atlas.h"
#include "cut/restore_faces.h"
#include "geometry/guards.h"
#include "layout/place_pieces.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "place_and_squeeze.h"
#include "placing.h"
#include "reduce/goal.h"
#include "reduce/squeeze.h"
#include "report/locked.h"

namespace atlas_refine {
namespace {

// Until faces are restored pieces are kept so much further apart than the gap, which leaves room for the last steps.
constexpr double kFirstGap = 1.02;
// Relative change of E_d at which the reduction before that ends, and the one after (the paper: 1e-4 for several iterations).
constexpr double kFirstChange = 5e-4;
constexpr double kLastChange = 2e-5;
constexpr std::size_t kMany = 3000;      // from so many triangles on coarse charts go first:
constexpr double kRoughChange = 3e-4;    // those of the deformed pieces come only so near to the optimum anyway,
constexpr double kCoarseChange = 4e-6;   // while what slides slowly slides on those made anew, where that costs little;
constexpr double kCarriedChange = 6e-6;  // nearer to the optimum less changes at once
constexpr int kCoarsenings = 3;          // after the first, each followed by
constexpr int kFineIterations = 12;      // of all triangles, unless it is the last
constexpr int kFewIterations = 3;        // take the deformation back within coarse triangles
constexpr int kMostIterations = 150;     // of each reduction of hundreds of pieces
// Fewer triangles are packed in other ways besides:
constexpr std::size_t kReduced = 6000;  // in as many as so many triangles are reduced in, some tenths of a second,
constexpr std::size_t kMostWays = 7;    // and at most these
constexpr double kSeamCost = 0.02;      // E_d that a layout has to save for each unit of boundary growth
constexpr double kSpread = 1.01;        // what pieces are put further apart by before the reduction, as a factor on their places

/// How far pieces are reduced, and from where.
struct Reduction {
  Gap gap;
  double negligible;  ///< ReduceProblem::negligible
  double enough = 0;  ///< ReduceProblem::enough_distortion
  int most = ReduceProblem::kMostIterations;
  std::optional<WarmStart> warm = {};
};

std::size_t triangle_count(const CutAtlas& cut) {
  std::size_t count = 0;
  for (const Piece& piece : cut.pieces) count += piece.mesh.triangles.size();
  return count;
}

/// The pieces where the layout wants them, a little further apart as far as the bound allows: pieces that touch block each
/// other's first steps. Returns them as the layout has them.
std::vector<Chart> place(const Refinement& run, const Layout& layout, CutAtlas& cut) {
  std::vector<Chart> packed = place_pieces(layout, meshes_of(cut), charts_of(cut));
  const double factor = std::max(1.0, std::min(kSpread, std::sqrt(layout.pe / (1.01 * run.options.pe_bound))));
  for (std::size_t p = 0; p < packed.size(); ++p) {
    const Vec2 shift = (factor - 1) * uv_box({packed[p]}).min;
    cut.pieces[p].mesh.uvs = packed[p].uvs;
    for (Vec2& uv : cut.pieces[p].mesh.uvs) uv += shift;
    drop_broken_guards(cut.pieces[p].mesh);  // of polygons that the axes have bent
  }
  return packed;
}

/// Pieces, or their coarse charts, and what is wanted of them.
struct Task {
  const std::vector<Chart>& charts;
  const Objective& objective;
  const Freedoms& freedom;
};

ReduceResult reduce(const Refinement& run, const Task& task, const Reduction& reduction) {
  const int most = task.charts.size() > kHundredsOfPieces ? kMostIterations : ReduceProblem::kMostIterations;
  const ReduceProblem problem{.charts = task.charts,
                              .objective = &task.objective,
                              .gap = beyond_rounding(reduction.gap, run.options.stored),
                              .box_aspect = run.options.box_aspect,
                              .pe_target = run.options.pe_bound,
                              .enough_distortion = reduction.enough,
                              .least_change = 0,
                              .negligible = reduction.negligible,
                              .limits = limits_of(run.options),
                              .max_iterations = std::min(most, reduction.most),
                              .threads = run.threads,
                              .freedom = task.freedom,
                              .warm = reduction.warm};
  ReduceResult reduced = reduce_distortion(problem, [&](const ReduceProgress& progress) {
    run.monitor.report(1 - 1 / (1 + 0.1 * progress.iteration), progress.pe);
    return !run.monitor.finishing();
  });
  reduced.end.near_borders.clear();  // of vertices that coarse charts lack, or that are soon taken out
  return reduced;
}

Freedoms freedom_in(const Refinement& run, const CutAtlas& cut) {
  return freedom_of_pieces(freedom_of(run.input.set, run.options), cut);
}

/// Moves the pieces to less distortion under the bound.
ReduceResult reduce_fine(const Refinement& run, const Reduction& reduction, CutAtlas& cut) {
  const std::vector<Chart> pieces = meshes_of(cut);
  const Objective objective = goal_of(run.input.set.charts, cut, run.options);
  const Freedoms freedom = freedom_in(run, cut);
  ReduceResult reduced = reduce(run, {pieces, objective, freedom}, reduction);
  run.journal.iterations += reduced.iterations;
  cut = with_uvs(std::move(cut), reduced.uvs);
  return reduced;
}

/// The pieces of an atlas with their coarse charts.
struct CoarsePieces {
  std::vector<Chart> fine;
  Objective objective;
  Freedoms freedom;
  CoarseAtlas coarse;
};

/// Nothing where there is little to gain. What stops at some distortion has to see that of the pieces.
std::optional<CoarsePieces> coarse_pieces(const Refinement& run, const CutPlan& plan, const CutAtlas& cut) {
  if (triangle_count(cut) < kMany || limits_of(run.options).any() || plan.enough > 0) return std::nullopt;
  CoarsePieces out{.fine = meshes_of(cut),
                   .objective = goal_of(run.input.set.charts, cut, run.options),
                   .freedom = freedom_in(run, cut),
                   .coarse = {}};
  auto coarse = coarsen(out.fine, out.objective, out.freedom);
  if (!coarse) return std::nullopt;
  out.coarse = std::move(*coarse);
  return out;
}

ReduceResult reduce_coarse(const Refinement& run, const CoarsePieces& pieces, const Reduction& reduction) {
  const PlacedCharts start = restricted(pieces.coarse, PlacedCharts{.charts = pieces.fine});
  return reduce(run, {start.charts, pieces.coarse.objective, pieces.freedom}, reduction);
}

/// True where the pieces could be put where their coarse charts have ended; else nothing has changed.
bool carry_over(const CoarsePieces& pieces, const ReduceResult& end, CutAtlas& cut) {
  if (!end.holds()) return false;
  const auto uvs = prolonged(pieces.coarse, pieces.fine, pieces.objective, end.uvs);
  if (!uvs) return false;
  CutAtlas carried = with_uvs(cut, *uvs);
  if (!certify_charts(meshes_of(carried)).valid()) return false;
  cut = std::move(carried);
  return true;
}

/// On coarse charts, from where it lies; nothing has changed where they do not reach the bound or cannot be carried over.
void reduce_coarsely(const Refinement& run, const CutPlan& plan, const Reduction& reduction, ReducedPieces& at) {
  const auto pieces = coarse_pieces(run, plan, at.atlas);
  if (!pieces) return;
  ReduceResult end = reduce_coarse(run, *pieces, reduction);
  run.journal.iterations += end.iterations;
  if (!carry_over(*pieces, end, at.atlas)) return;
  at.carried = true;
  at.result = std::move(end);
}

ReducedPieces placed_in(const Refinement& run, const Layout& layout, CutAtlas cut) {
  ReducedPieces out{.atlas = std::move(cut), .layout = layout, .packed = {}};
  out.packed = place(run, layout, out.atlas);
  if (const Validity start = certify_charts(meshes_of(out.atlas)); !start.valid())
    out.failure = "in their layout " + start.problem;
  return out;
}

/// From where coarse charts have ended: no map of their triangles takes back how the axes have deformed the pieces within them.
/// A few steps do, then new ones, whose triangles have the shapes they want, go on.
void reduce_on(const Refinement& run, const CutPlan& plan, ReducedPieces& at) {
  const Gap& gap = at.layout.gap;
  CutAtlas& cut = at.atlas;
  ReduceResult& out = at.result;
  out = reduce_fine(run, {.gap = gap, .negligible = kCarriedChange, .most = kFewIterations, .warm = std::move(out.end)}, cut);
  for (int k = 1; k <= kCoarsenings && out.status == ReduceStatus::OutOfTime; ++k) {
    const auto pieces = coarse_pieces(run, plan, cut);
    bool carried = false;
    if (pieces) {
      ReduceResult end = reduce_coarse(run, *pieces, {.gap = gap, .negligible = kCoarseChange, .warm = out.end});
      run.journal.iterations += end.iterations;
      carried = carry_over(*pieces, end, cut);
      if (carried) out.end = std::move(end.end);
    }
    const bool last = !carried || k == kCoarsenings;
    const int most = last ? ReduceProblem::kMostIterations : kFineIterations;
    out = reduce_fine(run, {.gap = gap, .negligible = kCarriedChange, .most = most, .warm = out.end}, cut);
    if (last) break;
  }
}

}  // namespace

bool ReducedPieces::better_than(const ReducedPieces& other) const {
  if (!holds() || !other.holds()) return holds();
  return result.energy + kSeamCost * layout.growth < other.result.energy + kSeamCost * other.layout.growth;
}

ReducedPieces reduce_pieces(const Refinement& run, const CutPlan& plan, const Layout& layout, const CutAtlas& cut) {
  Reduction reduction{.gap = layout.gap, .negligible = kRoughChange, .enough = plan.enough};
  reduction.gap.value *= kFirstGap;
  ReducedPieces best = placed_in(run, layout, cut);
  if (!best.failure.empty()) return best;
  reduce_coarsely(run, plan, reduction, best);
  if (best.carried) return best;
  reduction.negligible = kFirstChange;
  best.result = reduce_fine(run, reduction, best.atlas);
  const std::size_t triangles = triangle_count(cut);
  if (triangles >= kMany || !best.holds()) return best;
  const int ways = static_cast<int>(std::min(kMostWays, kReduced / (triangles + 1)));
  for (const Layout& other : packed_otherwise(layout, ways, layout_options(run))) {
    ReducedPieces trial = placed_in(run, other, cut);
    if (!trial.failure.empty()) continue;
    trial.result = reduce_fine(run, reduction, trial.atlas);
    if (trial.better_than(best)) best = std::move(trial);
  }
  return best;
}

void finish_pieces(const Refinement& run, const CutPlan& plan, ReducedPieces& at) {
  restore_pieces(plan.sources, plan.freedom, at.atlas);
  if (at.carried)
    reduce_on(run, plan, at);
  else
    at.result = reduce_fine(run, {.gap = at.layout.gap, .negligible = kLastChange, .enough = plan.enough}, at.atlas);
}

void restore_pieces(const std::vector<Chart>& charts, const Freedoms& freedom, CutAtlas& cut) {
  const double scale = dirichlet_sums(meshes_of(cut)).best_scale();
  const std::vector<bool> border_points = points_on_borders(cut);
  for (Piece& piece : cut.pieces) {
    if (bends(freedom, piece.chart)) restore_faces(piece, charts[piece.chart], scale, border_points);
  }
}

}  // namespace atlas_refine
