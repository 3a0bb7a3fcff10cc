// Whether there is anything to do for one atlas, and what is told of what was done.
#include "one_atlas.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "atlas_refine/error.h"
#include "geometry/boundary.h"
#include "input/check_atlas.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "placing.h"
#include "reduce/kept_density.h"
#include "report/certify.h"
#include "report/locked.h"
#include "report/shortfall.h"
#include "report/texture.h"
#include "support/parallel.h"
#include "take_road.h"

namespace atlas_refine {
namespace {

/// How much larger the UVs are to be; 1 where nothing is asked.
double growth_asked(const InputAtlas& input, const RefineOptions& options) {
  const double height = 1 - 2 * border_of(options);  // of the box within the border, in which the charts are told
  return options.uv_density == 0 ? 1 : options.uv_density / (texel_density(input.set.charts) * height);
}

bool has_density(const InputAtlas& input, const RefineOptions& options) {
  return std::abs(growth_asked(input, options) - 1) <= input.size_rounding;
}

/// Valid and, where the box is the texture, within its border: only then PE tells how good it is.
bool is_sound(const InputAtlas& input, const Freedoms& freedom, const RefineOptions& options, const RefineOptions& within) {
  if (!validate_split(input.set, freedom).valid()) return false;
  const double slack = border_of(options) > 0 ? 2 * kBorderSpare : 0;
  return !is_in_texture(freedom, options) || lies_in_texture(charts_as_placed(input.set), freedom, within.box_aspect, slack);
}

/// The input is, but for its size, sound and at the bound; a gap counts only where one was asked for. `within`: options for the
/// box within the border.
bool holds_already(const InputAtlas& input, const Freedoms& freedom, const RefineOptions& options, const RefineOptions& within) {
  const Measures& before = input.measures;
  if (before.pe_fixed_aspect < options.pe_bound || !within_limits(options, before)) return false;
  if (!is_sound(input, freedom, options, within)) return false;
  const double aspect = options.box_aspect, border = border_of(options);
  const Vec2 box = is_in_texture(freedom, options) ? Vec2(aspect, 1) : box_of_aspect(uv_box(input.set.charts), aspect).size();
  const double scale = options.in_texture ? growth_asked(input, options) : 1;
  const double between = scale * (1 - 2 * border) * gap_between_charts(input.set.charts, freedom);
  return !options.gap || between * input.spare >= options.gap->length(box);
}

/// An automatic gap asks nothing of an atlas that is left as it is.
Gap own_gap(const InputAtlas& input, const RefineOptions& options) {
  return options.gap ? at_size(input, *options.gap) : Gap{std::min(Gap{}.value, input.measures.gap_between)};
}

Outcome unchanged(const InputAtlas& input, const RefineOptions& options) {
  Outcome out{
      .before = input.measures, .after = input.measures, .triangulations = count_readings(input.set.readings), .bound_met = true};
  out.gap = own_gap(input, options);
  out.charts = reports_of_input(input);
  return out;
}

void note_mirrored(const InputAtlas& input, Journal& journal) {
  std::vector<int> mirrored;
  for (std::size_t c = 0; c < input.set.mirrored.size(); ++c) {
    if (input.set.mirrored[c]) mirrored.push_back(input.set.charts[c].number);
  }
  if (!mirrored.empty()) journal.repairs.push_back({.what = "mirrored, turned over", .charts = mirrored});
}

/// Nothing is asked of an input that holds already, but another size. Charts that are turned over need places of their own.
bool is_only_scaled(const InputAtlas& input) {
  const auto& mirrored = input.set.mirrored;
  return std::find(mirrored.begin(), mirrored.end(), true) == mirrored.end();
}

/// What holds all that is asked may be cut all the same where that pays, and a trade-off is wanted whatever holds.
bool may_be_cut(const RefineOptions& options, const Measures& before) {
  constexpr double kWorthASearch = 0.005;  // of E_d: a cut of a tenth of that growth saves no more
  if (options.seams != Seams::Needed) return false;
  return options.trade_off || (!limits_of(options).any() && before.distortion > 1 + kWorthASearch);
}

/// Whether the cuts save what their seams cost, against an input that holds all that is asked.
bool pays(const InputAtlas& input, const RefineOptions& options, const CertifiedSolution& result) {
  if (!may_be_cut(options, input.measures)) return result.atlas.after.distortion < input.measures.distortion;
  if (options.point) return true;
  if (result.solution.intervention != Intervention::Cut) return false;
  const double before = boundary_on_surface(input.set.charts), after = boundary_on_surface(meshes_of(result.solution.atlas));
  const double growth = before > 0 ? after / before - 1 : 0;
  return result.atlas.after.distortion + options.seam_cost * growth < input.measures.distortion;
}

Solution as_it_lies(const InputAtlas& input, const RefineOptions& options) {
  Solution out{.atlas = whole_atlas(input.set.charts), .gap = own_gap(input, options)};
  if (!options.gap && options.in_texture) {
    constexpr double kRounding = 0.999;
    const double length = growth_asked(input, options) * gap_between_charts(input.set.charts, freedom_of(input.set, options));
    const double most = kRounding * length / Vec2(options.box_aspect, 1).norm();
    out.gap.value = std::min(out.gap.value, most);
  }
  out.gap.value *= input.spare;  // as if it were packed
  return out;
}

Outcome outcome_of(const InputAtlas& input, const RefineOptions& options, CertifiedSolution certified) {
  Solution& solution = certified.solution;
  Outcome out{.before = input.measures,
              .after = certified.atlas.after,
              .seams = certified.atlas.seams,
              .triangulations = certified.atlas.triangulations,
              .intervention = solution.intervention,
              .gap = solution.gap,
              .price = solution.price,
              .ended = solution.ended,
              .rectangles = solution.rectangles,
              .cuts = std::move(solution.cuts),
              .charts = std::move(certified.atlas.charts),
              .pieces = std::move(certified.atlas.pieces)};
  const std::string missed = shortfall(input, options, out.after, certified.atlas.stored, solution.outgrown);
  out.bound_met = missed.empty();
  // Where cuts are allowed limits of distortion are a goal like the bound, else they are what the effort must keep.
  const bool acceptable = options.seams == Seams::Needed || within_limits(options, out.after);
  const bool takes_less = options.best_effort || out.ended == Ended::Stopped;
  if (!out.bound_met && !(takes_less && acceptable)) throw RefineError(ErrorCode::BoundNotReached, "squeeze", missed);
  for (int c : solution.re_embedded) out.charts[c].re_embedded = true;
  out.atlas = std::move(solution.atlas);
  out.uvs = std::move(certified.atlas.uvs);
  return out;
}

/// Per chart that is not fixed its texel density by what was wanted of it: with Density::Keep what it was. Those of half of the
/// surface are below 1: a single chart whose area was no measure does not change what is told of the others.
std::vector<std::pair<int, double>> density_changes(const InputAtlas& input, const RefineOptions& options,
                                                    const std::vector<ChartReport>& charts) {
  const Freedoms freedom = freedom_of(input.set, options);
  std::vector<std::pair<int, double>> out;
  std::vector<std::pair<double, double>> with_area;
  double half = 0;
  for (int c = 0; c < static_cast<int>(charts.size()); ++c) {
    if (is_fixed(freedom, c) || !(charts[c].density_before > 0)) continue;
    out.emplace_back(c, charts[c].density_after / (options.density == Density::Keep ? charts[c].density_before : 1));
    with_area.emplace_back(out.back().second, charts[c].area);
    half += 0.5 * charts[c].area;
  }
  std::sort(with_area.begin(), with_area.end());
  double below = 0, usual = 1;
  for (std::size_t k = 0; k < with_area.size() && below < half; below += with_area[k++].second) usual = with_area[k].first;
  for (auto& change : out) change.second /= usual;
  return out;
}

/// Of charts whose texel density has changed all the same, or is not that of the others as it was to be.
void warn_of_density(const InputAtlas& input, const RefineOptions& options, const std::vector<ChartReport>& charts,
                     Journal& journal) {
  const bool keeps = options.density == Density::Keep;
  const double notable = keeps ? 1.1 : kMostDense;
  std::vector<int> changed;
  double least = 1, most = 1;
  for (const auto& [c, times] : density_changes(input, options, charts)) {
    if (times > notable || times < 1 / notable) changed.push_back(input.set.charts[c].number);
    least = std::min(least, times);
    most = std::max(most, times);
  }
  if (changed.empty()) return;
  const std::string down = least < 1 / notable ? "down to " + number_text("%.2f", least) : "";
  const std::string up = most > notable ? "up to " + number_text("%.2f", most) : "";
  journal.warnings.push_back(charts_named(changed) + (keeps ? ": bent or mended" : ": bent") + ", with a texel density " + down +
                             (down.empty() || up.empty() ? "" : " and ") + up +
                             (keeps ? " times what it was" : " times that of the others"));
}

void warn_of_end(const Solution& solution, Journal& journal) {
  if (solution.held > 0) journal.warnings.push_back(words_on_held(solution.held));
  if (solution.outgrown > 0) journal.warnings.push_back("the bound was not reached; " + words_on_outgrown(solution.outgrown));
  const char* why = solution.ended == Ended::Stalled && solution.outgrown == 0 ? "stalled"
                    : solution.ended == Ended::OutOfIterations                 ? "ran out of iterations"
                    : solution.ended == Ended::Stopped                         ? "was stopped"
                                                                               : nullptr;
  if (why) journal.warnings.push_back(std::string("the optimisation ") + why + ": the distortion may not be at its least");
}

/// True where an atlas that was stopped at is worth more than the input.
bool better_than_input(const InputAtlas& input, const Freedoms& freedom, const RefineOptions& options,
                       const RefineOptions& within, const Measures& after) {
  if (!within_limits(options, after)) return false;
  return after.pe_fixed_aspect >= options.pe_bound || after.pe_fixed_aspect > input.measures.pe_fixed_aspect ||
         !is_sound(input, freedom, options, within);
}

/// Stopped before anything better than the input was found.
Outcome stopped(const InputAtlas& input, const RefineOptions& options, bool holds, Journal& journal) {
  const std::string why = "stopped before a better atlas was found";
  journal.warnings.push_back(why + ": it is left as it is");
  Outcome out = holds ? unchanged(input, options) : left_as_it_is(input, options, why);
  out.ended = Ended::Stopped;
  return out;
}

/// There is nothing to move.
Outcome all_locked(const InputAtlas& input, const RefineOptions& options, bool holds) {
  Outcome out = unchanged(input, options);
  out.bound_met = holds;
  if (!holds && !(options.best_effort && within_limits(options, input.measures)))
    throw RefineError(ErrorCode::BoundNotReached, "input", shortfall(input, options, input.measures, input.set.charts, 0));
  return out;
}

/// Faces that are valid in one reader and flipped in another.
void warn_of_polygons(const CertifiedAtlas& result, Journal& journal) {
  const auto faces = [](int count) { return std::to_string(count) + (count == 1 ? " face is" : " faces are"); };
  const Triangulations& by = result.triangulations;
  if (by.not_convex > 0)
    journal.warnings.push_back(faces(by.not_convex) + " not convex in the UV map, valid only where divided as here; " +
                               std::to_string(by.fan_flipped) + " of them would be flipped as a fan");
  if (result.worse_faces > 0)
    journal.warnings.push_back(faces(result.worse_faces) + " no longer valid under every division that was valid in the input");
}

/// Pieces whose faces are all wound against the rest of their chart lie as these did in it; by themselves they are mirrored.
void warn_of_mirrored(const CertifiedAtlas& result, Journal& journal) {
  const int count = result.mirrored_pieces;
  if (count > 0)
    journal.warnings.push_back(std::to_string(count) + (count == 1 ? " piece is" : " pieces are") +
                               " mirrored: the faces of the chart are wound both ways; make their normals agree first");
}

}  // namespace

Outcome left_as_it_is(const InputAtlas& input, const RefineOptions& options, std::string reason) {
  Outcome out = unchanged(input, options);
  out.bound_met = false;
  out.gap = Gap{std::min(Gap{}.value, input.measures.gap_between)};
  out.reason = std::move(reason);
  return out;
}

Outcome refine_one(const InputAtlas& input, const RefineOptions& options, const ProgressRange& range, Monitor& monitor,
                   Journal& journal) {
  note_mirrored(input, journal);
  const Freedoms freedom = freedom_of(input.set, options);
  const RefineOptions within = within_border(options);
  const bool holds_but_size = holds_already(input, freedom, options, within);
  const bool holds = holds_but_size && has_density(input, options);
  const bool stays = !options.relax && !may_be_cut(options, input.measures);
  if (holds && stays) return unchanged(input, options);
  if (all_fixed(freedom)) return all_locked(input, options, holds);
  if (monitor.finishing()) return stopped(input, options, holds, journal);

  const Refinement run{input, within, monitor, journal, resolve_threads(options.threads), options};
  const Journal::Mark before = journal.mark();
  CertifiedSolution result = holds_but_size && stays && is_only_scaled(input) ? certified(run, as_it_lies(input, options), range)
                                                                              : take_road(run, range);
  if (result.solution.ended == Ended::Stopped && !better_than_input(input, freedom, options, within, result.atlas.after)) {
    journal.back_to(before);
    return stopped(input, options, holds, journal);
  }
  if (holds && !pays(input, options, result)) {
    journal.back_to(before);
    Outcome out = unchanged(input, options);
    out.cuts = std::move(result.solution.cuts);
    return out;
  }
  journal.show(to_string(result.solution.intervention), result.atlas.stored);
  warn_of_end(result.solution, journal);
  warn_of_density(input, options, result.atlas.charts, journal);
  warn_of_polygons(result.atlas, journal);
  warn_of_mirrored(result.atlas, journal);
  return outcome_of(input, options, std::move(result));
}

}  // namespace atlas_refine
