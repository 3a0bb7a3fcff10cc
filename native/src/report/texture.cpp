// The texture, its border, and the box within it.
#include "report/texture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "atlas_refine/error.h"
#include "geometry/boundary.h"
#include "report/locked.h"

namespace atlas_refine {

namespace {

constexpr double kSizeRounding = 1e-5;  ///< relative, of the size that UVs in single precision are to have

/// How many times as large as asked charts can lie in the texture, `gap` apart and from its border once they have their size.
/// What is nearer than half the gap to one of them is nobody else's, and that has, by Brunn and Minkowski, at least the area of
/// the disk that it is around a disk of the chart's area. All of these fit into the texture without half the gap along its
/// border: (a s - g) (s - g) = sum (sqrt(A_i) + g sqrt(pi) / 2)^2 for a texture s times as high as the charts are large, 1 / s
/// the answer's. Pieces of charts take more. At no gap this is the charts' area.
double most_growth(const std::vector<Chart>& charts, double uv_density, double aspect, double gap) {
  double taken = 0;
  for (const Chart& chart : charts) {
    const double side = uv_density * std::sqrt(chart.surface.area()) + gap * std::sqrt(std::numbers::pi) / 2;
    taken += side * side;
  }
  const double sum = (1 + aspect) * gap;
  return 2 * aspect / (sum + std::sqrt(std::max(0.0, sum * sum - 4 * aspect * (gap * gap - taken))));
}

/// `asked` is a part of the texture, of which the box takes `side`.
double gap_of_box(double asked, double side, Journal& journal) {
  constexpr double kMost = 0.1;
  if (asked <= kMost * side) return asked / side;
  journal.warnings.push_back(
      "a gap of " + number_text("%.3g", asked) +
      " of the texture's side is more than a tenth of what the charts take: " + number_text("%.3g", kMost * side) + " is kept");
  return kMost;
}

/// Relative, of the area that charts of that density lose or gain at most as they are stored, which is coarser far from the first
/// tile: where every vertex moves, it is what their boundary sweeps over.
double area_rounding(const InputAtlas& input, const RefineOptions& options, double surface) {
  if (options.stored == Stored::Double) return 0;
  const Vec2 farthest = (input.origin.cwiseAbs().array() + 1) * Vec2(options.box_aspect, 1).array();
  const double moved = farthest.norm() * std::numeric_limits<float>::epsilon() / 2;
  return moved * boundary_on_surface(input.set.charts) / (options.uv_density * surface);
}

}  // namespace

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
  return kept ? options.gap->length(Vec2(options.box_aspect, 1)) + kBorderSpare : 0;
}

RefineOptions settle_density(RefineOptions options, InputAtlas& input, Journal& journal, bool ample) {
  if (options.uv_density == 0) return options;
  double surface = 0;
  for (const Chart& chart : input.set.charts) surface += chart.surface.area();
  const double area = options.uv_density * options.uv_density * surface, share = area / options.box_aspect;
  input.size_rounding = kSizeRounding;
  if (!options.in_texture) {
    if (options.gap && options.gap->unit == Gap::Unit::LongSide)
      options.gap->value = gap_of_box(options.gap->value, std::sqrt(area), journal);
  } else if (share > options.pe_bound) {
    options.uv_density = 0;
  } else {
    input.size_rounding += area_rounding(input, options, surface) / 2;
    options.pe_bound = share * std::max(0.5, 1 - 2 * input.size_rounding);
    const double gap = options.gap ? options.gap->length(Vec2(options.box_aspect, 1)) : 0;
    input.gap_of_texture = options.gap && !ample;
    if (input.gap_of_texture) return options;
    const double most = most_growth(input.set.charts, options.uv_density, options.box_aspect, gap);
    input.spare = std::max(1.0, most * (1 + kSizeRounding));
    if (options.gap) options.gap->value *= input.spare;
  }
  return options;
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
