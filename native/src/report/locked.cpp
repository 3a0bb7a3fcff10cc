// Flags to freedoms, and what is different where some chart is fixed.
#include "report/locked.h"

#include <algorithm>
#include <cmath>

#include "atlas_refine/error.h"
#include "report/journal.h"

namespace atlas_refine {
namespace {

double share_of_texture(const std::vector<Chart>& charts, const Freedoms& freedom, const Vec2& origin, double box_aspect,
                        bool fixed_only) {
  const Vec2 sides(box_aspect, 1), corner = origin.cwiseProduct(sides);
  const Box texture{corner, corner + sides};
  double area = 0;
  for (std::size_t c = 0; c < charts.size(); ++c) {
    if (!fixed_only || is_fixed(freedom, c)) area += area_within(charts[c], texture);
  }
  return area / texture.area();
}

std::string counted(std::ptrdiff_t count, std::size_t all, const char* one, const char* many) {
  if (count == static_cast<std::ptrdiff_t>(all))
    return all == 1 ? "the chart is " + std::string(one) : "all charts are " + std::string(many);
  return std::to_string(count) + (count == 1 ? " chart is " + std::string(one) : " charts are " + std::string(many));
}

}  // namespace

Freedoms freedom_of(const ChartSet& set, const RefineOptions& options) {
  return freedom_of(set.charts, options.keep_shape, options.locked);
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

bool is_in_texture(const Freedoms& freedom, const RefineOptions& options) { return options.in_texture || any_fixed(freedom); }

double border_of(const RefineOptions& options) {
  const bool kept = options.in_texture && options.gap && options.gap->value > 0;
  return kept ? options.gap->length(Vec2(options.box_aspect, 1)) + kBorderSpare : 0;
}

RefineOptions within_border(RefineOptions options) {
  const double border = border_of(options);
  if (border == 0) return options;
  const Vec2 texture(options.box_aspect, 1), inner = texture.array() - 2 * border;
  const double share = inner.minCoeff() > 0 ? inner.prod() / texture.prod() : 0;
  if (share == 0 || (share <= options.pe_bound && !options.best_effort))
    throw RefineError(ErrorCode::BoundNotReached, "pack",
                      "the gap to the border of the texture leaves " + number_text("%.4f", share) +
                          " of it, less than the bound " + number_text("%g", options.pe_bound));
  constexpr double kMost = 0.9999;
  options.pe_bound = std::min(options.pe_bound / share, share <= options.pe_bound ? kMost : 1.0);
  options.gap = Gap{options.gap->length(texture) / inner.maxCoeff(), Gap::Unit::LongSide};
  options.box_aspect = inner.x() / inner.y();
  return options;
}

void measure_in_texture(const std::vector<Chart>& placed, const Freedoms& freedom, const Vec2& origin,
                        const RefineOptions& options, Measures& measures) {
  if (is_in_texture(freedom, options))
    measures.pe_fixed_aspect = share_of_texture(placed, freedom, origin, options.box_aspect, false);
}

void put_in_texture(InputAtlas& input, const RefineOptions& options) {
  const Freedoms freedom = freedom_of(input.set, options);
  if (!is_in_texture(freedom, options)) return;
  excuse_fixed(input.set, freedom);
  measure_in_texture(charts_as_placed(input.set), freedom, input.origin, options, input.measures);
  const double border = border_of(options);
  const Vec2 corner = input.origin.cwiseProduct(Vec2(options.box_aspect, 1)).array() + border;
  for (std::size_t c = 0; c < input.set.charts.size(); ++c) {
    const Vec2 shift(input.set.mirrored[c] ? -corner.x() : corner.x(), corner.y());
    for (Vec2& uv : input.set.charts[c].uvs) uv = (uv - shift) / (1 - 2 * border);
  }
}

bool lies_in_texture(const std::vector<Chart>& charts, const Freedoms& freedom, double box_aspect, double slack) {
  for (std::size_t c = 0; c < charts.size(); ++c) {
    if (is_fixed(freedom, c)) continue;
    for (const Vec2& uv : charts[c].uvs) {
      if (!(uv.minCoeff() >= -slack && uv.x() <= box_aspect + slack && uv.y() <= 1 + slack)) return false;
    }
  }
  return true;
}

void restore_fixed(const InputAtlas& input, const Freedoms& freedom, std::vector<std::vector<Vec2>>& uvs) {
  if (!any_fixed(freedom)) return;
  for (std::size_t corner = 0; corner < input.set.corners.size(); ++corner) {
    const CornerRef& at = input.set.corners[corner];
    if (at.chart >= 0 && is_fixed(freedom, at.chart)) uvs[at.chart][at.vertex] = input.atlas.corner_uvs[corner];
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
