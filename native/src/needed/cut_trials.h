// What an atlas with some cuts comes to: forecast on coarse charts, or squeezed to the end.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "needed/cut_outlines.h"
#include "needed/cut_shapes.h"
#include "needed/mirror_image.h"
#include "reduce/squeeze.h"
#include "report/solution.h"
#include "seams/cut_places.h"
#include "whole.h"

namespace atlas_refine {

struct SqueezedTrial;

/// The outcome of some cuts.
struct Trial {
  std::vector<CutPlace> cuts;  ///< in the order in which they are made
  int trails = 0;              ///< instead of them, where charts are cut into rectangles
  double growth = 0;           ///< of the boundary on the surface, as a fraction of that of the charts; both sides of a cut count
  double distortion = 0;       ///< E_d; infinite where the bound does not hold
  double foreseen = 0;         ///< the same as it was forecast
  double stretch = 0;          ///< 99th percentile
  double foreseen_stretch = 0;  ///< the same as it was forecast; 0 without a forecast
  /// What they are one cut more than, where the pieces are best left in its layout; else they are placed anew.
  const SqueezedTrial* in_place_of = nullptr;
  std::optional<Forecast> forecast = {};
  std::vector<std::vector<Loss>> losses = {};  ///< of each chart

  int cut_count() const { return static_cast<int>(cuts.size()) + trails; }
};

/// The same squeezed to the end.
struct SqueezedTrial {
  Trial trial;
  Solution solution;
  std::vector<std::string> fallbacks = {}, warnings = {};  ///< told on the way
};

/// What squeezes end with beside what was forecast. Coarse charts that are placed anew lose more than the charts themselves will,
/// by what their triangles are larger; those left in place were coarsened as they lie bent, and tell what they lose.
struct Bias {
  double anew = 0, in_place = 0;  ///< E_d more than forecast
  double stretch = 1;             ///< of stretch - 1, times what was forecast

  double distortion_of(const Trial& trial) const { return trial.foreseen + (trial.in_place_of ? in_place : anew); }
  double stretch_of(const Trial& trial) const { return 1 + stretch * (trial.foreseen_stretch - 1); }
  void learn(const SqueezedTrial& squeezed);
};

/// What is asked of forecasts.
struct ForecastTerms {
  double most_growth;  ///< as Trial::growth
  Bias bias = {};      ///< with it they foresee what they will end with
};

/// What charts without cuts are squeezed by.
struct WholeTerms {
  int again = 0;       ///< packed by other random choices
  bool relax = false;  ///< bent also where the bound is held without
};

/// One more cut, as far as that is told before anything is bent.
struct Preview {
  double growth;                 ///< of the boundary by this cut alone; infinite where it cannot be made
  std::optional<double> strain;  ///< CutOutlines::strain() with it; nothing of atlases of many charts
  double price = 1;              ///< of its edges, the mean for each length; 1 where faces may be divided
};

/// Of some cuts, and one more at some places.
struct Previews {
  double strain;  ///< of the cuts that there are
  std::vector<Preview> with;
};

class CutTrials {
 public:
  /// `run`: without limits of distortion.
  CutTrials(const Refinement& run, const ProgressRange& range);

  /// Pieces are best placed anew with every cut, not left where they lie.
  bool places_anew() const { return whole_.atlas.pieces.size() <= kFewCharts; }

  bool has_several_charts() const { return whole_.atlas.pieces.size() > 1; }

  /// What growth of the boundary is multiplied with where cuts are weighed against distortion: a chart with less boundary than a
  /// flat disk of its area cannot be flat, and counts as if it had that disk's.
  double growth_weight() const { return growth_weight_; }

  /// What there is will do.
  bool finishing() const { return run_.monitor.finishing(); }

  const std::vector<int>& mended() const { return whole_.mended; }
  const std::vector<SidePrices>& prices() const { return prices_; }

  /// Of so few triangles that a thorough search takes next to nothing.
  bool is_small() const;
  /// Whether charts that hold the bound once moved are bent as far as that lessens distortion, as pieces are.
  bool relaxes() const;
  /// The first to be asked for.
  SqueezedTrial without_cuts(const ProgressRange& range, const WholeTerms& terms = {});
  /// Of what was forecast; nothing where the bound does not hold.
  std::optional<SqueezedTrial> squeezed(const Trial& trial, const ProgressRange& range) const;

  /// Charts cut into rectangles; nothing where they cannot be.
  std::optional<SqueezedTrial> rectangles(const ProgressRange& range) const;

  /// What sets of cuts come to: a trial for each that can be made, leaves no slivers, adds at most `terms.most_growth` and holds
  /// the bound. Sets of one cut more than `present` may also be left in its layout; it must outlive them.
  std::vector<std::optional<Trial>> forecasts(const std::vector<std::vector<CutPlace>>& sets, const SqueezedTrial* present,
                                              const ForecastTerms& terms, const ProgressRange& range) const;
  /// The same cuts, their pieces packed anew by other random choices; nothing where the bound does not hold.
  std::optional<Trial> packed_again(const Trial& trial, int again) const;

  /// Where one more cut may pay; at most so many across charts, and to points of high curvature.
  std::vector<CutPlace> places(const Trial& present, int straight, int tips) const;
  /// These cuts with others that are nearly mirror images of each other, or of themselves, made so.
  std::vector<std::vector<CutPlace>> symmetric_sets(const std::vector<CutPlace>& cuts) const;
  /// What the pieces are likely to lose, and with each of these cuts. Of cuts that would run along the same edges all but the
  /// first cannot be made.
  Previews previews(const Trial& present, const std::vector<CutPlace>& places) const;

  /// Boundary that a cut adds, roughly, as Trial::growth.
  double growth_of(const CutPlace& place) const;

 private:
  std::optional<std::vector<ChartCuts>> made(const std::vector<CutPlace>& cuts) const;
  std::optional<CutAtlas> atlas_of(const std::vector<ChartCuts>& charts) const;
  std::optional<Trial> forecast(const std::vector<CutPlace>& cuts, const SqueezedTrial* present,
                                const ForecastTerms& terms) const;
  std::optional<CutAtlas> in_place(const std::vector<ChartCuts>& charts, const CutAtlas& atlas,
                                   const SqueezedTrial& present) const;
  bool is_as_it_came(int chart) const;
  std::optional<CutPlace> mirrored(const CutPlace& place, const MirrorImage& mirror) const;
  std::optional<CutPlace> along_mirror(const CutPlace& place, const MirrorImage& mirror) const;
  double growth_of(const std::vector<ChartCuts>& charts) const;
  void preview_along_edges(const std::vector<ChartCuts>& charts, const CutOutlines* outlines, const std::vector<CutPlace>& places,
                           std::vector<Preview>& out) const;
  bool leaves_slivers(const std::vector<ChartCuts>& charts) const;
  void foresee(Forecast forecast, Trial& out) const;
  std::vector<std::vector<Loss>> losses(const CutAtlas& atlas, const Solution& solution) const;
  std::vector<std::vector<Loss>> losses(const CutAtlas& atlas, const Forecast& forecast) const;
  void keep_words(const Journal::Mark& since, SqueezedTrial& out) const;
  Vec2 place_before(const Piece& piece, int vertex) const;

  const Refinement& run_;
  Freedoms freedom_;
  WholeCharts whole_;
  ShapesAsTheyCame shapes_;
  std::vector<SidePrices> prices_;
  std::vector<ChartCuts> uncut_;  // copied sooner than made
  double boundary_;               // of all charts, on the surface
  double growth_weight_ = 1;
  double area_ = 0;    // likewise
  double offset_ = 0;  // E_d less the objective, which other densities, shapes or weights make differ
};

}  // namespace atlas_refine
