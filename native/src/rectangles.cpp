// The three steps of the paper, one after the other.
#include "rectangles.h"

#include "align/align.h"
#include "cut/cut_charts.h"
#include "cut/restore_faces.h"
#include "layout/place_pieces.h"
#include "layout/search_layout.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "rectangle_pictures.h"
#include "reduce/density.h"
#include "reduce/re_embed.h"
#include "report/options.h"
#include "support/parallel.h"

namespace atlas_refine {
namespace {

// Until faces are restored pieces are kept so much further apart than the gap, which leaves room for the last steps.
constexpr double kFirstGap = 1.02;
// Relative change of E_d at which the reduction before that ends, and the one after (the paper: 1e-4 for several iterations).
constexpr double kFirstChange = 1e-4;
constexpr double kLastChange = 2e-5;
constexpr double kSpread = 1.01;  // what pieces are put further apart by before the reduction, as a factor on their places

class RectangleRoad {
 public:
  RectangleRoad(const Atlas& atlas, ChartSet set, const RefineOptions& options, Outcome& outcome, Monitor& monitor)
      : atlas_(atlas),
        set_(std::move(set)),
        options_(options),
        outcome_(outcome),
        monitor_(monitor),
        threads_(resolve_threads(options.threads)) {}

  std::optional<RefineResult> run() {
    embed_broken_polygons();
    charts_ = set_.charts;
    enough_ = dirichlet_sums(charts_).best_energy();
    set_density(charts_, options_.density);
    if (options_.density == Density::Keep) enough_ = dirichlet_sums(charts_).best_energy();

    outcome_.begin_stage("align", 0.05, 0.35);  // section 3.1
    const auto aligned = align_charts(charts_, {options_.rectangles.sigma, threads_}, monitor_);
    outcome_.aligned(aligned);

    outcome_.begin_stage("layout", 0.35, 0.45);  // section 3.2
    const Layout layout = search_layout(aligned, charts_, layout_options(options_, threads_), monitor_);
    outcome_.laid_out(layout);
    CutCharts cut = cut_charts(aligned, charts_, layout.trails, space_points(atlas_, set_));
    if (cut.seams.empty()) return not_cut("no chart needs a cut");
    const std::vector<Chart> packed = place_pieces(layout, meshes_of(cut), charts_of(cut));
    for (std::size_t p = 0; p < packed.size(); ++p) cut.pieces[p].mesh.uvs = packed[p].uvs;
    spread(layout, cut);
    if (outcome_.draws()) {
      for (const auto& picture : rectangle_pictures(charts_, aligned, layout.trails, options_.rectangles.sigma))
        outcome_.show(picture);
    }
    outcome_.show("packed", packed);

    outcome_.begin_stage("reduce", 0.45, 0.95);  // section 3.3
    Gap wide = layout.gap;
    wide.value *= kFirstGap;
    const ReduceResult reduced = reduce(cut, wide, kFirstChange);
    if (!reduced.reached) return not_cut("that did not reach the bound");
    if (restore(cut) > 0) reduce(cut, layout.gap, kLastChange);
    return outcome_.certified_cut(set_, cut, layout.gap);
  }

 private:
  std::nullopt_t not_cut(const char* why) {
    outcome_.not_cut(why);
    return std::nullopt;
  }

  /// Charts may overlap themselves here, but every triangle must be positive.
  void embed_broken_polygons() {
    outcome_.begin_stage("embed", 0.02, 0.05);
    for (const FaceDefect& defect : set_.defects) {
      if (certify_charts({set_.charts[defect.chart]}).flipped_faces == 0) continue;  // mended with another of its faces
      set_.charts[defect.chart] = re_embed(set_.charts[defect.chart], defect.chart, threads_, monitor_);
      outcome_.re_embedded(defect.chart);
    }
  }

  /// Puts the pieces a little further apart, as far as the bound allows: pieces that touch block each other's first steps.
  void spread(const Layout& layout, CutCharts& cut) const {
    const double factor = std::min(kSpread, std::sqrt(layout.pe / (1.01 * options_.pe_bound)));
    if (!(factor > 1)) return;
    for (CutPiece& piece : cut.pieces) {
      const Vec2 shift = (factor - 1) * uv_box({piece.mesh}).min;
      for (Vec2& uv : piece.mesh.uvs) uv += shift;
    }
  }

  /// Moves the pieces to less distortion under the bound.
  ReduceResult reduce(CutCharts& cut, const Gap& gap, double least_change) {
    const std::vector<Chart> pieces = meshes_of(cut);
    const bool to_the_end = !options_.rectangles.until_input || options_.reference == Reference::Input;
    const ReduceProblem problem{.charts = pieces,
                                .gap = gap,
                                .box_aspect = options_.box_aspect,
                                .pe_target = options_.pe_bound,
                                .enough_distortion = to_the_end ? 0 : enough_,
                                .least_change = 0,
                                .negligible = least_change,
                                .max_distortion = options_.max_distortion.value_or(0),
                                .threads = threads_};
    ReduceResult reduced = reduce_distortion(
        problem, [&](const ReduceProgress& progress) { monitor_.report(1 - 1 / (1 + 0.1 * progress.iteration), progress.pe); });
    outcome_.reduced(reduced);
    for (std::size_t p = 0; p < cut.pieces.size(); ++p) cut.pieces[p].mesh.uvs = reduced.uvs[p];
    return reduced;
  }

  /// Takes out the vertices that only served the deformation; returns how many.
  int restore(CutCharts& cut) const {
    const double scale = dirichlet_sums(meshes_of(cut)).best_scale();
    int removed = 0;
    for (CutPiece& piece : cut.pieces) removed += restore_faces(piece, charts_[piece.chart], scale);
    return removed;
  }

  const Atlas& atlas_;
  ChartSet set_;
  const RefineOptions& options_;
  Outcome& outcome_;
  Monitor& monitor_;
  int threads_;
  std::vector<Chart> charts_;
  double enough_ = 1;  // E_d at which the reduction may stop
};

}  // namespace

std::optional<RefineResult> cut_into_rectangles(const Atlas& atlas, ChartSet set, const RefineOptions& options, Outcome& outcome,
                                                Monitor& monitor) {
  return RectangleRoad(atlas, std::move(set), options, outcome, monitor).run();
}

}  // namespace atlas_refine
