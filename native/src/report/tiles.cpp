// Charts that are left, the others' faces, and seams.
#include "report/tiles.h"

#include <algorithm>
#include <array>
#include <set>

#include "report/outcome.h"

namespace atlas_refine {
namespace {

std::vector<char> left_charts(const ChartSet& set, const Participants& participants) {
  std::vector<char> out(set.charts.size(), 0);
  for (const LeftChart& chart : participants.left) out[chart.chart] = 1;
  return out;
}

}  // namespace

void restore_left(const Atlas& input, const ChartSet& set, const Participants& participants, AssembledAtlas& assembled) {
  const std::vector<char> left = left_charts(set, participants);
  for (std::size_t c = 0; c < assembled.mesh.corner_uvs.size(); ++c) {
    const int source = assembled.cut ? assembled.cut->corner_sources[c][0] : static_cast<int>(c);
    const int chart = set.corners[source].chart;
    if (chart >= 0 && left[chart]) assembled.mesh.corner_uvs[c] = input.corner_uvs[source];
  }
}

void tell_of_tiles(const UnwrappedTiles& tiles, const InputAtlas& whole, const Participants& participants, RefineResult& result,
                   Journal& journal) {
  const std::vector<char> left = left_charts(whole.set, participants);
  const auto chart_at = [&](int corner) { return whole.set.corners[corner].chart; };
  std::set<int> charts;
  std::vector<int> faces;
  for (const int f : tiles.faces) {
    const int chart = chart_at(whole.atlas.face_offsets[f]);
    if (chart < 0 || left[chart]) continue;
    charts.insert(chart);
    faces.push_back(f);
  }
  if (faces.empty()) return;
  journal.repairs.push_back({.what =
                                 "had faces that ran back over the whole tile, moved on by a tile to their neighbours; a seam is "
                                 "where the map starts again",
                             .charts = {charts.begin(), charts.end()},
                             .faces = faces});
  std::vector<int> torn;
  for (const auto& corners : tiles.torn) {
    const int chart = chart_at(corners[0]);
    if (chart < 0 || left[chart]) continue;
    ++result.added_seams;
    torn.push_back(corners[0]);
  }
  add_new_seams(whole.atlas, torn, result);
  if (result.intervention == Intervention::Unchanged) result.intervention = Intervention::Moved;
}

}  // namespace atlas_refine
