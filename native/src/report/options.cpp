// Ranges of the options.
#include "report/options.h"

#include <cmath>

#include "atlas_refine/error.h"

namespace atlas_refine {
namespace {

void require(bool holds, const char* what) {
  if (!holds) throw RefineError(ErrorCode::BadOption, "options", what);
}

void check_importance(const Atlas& atlas, const std::vector<double>& importance) {
  require(importance.empty() || static_cast<int>(importance.size()) == atlas.face_count(),
          "importance must hold one weight per face");
  for (double weight : importance) require(weight > 0 && std::isfinite(weight), "importance weights must be finite and above 0");
}

template <class Value>
void check_size(const Atlas& atlas, const std::vector<Value>& values, const char* what) {
  require(values.empty() || static_cast<int>(values.size()) == atlas.face_count(), what);
}

void check_edges(const Atlas& atlas, const std::vector<std::array<int, 2>>& edges, const char* what) {
  const int count = static_cast<int>(atlas.positions.size());
  for (const auto& [a, b] : edges) require(a >= 0 && a < count && b >= 0 && b < count, what);
}

bool is_aspect(double value) { return value >= 0.01 && value <= 100; }

void check_gap(double gap) { require(gap >= 0 && gap <= 0.1, "the gap must lie in [0, 0.1] of the box"); }

void check_density(double density) {
  require(density >= 0 && std::isfinite(density), "the UV density must be a finite number of at least 0");
}

constexpr const char* kNeedsRoom = "a UV density needs a free box or a texture, without locked charts";

/// Locked charts have the density that they have.
void check_locked_density(const RefineOptions& options) {
  for (std::size_t f = 0; f < options.locked.size(); ++f) {
    const int group = options.groups.empty() ? 0 : options.groups[f];
    require(options.locked[f] == 0 || options_of_group(options, group).uv_density == 0, kNeedsRoom);
  }
}

void check_kept(const Atlas& atlas, const RefineOptions& options) {
  check_size(atlas, options.groups, "groups must hold one number per face");
  for (const int group : options.groups) require(group >= 0, "group numbers must not be negative");
  check_size(atlas, options.stack_groups, "stack groups must hold one number per face");
  for (const Vec2& origin : options.group_origins) require(origin.allFinite(), "group origins must be finite");
  for (const double aspect : options.group_aspects) require(is_aspect(aspect), "aspects of groups must lie in [0.01, 100]");
  require(options.group_gaps.empty() || options.gap, "gaps of groups need a gap");
  for (const double gap : options.group_gaps) check_gap(gap);
  check_size(atlas, options.keep_shape, "keep_shape must hold one flag per face");
  check_size(atlas, options.locked, "locked must hold one flag per face");
  require(!options.align_axes || options.rotate != Rotate::None, "charts that may not be turned cannot be aligned with the axes");
  check_edges(atlas, options.no_seam, "no_seam names a vertex that the mesh does not have");
  check_edges(atlas, options.prefer_seam, "prefer_seam names a vertex that the mesh does not have");
}

}  // namespace

void check_aspect(double box_aspect) {
  require(box_aspect == 0 || is_aspect(box_aspect), "the box aspect must be 0 (free) or lie in [0.01, 100]");
}

void check_options(const Atlas& atlas, const RefineOptions& options) {
  require(options.pe_bound > 0 && options.pe_bound < 1, "the packing efficiency bound must lie between 0 and 1, both excluded");
  check_aspect(options.box_aspect);
  if (options.gap) check_gap(options.gap->value);
  require(!options.max_distortion || (*options.max_distortion >= 1 && std::isfinite(*options.max_distortion)),
          "the largest distortion must be a finite number of at least 1");
  require(!options.max_stretch || (*options.max_stretch >= 1 && std::isfinite(*options.max_stretch)),
          "the largest stretch must be a finite number of at least 1");
  require(!options.max_boundary_growth || (*options.max_boundary_growth >= 0 && std::isfinite(*options.max_boundary_growth)),
          "the largest boundary growth must be a finite number of at least 0");
  require(options.seam_cost >= 0 && std::isfinite(options.seam_cost), "the seam cost must be a finite number of at least 0");
  require(!options.point || (*options.point >= 0 && options.trade_off), "the point must be at least 0, of a trade-off");
  check_density(options.uv_density);
  const bool is_free = options.box_aspect == 0 && options.group_aspects.empty() && options.locked.empty();
  require(options.uv_density == 0 || is_free || options.in_texture, kNeedsRoom);
  require(options.group_densities.empty() || options.uv_density > 0, "UV densities of groups need a UV density");
  for (const double density : options.group_densities) check_density(density);
  const RectangleOptions& rectangles = options.rectangles;
  require(rectangles.sigma > 0 && rectangles.sigma <= 0.1, "sigma must lie between 0 (excluded) and 0.1");
  require(rectangles.candidates >= 1 && rectangles.candidates <= 1000000, "the candidates must number 1 to 1000000");
  require(rectangles.omega >= 0 && rectangles.omega <= 1, "omega must lie in [0, 1]");
  check_importance(atlas, options.importance);
  check_kept(atlas, options);
  check_locked_density(options);
  require(options.threads >= 0 && options.threads <= 1024, "the number of threads must lie in [0, 1024]");
}

RefineOptions options_of_group(const RefineOptions& options, int group) {
  RefineOptions out = options;
  const auto number = static_cast<std::size_t>(group);
  if (number < options.group_aspects.size()) out.box_aspect = options.group_aspects[number];
  if (number < options.group_gaps.size()) out.gap->value = options.group_gaps[number];
  if (number < options.group_densities.size()) out.uv_density = options.group_densities[number];
  return out;
}

}  // namespace atlas_refine
