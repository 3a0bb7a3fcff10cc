// Flags to freedoms, and what is different where some chart is fixed.
#include "report/locked.h"

#include <algorithm>

#include "report/journal.h"
#include "report/texture.h"

namespace atlas_refine {
namespace {

std::string counted(std::ptrdiff_t count, std::size_t all, const char* one, const char* many) {
  if (count == static_cast<std::ptrdiff_t>(all))
    return all == 1 ? "the chart is " + std::string(one) : "all charts are " + std::string(many);
  return std::to_string(count) + (count == 1 ? " chart is " + std::string(one) : " charts are " + std::string(many));
}

}  // namespace

Freedoms freedom_of(const ChartSet& set, const RefineOptions& options) {
  return freedom_of(set.charts, options.keep_shape, options.locked);
}

Freedoms freedom_of_pieces(const Freedoms& of_charts, const CutAtlas& atlas) {
  Freedoms out;
  if (of_charts.empty()) return out;
  for (const Piece& piece : atlas.pieces) out.push_back(of_charts[piece.chart]);
  return out;
}

void excuse_fixed(ChartSet& set, const Freedoms& freedom) {
  if (!any_fixed(freedom)) return;
  std::erase_if(set.defects, [&](const FaceDefect& defect) { return is_fixed(freedom, defect.chart); });
  const std::vector<Chart> placed = charts_as_placed(set);
  for (std::size_t c = 0; c < freedom.size(); ++c) {
    if (!is_fixed(freedom, c) || !set.mirrored[c]) continue;
    set.charts[c] = placed[c];
    set.mirrored[c] = false;
  }
}

void restore_fixed(const InputAtlas& input, const CutAtlas& atlas, const Freedoms& freedom, std::vector<std::vector<Vec2>>& uvs) {
  if (!any_fixed(freedom)) return;
  std::vector<std::vector<Vec2>> given;
  for (const Chart& chart : input.set.charts) given.emplace_back(chart.vertex_count());
  for (std::size_t corner = 0; corner < input.set.corners.size(); ++corner) {
    const CornerRef& at = input.set.corners[corner];
    if (at.chart >= 0) given[at.chart][at.vertex] = input.atlas.corner_uvs[corner];
  }
  for (std::size_t p = 0; p < uvs.size(); ++p) {
    const Piece& piece = atlas.pieces[p];
    for (std::size_t v = 0; v < uvs[p].size() && is_fixed(freedom, piece.chart); ++v) {
      if (piece.vertices[v] >= 0) uvs[p][v] = given[piece.chart][piece.vertices[v]];
    }
  }
}

void restore_locked_corners(const InputAtlas& whole, const RefineOptions& options, RefineResult& result) {
  const Freedoms freedom = freedom_of(whole.set, options);
  if (!any_fixed(freedom)) return;
  for (std::size_t c = 0; c < result.corner_uvs.size(); ++c) {
    const int source = result.cut ? result.cut->corner_sources[c][0] : static_cast<int>(c);
    if (result.cut && result.cut->corner_weights[c][0] != 1) continue;
    if (is_fixed(freedom, whole.set.corners[source].chart)) result.corner_uvs[c] = whole.atlas.corner_uvs[source];
  }
}

RefineOptions with_kept_leaders(const ChartSet& set, const std::vector<Follower>& followers, RefineOptions options) {
  const Freedoms freedom = freedom_of(set, options);
  for (const Follower& follower : followers) {
    if (!freedom.empty() && freedom[follower.chart] == Freedom::Moves)
      options.keep_shape[set.charts[follower.leader].triangle_faces.front()] = 1;
  }
  return options;
}

std::string words_on_kept(const std::vector<Chart>& charts, const Freedoms& freedom, double box_aspect) {
  const auto kept = std::count(freedom.begin(), freedom.end(), Freedom::Moves);
  const auto locked = std::count(freedom.begin(), freedom.end(), Freedom::Fixed);
  std::string words;
  if (kept > 0) words += "; " + counted(kept, charts.size(), "kept in its shape", "kept in their shapes");
  if (locked > 0)
    words += "; " + counted(locked, charts.size(), "locked", "locked") + " and " + (locked == 1 ? "covers " : "cover ") +
             number_text("%.4f", share_of_texture(charts, freedom, Vec2::Zero(), box_aspect, true)) + " of the texture";
  return words;
}

}  // namespace atlas_refine
