// Cuts made one after the other, pieces placed anew, squeezed.
#include "needed/cut_trials.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cut/boundary_places.h"
#include "geometry/boundary.h"
#include "geometry/rest_triangle.h"
#include "input/price_sides.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "needed/measure_trial.h"
#include "needed/symmetric_cuts.h"
#include "place_and_squeeze.h"
#include "placing.h"
#include "rectangles.h"
#include "reduce/goal.h"
#include "reduce/reduce.h"
#include "repair/part_touching.h"
#include "report/locked.h"
#include "seams/lay_apart.h"
#include "support/parallel.h"
#include "support/quantile.h"

namespace atlas_refine {
namespace {

/// Draws borders of one piece that touch along a cut a little apart; false where that does not make it valid.
bool part_along_cuts(const std::vector<ChartCuts>& charts, CutAtlas& atlas) {
  for (Piece& piece : atlas.pieces) {
    if (charts[piece.chart].paths().empty() || certify_charts({piece.mesh}).valid()) continue;
    auto parted = part_touching(piece.mesh);
    if (!parted) return false;
    piece.mesh = std::move(*parted);
  }
  return true;
}

std::vector<Chart> charts_at_density(const Refinement& run) {
  std::vector<Chart> charts = run.input.set.charts;
  set_wanted_density(run, charts);
  return charts;
}

std::string why_rectangles(const RefineOptions& asked, const Trial& trial) {
  const DistortionLimits limits = limits_of(asked);
  if (!limits.any()) return "cut into rectangles: other cuts do not hold the bound, or at a higher price";
  return limits.used(trial.distortion, trial.stretch) <= 1
             ? "cut into rectangles: no fewer seams were found that keep distortion within the limit"
             : "cut into rectangles: other cuts miss the limit by more";
}

}  // namespace

void Bias::learn(const SqueezedTrial& squeezed) {
  const Trial& trial = squeezed.trial;
  if (!std::isfinite(trial.distortion) || trial.distortion <= 1 || trial.foreseen <= 1) return;
  (trial.in_place_of ? in_place : anew) = trial.distortion - trial.foreseen;
  if (trial.foreseen_stretch > 1) stretch = (trial.stretch - 1) / (trial.foreseen_stretch - 1);
}

CutTrials::CutTrials(const Refinement& run, const ProgressRange& range)
    : run_(run),
      freedom_(freedom_of(run.input.set, run.options)),
      whole_(whole_charts(run, range)),
      shapes_(shapes_as_they_came(charts_at_density(run), whole_.atlas, whole_.mended)),
      prices_(price_sides(run.input.atlas, run.input.set, run.options)),
      boundary_(boundary_on_surface(meshes_of(whole_.atlas))) {
  double least_boundary = 0;
  for (const Piece& piece : whole_.atlas.pieces) {
    const double area = piece.mesh.surface.area();
    area_ += area;
    least_boundary += std::max(boundary_on_surface({piece.mesh}), 2 * std::sqrt(std::acos(-1.0) * area));
  }
  if (least_boundary > 0) growth_weight_ = boundary_ / least_boundary;
  prices_.resize(whole_.atlas.pieces.size());
  const std::vector<Piece>& pieces = whole_.atlas.pieces;
  for (std::size_t c = 0; c < pieces.size(); ++c)
    uncut_.emplace_back(pieces[c], run.input.set.charts[c], prices_[c], run.options.cut);
}

bool CutTrials::is_small() const {
  constexpr std::size_t kSmall = 2000;  // triangles
  std::size_t count = 0;
  for (const Piece& piece : whole_.atlas.pieces) count += piece.mesh.triangles.size();
  return count < kSmall && places_anew();
}

bool CutTrials::relaxes() const { return goes_on(run_, whole_.atlas.pieces.size()); }

double CutTrials::growth_of(const std::vector<ChartCuts>& charts) const {
  double length = 0;
  for (const ChartCuts& chart : charts) length += chart.length();
  return boundary_ > 0 ? 2 * length / boundary_ : 0;
}

SqueezedTrial CutTrials::without_cuts(const ProgressRange& range, const WholeTerms& terms) {
  Journal& journal = run_.journal;
  const Journal::Mark before = journal.mark();
  RefineOptions options = run_.options;
  options.seed += terms.again;
  options.relax = options.relax || terms.relax;
  const Refinement run{run_.input, options, run_.monitor, journal, run_.threads, run_.asked};
  SqueezedTrial out{.trial = {}, .solution = place_and_squeeze(run, whole_.atlas, whole_.keeps_place, range)};
  keep_words(before, out);
  journal.back_to({terms.again || terms.relax ? before.repairs : journal.mark().repairs, before.fallbacks, before.warnings});
  measure(run_, out.solution, out.trial);
  const std::vector<Chart> charts = meshes_of(out.solution.atlas);
  const Objective objective = goal_of(run_.input.set.charts, out.solution.atlas, run_.options);
  const double energy = reduce_distortion({.charts = charts, .objective = &objective, .max_iterations = 0}).energy;
  if (std::isfinite(out.trial.distortion)) offset_ = out.trial.distortion - energy;
  const double rough = out.solution.rough_energy;
  out.trial.foreseen = rough > 0 ? offset_ + rough : out.trial.distortion;
  out.trial.foreseen_stretch = out.trial.stretch;
  out.trial.losses = losses(whole_.atlas, out.solution);
  return out;
}

/// Vertices are numbered as in the input.
bool CutTrials::is_as_it_came(int chart) const { return is_whole(whole_.atlas.pieces[chart], run_.input.set.charts[chart]); }

std::optional<std::vector<ChartCuts>> CutTrials::made(const std::vector<CutPlace>& cuts) const {
  std::vector<ChartCuts> out = uncut_;
  for (const CutPlace& cut : cuts) {
    if (!out[cut.chart].add(cut.chord)) return std::nullopt;
  }
  return out;
}

bool CutTrials::leaves_slivers(const std::vector<ChartCuts>& charts) const {
  for (std::size_t c = 0; c < charts.size(); ++c) {
    const double least = kLeastPart * whole_.atlas.pieces[c].mesh.surface.area();
    if (!charts[c].paths().empty() && charts[c].smallest_part() < least) return true;
  }
  return false;
}

/// Nothing where borders of one piece that touch along a cut cannot be drawn apart.
std::optional<CutAtlas> CutTrials::atlas_of(const std::vector<ChartCuts>& charts) const {
  std::vector<SplitMesh> meshes;
  std::vector<SurfacePath> paths;
  for (int c = 0; c < static_cast<int>(charts.size()); ++c) {
    meshes.push_back(charts[c].mesh());
    for (const std::vector<int>& path : charts[c].paths()) paths.push_back({c, path});
  }
  const std::vector<Chart>& sources = run_.input.set.charts;
  const auto& points = run_.input.set.points;
  if (std::any_of(charts.begin(), charts.end(), [](const ChartCuts& cuts) { return cuts.divides_border(); }))
    follow_divided(match_boundaries(meshes, points), paths);
  CutAtlas out = cut_along(divided_atlas(meshes, sources, points), sources, paths);
  restore_shapes(shapes_, out);
  if (!part_along_cuts(charts, out)) return std::nullopt;
  return out;
}

/// The pieces in the layout of the present state; nothing where they would cross or touch there.
std::optional<CutAtlas> CutTrials::in_place(const std::vector<ChartCuts>& charts, const CutAtlas& atlas,
                                            const SqueezedTrial& present) const {
  const Solution& solution = present.solution;
  if (solution.end.box.isZero()) return std::nullopt;  // only moved
  const Vec2 box = solution.atlas.frame.isZero() ? solution.end.box : solution.atlas.frame;
  const double gap = solution.gap.length(box);
  const Freedoms freedom = freedom_of_pieces(freedom_, atlas);
  for (const double apart : {2.0, 6.0}) {  // times the gap: a cut at a slant needs more
    CutAtlas out = lay_apart(atlas, solution.atlas, run_.input.set.charts, apart * gap);
    if (!part_along_cuts(charts, out)) return std::nullopt;
    const std::vector<Chart> pieces = meshes_of(out);
    if (!certify_charts(pieces, points_in_space(out, run_.input.set.points), freedom).valid()) continue;
    if (gap_between_charts(pieces, freedom) > gap) return out;
  }
  return std::nullopt;
}

/// What was told since then.
void CutTrials::keep_words(const Journal::Mark& since, SqueezedTrial& out) const {
  const std::vector<std::string>&fallbacks = run_.journal.fallbacks, &warnings = run_.journal.warnings;
  out.fallbacks.assign(fallbacks.begin() + static_cast<std::ptrdiff_t>(since.fallbacks), fallbacks.end());
  out.warnings.assign(warnings.begin() + static_cast<std::ptrdiff_t>(since.warnings), warnings.end());
}

std::optional<SqueezedTrial> CutTrials::squeezed(const Trial& trial, const ProgressRange& range) const {
  const auto charts = made(trial.cuts);
  const auto atlas = charts ? atlas_of(*charts) : std::nullopt;
  if (!atlas) return std::nullopt;
  Journal& journal = run_.journal;
  const Journal::Mark before = journal.mark();
  std::optional<Solution> solution;
  journal.begin_stage("squeeze", range);
  const auto laid = trial.in_place_of ? in_place(*charts, *atlas, *trial.in_place_of) : std::nullopt;
  if (trial.forecast) solution = squeeze_as_forecast(run_, laid ? *laid : *atlas, *trial.forecast);
  if (!solution)
    solution = laid ? squeeze_in_place(run_, *laid, trial.in_place_of->solution) : place_and_squeeze_cut(run_, *atlas, range);
  std::optional<SqueezedTrial> out;
  if (solution) {
    out = SqueezedTrial{.trial = trial, .solution = std::move(*solution)};
    out->trial.forecast.reset();
    measure(run_, out->solution, out->trial);
    out->trial.losses = losses(*atlas, out->solution);
    keep_words(before, *out);
    if (trial.in_place_of) out->warnings = trial.in_place_of->warnings;
  }
  journal.back_to(before);
  return out;
}

std::optional<SqueezedTrial> CutTrials::rectangles(const ProgressRange& range) const {
  Journal& journal = run_.journal;
  const Journal::Mark before = journal.mark();
  Attempt attempt = refine_by_rectangles(run_, range);
  std::optional<SqueezedTrial> out;
  if (attempt.solution) {
    out = SqueezedTrial{.trial = {}, .solution = std::move(*attempt.solution)};
    if (out->solution.rectangles) out->trial.trails = out->solution.rectangles->trails;
    out->trial.growth = boundary_on_surface(meshes_of(out->solution.atlas)) / boundary_ - 1;
    measure(run_, out->solution, out->trial);
    out->trial.foreseen = out->trial.distortion;
    keep_words(before, *out);
    out->fallbacks.push_back(why_rectangles(run_.asked, out->trial));
  }
  journal.back_to(before);
  return out;
}

void CutTrials::foresee(Forecast forecast, Trial& out) const {
  out.foreseen = out.distortion = offset_ + forecast.end.outcome.energy;
  out.stretch = out.foreseen_stretch = forecast.stretch;
  out.forecast = std::move(forecast);
}

std::optional<Trial> CutTrials::forecast(const std::vector<CutPlace>& cuts, const SqueezedTrial* present,
                                         const ForecastTerms& terms) const {
  const auto charts = made(cuts);
  if (!charts || leaves_slivers(*charts)) return std::nullopt;
  Trial out{.cuts = cuts, .growth = growth_of(*charts)};
  if (out.growth > terms.most_growth) return std::nullopt;
  const auto atlas = atlas_of(*charts);
  if (!atlas) return std::nullopt;
  const Refinement run{run_.input, run_.options, run_.monitor, run_.journal, 1, run_.asked};  // they run side by side
  // A chart alone that is cut is best placed anew; of many charts the layout is worth more than what another would gain.
  const auto laid =
      present && (charts->size() > 1 || !present->trial.cuts.empty()) ? in_place(*charts, *atlas, *present) : std::nullopt;
  const Bias& bias = terms.bias;
  auto left = laid ? forecast_in_place(run, *laid, present->solution) : std::nullopt;
  auto moved = !left || charts->size() <= kFewCharts ? forecast_anew(run, *atlas) : std::nullopt;
  if (!left && !moved) return std::nullopt;
  const bool stays = left && (!moved || left->end.outcome.energy + bias.in_place <= moved->end.outcome.energy + bias.anew);
  if (stays) out.in_place_of = present;
  foresee(std::move(stays ? *left : *moved), out);
  out.losses = losses(*atlas, *out.forecast);
  return out;
}

std::vector<std::optional<Trial>> CutTrials::forecasts(const std::vector<std::vector<CutPlace>>& sets,
                                                       const SqueezedTrial* present, const ForecastTerms& terms,
                                                       const ProgressRange& range) const {
  run_.journal.begin_stage("layout", range);
  std::vector<std::optional<Trial>> out(sets.size());
  parallel_ranges(static_cast<int>(sets.size()), run_.threads, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const bool is_more = present && sets[k].size() > present->trial.cuts.size();
      out[k] = forecast(sets[k], is_more ? present : nullptr, terms);
    }
  });
  return out;
}

std::optional<Trial> CutTrials::packed_again(const Trial& trial, int again) const {
  const auto charts = made(trial.cuts);
  const auto atlas = charts ? atlas_of(*charts) : std::nullopt;
  if (!atlas) return std::nullopt;
  RefineOptions options = run_.options;
  options.seed += again;
  auto forecast = forecast_anew({run_.input, options, run_.monitor, run_.journal, run_.threads, run_.asked}, *atlas);
  if (!forecast) return std::nullopt;
  Trial out{.cuts = trial.cuts, .growth = trial.growth};
  foresee(std::move(*forecast), out);
  return out;
}

/// Where a vertex of a cut piece lies in the chart as repaired.
Vec2 CutTrials::place_before(const Piece& piece, int vertex) const {
  if (shapes_.uvs[piece.chart].empty()) return piece.mesh.uvs[vertex];
  return value_at(piece.supports[vertex], whole_.atlas.pieces[piece.chart].mesh.uvs);
}

/// What each triangle has lost in the solution, times its area; `atlas`: the pieces before they were squeezed.
std::vector<std::vector<Loss>> CutTrials::losses(const CutAtlas& atlas, const Solution& solution) const {
  std::vector<std::vector<Loss>> out(whole_.atlas.pieces.size());
  const double scale = dirichlet_sums(meshes_of(solution.atlas)).best_scale();
  for (std::size_t p = 0; p < atlas.pieces.size(); ++p) {
    const Piece& piece = atlas.pieces[p];
    const std::vector<double> lost = triangle_losses(solution.atlas.pieces[p].mesh, scale);
    for (std::size_t t = 0; t < lost.size(); ++t) {
      const auto [a, b, c] = piece.mesh.triangles[t];
      out[piece.chart].push_back(
          {(place_before(piece, a) + place_before(piece, b) + place_before(piece, c)) / 3, lost[t] / area_});
    }
  }
  return out;
}

std::vector<std::vector<Loss>> CutTrials::losses(const CutAtlas& atlas, const Forecast& forecast) const {
  std::vector<std::vector<Loss>> out(whole_.atlas.pieces.size());
  for (const Forecast::Loss& loss : forecast.losses) {
    const Piece& piece = atlas.pieces[loss.chart];
    const auto [a, b, c] = loss.corners;
    out[piece.chart].push_back({(place_before(piece, a) + place_before(piece, b) + place_before(piece, c)) / 3, loss.amount});
  }
  return out;
}

std::vector<CutPlace> CutTrials::places(const Trial& present, int straight, int tips) const {
  const auto charts = made(present.cuts);
  std::vector<ChartState> states;
  for (std::size_t c = 0; c < charts->size(); ++c)
    states.push_back({bends(freedom_, c) ? &(*charts)[c] : nullptr, &whole_.atlas.pieces[c].mesh, present.losses[c]});
  return cut_places(states, straight, tips);
}

/// Where the mirror image of a cut runs; nothing where the surface, or the chart there, has none.
std::optional<CutPlace> CutTrials::mirrored(const CutPlace& place, const MirrorImage& mirror) const {
  const auto a = mirror.of({place.chart, place.chord.ends[0]}), b = mirror.of({place.chart, place.chord.ends[1]});
  if (!a || !b || a->chart != b->chart || !is_as_it_came(place.chart) || !is_as_it_came(a->chart)) return std::nullopt;
  const std::vector<Vec2>& uvs = whole_.atlas.pieces[a->chart].mesh.uvs;
  CutPlace out{a->chart, place.chord, place.released};
  out.chord.ends = {a->vertex, b->vertex};
  out.chord.at = {uvs[a->vertex], uvs[b->vertex]};
  return out;
}

/// Between vertices that are their own images, ends on the border where they were on it.
std::optional<CutPlace> CutTrials::along_mirror(const CutPlace& place, const MirrorImage& mirror) const {
  if (!is_as_it_came(place.chart)) return std::nullopt;
  const Chart& chart = whole_.atlas.pieces[place.chart].mesh;
  const std::vector<char> on_border = boundary_flags(chart);
  CutPlace out = place;
  for (std::size_t end = 0; end < 2; ++end) {
    double nearest = std::numeric_limits<double>::infinity();
    for (int v = 0; v < chart.vertex_count(); ++v) {
      const double away = (chart.uvs[v] - place.chord.at[end]).norm();
      if (away >= nearest || on_border[v] != on_border[place.chord.ends[end]]) continue;
      const auto image = mirror.of({place.chart, v});
      if (!image || image->chart != place.chart || image->vertex != v) continue;
      nearest = away;
      out.chord.ends[end] = v;
      out.chord.at[end] = chart.uvs[v];
    }
    if (!std::isfinite(nearest)) return std::nullopt;
  }
  if (out.chord.ends[0] == out.chord.ends[1]) return std::nullopt;
  return out;
}

std::vector<std::vector<CutPlace>> CutTrials::symmetric_sets(const std::vector<CutPlace>& cuts) const {
  if (cuts.empty()) return {};
  const MirrorImage mirror(run_.input.atlas, run_.input.set);
  return atlas_refine::symmetric_sets(cuts, {[&](const CutPlace& place) { return mirrored(place, mirror); },
                                             [&](const CutPlace& place) { return along_mirror(place, mirror); }});
}

/// Edges seldom run straight: only the way along them tells how long a cut is, and what it leaves.
void CutTrials::preview_along_edges(const std::vector<ChartCuts>& charts, const CutOutlines* outlines,
                                    const std::vector<CutPlace>& places, std::vector<Preview>& out) const {
  std::vector<std::vector<int>> paths(places.size());
  parallel_ranges(static_cast<int>(places.size()), run_.threads, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const CutPlace& place = places[k];
      const ChartCuts& present = charts[place.chart];
      ChartCuts cuts = present;
      out[k].growth = std::numeric_limits<double>::infinity();
      if (!cuts.add(place.chord)) continue;
      paths[k] = cuts.paths().back();
      if (paths[k].front() > paths[k].back()) std::reverse(paths[k].begin(), paths[k].end());
      const double length = cuts.length() - present.length();
      if (boundary_ > 0) out[k].growth = 2 * length / boundary_;
      if (length > 0) out[k].price = (cuts.cost() - present.cost()) / length;
      if (outlines) out[k].strain = outlines->strain_with(place.chart, cuts);
    }
  });
  for (std::size_t k = 0; k < places.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      if (places[j].chart == places[k].chart && paths[j] == paths[k]) out[k].growth = std::numeric_limits<double>::infinity();
    }
  }
}

Previews CutTrials::previews(const Trial& present, const std::vector<CutPlace>& places) const {
  Previews out{.strain = 0, .with = {}};
  for (const CutPlace& place : places) out.with.push_back({growth_of(place), std::nullopt});
  const auto charts = made(present.cuts);
  if (!charts) return out;
  std::optional<CutOutlines> outlines;
  if (!any_fixed(freedom_) && places_anew()) outlines.emplace(run_.options, *charts, shapes_);
  if (outlines) out.strain = outlines->strain();
  if (run_.options.cut == Cut::Edges) {
    preview_along_edges(*charts, outlines ? &*outlines : nullptr, places, out.with);
  } else if (outlines) {
    parallel_ranges(static_cast<int>(places.size()), run_.threads, 1, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) out.with[k].strain = outlines->strain_with(places[k]);
    });
  }
  // Once there are cuts most others change next to nothing: what they come to tells more than one rough packing without any.
  std::vector<double> told;
  for (const Preview& preview : out.with) {
    if (preview.strain) told.push_back(*preview.strain);
  }
  if (!present.cuts.empty() && !told.empty()) out.strain = std::min(out.strain, quantile(std::move(told), 0.75));
  return out;
}

double CutTrials::growth_of(const CutPlace& place) const {
  const Chart& chart = whole_.atlas.pieces[place.chart].mesh;
  return boundary_ > 0 ? 2 * place.chord.length() / (texel_density(chart) * boundary_) : 0;
}

}  // namespace atlas_refine
