// The texture, its border, and the box within it.
#include "report/texture.h"

#include <algorithm>
#include <cmath>

#include "atlas_refine/error.h"
#include "report/journal.h"
#include "report/locked.h"

namespace atlas_refine {

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

bool is_in_texture(const Freedoms& freedom, const RefineOptions& options) { return options.in_texture || any_fixed(freedom); }

double border_of(const RefineOptions& options) {
  const bool kept = options.in_texture && options.gap && options.gap->value > 0;
  return kept ? spare_for_size(options) * options.gap->length(Vec2(options.box_aspect, 1)) + kBorderSpare : 0;
}

RefineOptions settle_density(RefineOptions options, const std::vector<Chart>& charts) {
  constexpr double kMostGap = 0.1;
  if (options.uv_density == 0) return options;
  double area = 0;
  for (const Chart& chart : charts) area += options.uv_density * options.uv_density * chart.surface.area();
  if (!options.in_texture) {
    if (options.gap && options.gap->unit == Gap::Unit::LongSide)
      options.gap->value = std::min(options.gap->value / std::sqrt(area), kMostGap);
    return options;
  }
  const double share = area / options.box_aspect;
  if (share <= options.pe_bound) {
    options.pe_bound = share * (1 - kSizeRounding);
  } else {
    options.uv_density = 0;
  }
  return options;
}

double spare_for_size(const RefineOptions& options) {
  return options.in_texture && options.uv_density > 0 ? 1 / std::sqrt(options.pe_bound) : 1;  // they cover the texture at most
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
  options.gap = Gap{border / inner.maxCoeff(), Gap::Unit::LongSide};
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

}  // namespace atlas_refine
