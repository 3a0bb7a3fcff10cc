// The whole method, top to bottom: charts, who takes part, each atlas by itself, all put together again.
#include "atlas_refine/refine.h"

#include "input/check_atlas.h"
#include "input/join_edges.h"
#include "input/take_part.h"
#include "one_atlas.h"
#include "report/assemble.h"
#include "report/options.h"
#include "report/outcome.h"
#include "support/monitor.h"

namespace atlas_refine {
namespace {

constexpr ProgressRange kInput = {0, 0.02};
constexpr ProgressRange kAtlases = {0.02, 1};

Vec2 origin_of(const Part& part, const RefineOptions& options) {
  const bool given = part.group < static_cast<int>(options.group_origins.size());
  return given ? options.group_origins[part.group] : Vec2(Vec2::Zero());
}

/// Each atlas by itself, one after the other; each has its part of the progress by its number of charts.
std::vector<Done> refine_parts(const InputAtlas& whole, const Participants& participants, const RefineOptions& options,
                               Monitor& monitor, Journal& journal) {
  std::vector<Done> done;
  const double all = static_cast<double>(whole.set.charts.size() - participants.left.size() - participants.followers.size());
  double before = 0;
  for (const Part& part : participants.parts) {
    const double after = before + static_cast<double>(part.charts.size()) / all;
    const Journal::Mark mark = journal.mark();
    InputAtlas input = part_of(whole, part.charts, options.box_aspect);
    input.origin = origin_of(part, options);
    done.push_back({part, refine_one(input, options, kAtlases.part(before, after), monitor, journal)});
    if (participants.parts.size() > 1) journal.prefix_from(mark, name_of(part.group, options) + ": ");
    before = after;
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

RefineResult refine_atlas(const Atlas& atlas, const std::vector<char>& has_uvs, const RefineOptions& options, Monitor& monitor,
                          Journal& journal) {
  journal.begin_stage("input", kInput);
  const InputAtlas whole = read_atlas(atlas, options.box_aspect);
  const Participants participants = take_part(whole.set, options, has_uvs);
  journal.show("input", charts_as_placed(whole.set));
  std::vector<Done> done = refine_parts(whole, participants, options, monitor, journal);
  RefineResult result;
  summarise(whole, participants, options, done, result);
  tell_of(participants, done, journal);
  AssembledAtlas assembled = assemble(whole, participants, refined_parts(done), options.triangulate);
  measure_seams(atlas, join_edges(atlas), result.before);
  measure_seams(assembled.mesh, join_edges(assembled.mesh), result.after);
  result.corner_uvs = std::move(assembled.mesh.corner_uvs);
  result.cut = std::move(assembled.cut);
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

}  // namespace

const char* version() { return ATLAS_REFINE_VERSION; }

RefineResult refine(const Atlas& atlas, const RefineOptions& options, const ProgressFn& progress, DebugSink* debug) {
  check_options(atlas, options);
  RefineResult result;
  run_monitored(progress, [&](Monitor& monitor) {
    Journal journal(monitor, debug, options.box_aspect);
    result = refine_usable(atlas, options, monitor, journal);
    journal.end_stage();
    result.iterations = journal.iterations;
    result.repairs = std::move(journal.repairs);
    result.fallbacks = std::move(journal.fallbacks);
    result.warnings = std::move(journal.warnings);
    result.timings = std::move(journal.timings);
  });
  return result;
}

}  // namespace atlas_refine
