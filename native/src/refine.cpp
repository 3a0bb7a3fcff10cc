// The whole method, top to bottom: charts, who takes part, each atlas by itself, all put together again.
#include "atlas_refine/refine.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "atlas_refine/error.h"
#include "geometry/boundary.h"
#include "input/check_atlas.h"
#include "input/join_edges.h"
#include "input/leaders_triangles.h"
#include "input/take_part.h"
#include "input/unwrap_tiles.h"
#include "one_atlas.h"
#include "report/assemble.h"
#include "report/kept_faces.h"
#include "report/locked.h"
#include "report/note_repairs.h"
#include "report/options.h"
#include "report/outcome.h"
#include "report/texture.h"
#include "report/tiles.h"
#include "report/wished_edges.h"
#include "support/monitor.h"
#include "support/parallel.h"
#include "support/profile.h"
#include "support/thread_pool.h"

namespace atlas_refine {
namespace {

constexpr ProgressRange kInput = {0, 0.02};
constexpr ProgressRange kAtlases = {0.02, 1};

Vec2 origin_of(const Part& part, const RefineOptions& options) {
  const bool given = part.group < static_cast<int>(options.group_origins.size());
  return given ? options.group_origins[part.group] : Vec2(Vec2::Zero());
}

RefineError named(const RefineError& error, const Part& part, const RefineOptions& options) {
  if (options.groups.empty()) return error;
  return {error.code(), error.stage(), name_of(part.group, options) + ": " + error.what(), error.chart(), error.face()};
}

/// One atlas, without the charts that cannot be made valid: those are left as they are. Nothing where none remains. Where no
/// result of it holds and `failure` is given, it stays as it is, and that says why.
std::optional<Outcome> refine_mendable(const InputAtlas& whole, const RefineOptions& of_all, const ProgressRange& range,
                                       Monitor& monitor, Journal& journal, Part& part, std::vector<LeftChart>& left,
                                       std::optional<RefineError>& failure) {
  const Journal::Mark mark = journal.mark();
  journal.of_box(options_of_group(of_all, part.group).box_aspect);
  bool ample = of_all.relax || of_all.seams != Seams::None;
  while (!part.charts.empty()) {
    RefineOptions options = options_of_group(of_all, part.group);
    InputAtlas input = part_of(whole, part.charts, options.box_aspect);
    input.origin = origin_of(part, options);
    options = settle_density(std::move(options), input, journal, ample);
    put_in_texture(input, options);
    try {
      return refine_one(input, options, range, monitor, journal);
    } catch (const RefineError& error) {
      if (error.code() == ErrorCode::Cancelled) throw;
      if (error.code() == ErrorCode::NotCertified && input.gap_of_texture) {
        ample = true;
        journal.back_to(mark);
        continue;
      }
      if (!failure) failure = named(error, part, options);
      journal.back_to(mark);
      journal.warnings.push_back("keeps its UVs: " + std::string(error.what()));
      return left_as_it_is(input, options, error.what());
    } catch (const UnmendedCharts& unmended) {
      journal.back_to(mark);
      for (const LeftChart& chart : unmended.charts) {
        std::erase(part.charts, chart.chart);
        left.push_back(chart);
      }
    }
  }
  return std::nullopt;
}

/// Each atlas by itself, one after the other; each has its part of the progress by its number of charts. Those that fail stay
/// as they are, unless all do.
std::vector<Done> refine_parts(const InputAtlas& whole, Participants& participants, const RefineOptions& options,
                               Monitor& monitor, Journal& journal) {
  std::vector<Done> done;
  const double all = static_cast<double>(whole.set.charts.size() - participants.left.size() - participants.followers.size());
  double before = 0;
  std::optional<RefineError> failure;  // the first
  for (Part& part : participants.parts) {
    const double after = before + static_cast<double>(part.charts.size()) / all;
    const Journal::Mark mark = journal.mark();
    auto outcome =
        refine_mendable(whole, options, kAtlases.part(before, after), monitor, journal, part, participants.left, failure);
    if (outcome) done.push_back({part, std::move(*outcome)});
    if (participants.parts.size() > 1) journal.prefix_from(mark, name_of(part.group, options) + ": ");
    before = after;
  }
  const auto failed = [](const Done& part) { return !part.outcome.reason.empty(); };
  if (failure && std::all_of(done.begin(), done.end(), failed)) throw RefineError(*failure);
  if (done.empty() && !participants.parts.empty()) {
    const LeftChart& first = participants.left.back();
    throw RefineError(ErrorCode::BadInput, "repair",
                      message_prefix(whole.atlas) + "chart " + std::to_string(first.chart) + " " + first.reason, first.chart,
                      whole.set.charts[first.chart].triangle_faces.front());
  }
  return done;
}

std::vector<RefinedPart> refined_parts(std::vector<Done>& done) {
  std::vector<RefinedPart> out;
  for (auto& [part, outcome] : done) {
    const bool changed = outcome.intervention != Intervention::Unchanged;
    out.push_back({part.charts, changed, std::move(outcome.atlas), std::move(outcome.uvs)});
  }
  return out;
}

/// What was written is tested as it stands; charts that keep their UVs may keep their noise.
Joining joining_after(const Participants& participants, const std::vector<Done>& done) {
  const auto changed = [](const Done& part) { return part.outcome.intervention != Intervention::Unchanged; };
  return participants.left.empty() && std::all_of(done.begin(), done.end(), changed) ? Joining::Exact : Joining::AsMeant;
}

/// Where one atlas is all there is the certificate has counted them.
SeamCount seams_of(const Atlas& result, const Participants& participants, const std::vector<Done>& done) {
  const Joining joining = joining_after(participants, done);
  const bool certified = joining == Joining::Exact && done.size() == 1 && participants.followers.empty();
  return certified ? done.front().outcome.seams : seams_of(join_edges(result, joining));
}

/// One flag per face where either has one; empty where neither has any.
std::vector<char> either(const std::vector<char>& one, const std::vector<char>& other) {
  std::vector<char> out = one.empty() ? other : one;
  for (std::size_t f = 0; f < other.size(); ++f) out[f] = out[f] || other[f];
  return out;
}

/// Followers whose leaders were cut in a way that they cannot follow.
void set_apart(const InputAtlas& whole, const Participants& participants, const std::vector<Done>& done, std::set<int>& apart) {
  std::vector<int> pieces(whole.set.charts.size(), 0);
  std::vector<char> cut(whole.set.charts.size(), 0);
  for (const auto& [part, outcome] : done) {
    for (const Piece& piece : outcome.atlas.pieces) {
      const int k = part.charts[piece.chart];
      cut[k] = cut[k] || ++pieces[k] > 1 || !is_whole(piece, whole.set.charts[k]);
    }
  }
  for (const Follower& follower : participants.followers) {
    if (cut[follower.leader] && !follower.same_polygons) apart.insert(follower.chart);
  }
}

/// All atlases of the call. Only where a chart is really cut those on it whose polygons are others get a place of their own, and
/// the atlases are refined anew with them.
std::pair<Participants, std::vector<Done>> refine_with_stacks(InputAtlas& whole, const std::vector<char>& has_uvs,
                                                              const RefineOptions& options, Monitor& monitor, Journal& journal) {
  const Journal::Mark mark = journal.mark();
  std::set<int> apart;
  while (true) {
    Participants participants = take_part(whole.set, options, has_uvs, apart);
    for (const Follower& follower : participants.followers) {
      if (follower.same_polygons) divide_as_leader(whole.atlas, follower, whole.set);
    }
    std::vector<Done> done =
        refine_parts(whole, participants, with_kept_leaders(whole.set, participants.followers, options), monitor, journal);
    const std::size_t before = apart.size();
    set_apart(whole, participants, done, apart);
    if (apart.size() == before) return {std::move(participants), std::move(done)};
    journal.back_to(mark);
  }
}

RefineResult refine_atlas(const Atlas& input, const std::vector<char>& has_uvs, const RefineOptions& options, Monitor& monitor,
                          Journal& journal) {
  journal.begin_stage("input", kInput);
  const UnwrappedTiles tiles = unwrap_tiles(input, options.groups, either(options.locked, options.keep_shape));
  std::optional<Atlas> moved;
  if (!tiles.faces.empty()) (moved = input)->corner_uvs = tiles.corner_uvs;
  const Atlas& atlas = moved ? *moved : input;
  InputAtlas whole = read_atlas(atlas, options);
  journal.show("input", charts_as_placed(whole.set));
  auto [participants, done] = refine_with_stacks(whole, has_uvs, options, monitor, journal);
  RefineResult result;
  summarise(whole, participants, options, done, result);
  tell_of(participants, done, journal);
  tell_of_missing_edges(atlas, options, journal);
  const std::vector<int> parted = tell_of_folds(whole.set, participants, done, journal);
  AssembledAtlas assembled =
      assemble(whole, participants, refined_parts(done),
               {.stored = options.stored, .divide = divides_faces(options), .triangulate = options.triangulate});
  if (!tiles.faces.empty()) restore_left(input, whole.set, participants, assembled);
  const SeamCount seams = options.groups.empty() ? seams_of(whole.set) : seams_of(join_edges(atlas, Joining::AsMeant));
  measure_seams(input, tiles.faces.empty() ? seams : seams_of(join_edges(input, Joining::AsMeant)), result.before);
  const SeamCount torn = seams_of(assembled.mesh, participants, done);
  measure_seams(assembled.mesh, torn, result.after);
  const int between_groups = whole.set.seam_edges - seams.edges;
  if (between_groups > 0)
    journal.warnings.push_back("charts of several groups were parted along " + std::to_string(between_groups) +
                               (between_groups == 1 ? " edge" : " edges"));
  const double boundary = boundary_on_surface(whole.set.charts);
  // Where charts lie on each other in space an edge is torn in each of them.
  result.boundary_growth = boundary > 0 ? std::max(0.0, (torn.open - seams.open) / boundary) : 0;
  result.added_seams = assembled.cut_edges + static_cast<int>(parted.size()) + between_groups;
  result.corner_uvs = std::move(assembled.mesh.corner_uvs);
  result.cut = std::move(assembled.cut);
  result.new_seams = std::move(assembled.new_seams);
  add_new_seams(whole.atlas, parted, result);
  restore_locked_corners(whole, options, result);
  tell_of_tiles(tiles, whole, participants, result, journal);
  return result;
}

/// Faces without usable coordinates are set aside, and keep theirs.
RefineResult refine_usable(const Atlas& atlas, const RefineOptions& options, Monitor& monitor, Journal& journal) {
  check_arrays(atlas);
  if (is_usable(atlas)) return refine_atlas(atlas, {}, options, monitor, journal);
  const UsableAtlas usable = set_unusable_aside(atlas);
  RefineResult result = refine_atlas(usable.atlas, usable.has_uvs, options, monitor, journal);
  for (std::size_t c = 0; c < result.corner_uvs.size(); ++c) {
    const int source = result.cut ? result.cut->corner_sources[c][0] : static_cast<int>(c);
    if (result.corner_uvs[c] == usable.atlas.corner_uvs[source]) result.corner_uvs[c] = atlas.corner_uvs[source];
  }
  return result;
}

Profile profile_of(const Account& account) {
  Profile out{.steps = account.steps, .mean_step = account.steps > 0 ? account.fractions / account.steps : 0};
  for (int k = 0; k < kPhases; ++k) out.phases.push_back({to_string(static_cast<Phase>(k)), account.seconds[k]});
  return out;
}

/// Where some chart is locked, or where that is asked, the box is the texture, which is square unless said otherwise.
RefineOptions settled(RefineOptions options) {
  const bool locked = std::any_of(options.locked.begin(), options.locked.end(), [](char flag) { return flag != 0; });
  if ((locked || options.in_texture) && options.box_aspect == 0) options.box_aspect = 1;
  return options;
}

}  // namespace

const char* version() { return ATLAS_REFINE_VERSION; }

RefineResult refine(const Atlas& atlas, const RefineOptions& asked, const ProgressFn& progress, DebugSink* debug) {
  check_options(atlas, asked);
  const RefineOptions options = settled(asked);
  RefineResult result;
  run_monitored(progress, [&](Monitor& monitor) {
    take_account();  // what the thread has done before is not of this call
    const ThreadPoolScope pool(resolve_threads(options.threads));
    Journal journal(monitor, debug, options.box_aspect);
    result = refine_usable(atlas, options, monitor, journal);
    journal.end_stage();
    result.iterations = journal.iterations;
    result.repairs = std::move(journal.repairs);
    result.fallbacks = std::move(journal.fallbacks);
    result.warnings = std::move(journal.warnings);
    result.timings = std::move(journal.timings);
    result.profile = profile_of(take_account());
  });
  return result;
}

}  // namespace atlas_refine
