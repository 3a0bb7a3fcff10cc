// Densities, reference shapes and importance of pieces.
#include "reduce/goal.h"

#include <algorithm>
#include <cmath>

#include "geometry/plane.h"
#include "measure/bad_triangles.h"
#include "measure/distortion.h"

namespace atlas_refine {
namespace {

/// 1 for a chart without UV area.
double usable_density(const Chart& chart) {
  const double density = texel_density(chart);
  return density > 0 && std::isfinite(density) ? density : 1;
}

/// 0 where the UVs tell none: most of them are flipped or without area, or what is left has no shape, so that its area is that of
/// something else. Triangles that a stray vertex has drawn out do not count; where there are many, that is how the map is.
double density_told_by_uvs(const Chart& chart) {
  if (mostly_bad(chart, bad_triangles(chart)) || !(sums_of_good(chart).best_energy() < kLine)) return 0;
  constexpr double kFew = 0.1;  // of the surface
  const std::vector<char> out_of_scale = triangles_out_of_scale(chart);
  double in_texture = 0, on_surface = 0;
  for (std::size_t t = 0; t < out_of_scale.size(); ++t) {
    if (out_of_scale[t]) continue;
    const auto [a, b, c] = chart.triangles[t];
    in_texture += 0.5 * doubled_area(chart.uvs[a], chart.uvs[b], chart.uvs[c]);
    on_surface += chart.surface[t].area;
  }
  return on_surface < (1 - kFew) * chart.surface.area() ? usable_density(chart) : std::sqrt(in_texture / on_surface);
}

std::vector<Vec2> input_uvs(const Piece& piece, const std::vector<Chart>& input) {
  std::vector<Vec2> out;
  for (const Support& support : piece.supports) out.push_back(value_at(support, input[piece.chart].uvs));
  return out;
}

Vec2 mean(const std::vector<Vec2>& points) {
  Vec2 sum = Vec2::Zero();
  for (const Vec2& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// The image of `shape` under the rotation, scaling and translation that brings it nearest to `placed` (least squares).
std::vector<Vec2> nearest_similar(const std::vector<Vec2>& shape, const std::vector<Vec2>& placed) {
  const Vec2 from = mean(shape), to = mean(placed);
  double cosine = 0, sine = 0, square = 0;  // times the scale
  for (std::size_t v = 0; v < shape.size(); ++v) {
    const Vec2 p = shape[v] - from, q = placed[v] - to;
    cosine += p.dot(q);
    sine += p.x() * q.y() - p.y() * q.x();
    square += p.squaredNorm();
  }
  if (square == 0) return placed;
  Mat2 map;
  map << cosine / square, -sine / square, sine / square, cosine / square;
  std::vector<Vec2> out;
  out.reserve(shape.size());
  for (const Vec2& p : shape) out.push_back(to + map * (p - from));
  return out;
}

}  // namespace

std::vector<double> wanted_density(const std::vector<Chart>& input, Density density) {
  if (density == Density::Equal) return std::vector<double>(input.size(), 1);
  std::vector<double> out;
  double wanted = 0, surface = 0;
  for (const Chart& chart : input) {
    out.push_back(density_told_by_uvs(chart));
    if (out.back() == 0) continue;
    wanted += out.back() * out.back() * chart.surface.area();
    surface += chart.surface.area();
  }
  for (double& value : out) value = value == 0 ? 1 : value * std::sqrt(surface / wanted);
  return out;
}

bool set_density(std::vector<Chart>& charts, const std::vector<double>& wanted, Density density, const Freedoms& freedom) {
  double least = 0, most = 0;
  for (std::size_t c = 0; c < charts.size(); ++c) {
    if (is_fixed(freedom, c)) continue;
    const double own = density == Density::Equal ? 1 / dirichlet_sums(charts[c]).best_scale() : usable_density(charts[c]);
    const double scale = wanted[c] / own;
    for (Vec2& uv : charts[c].uvs) uv *= scale;
    least = least == 0 ? scale : std::min(least, scale);
    most = std::max(most, scale);
  }
  return most > 1.001 * least;
}

std::vector<double> kept_areas(const std::vector<Chart>& input, const CutAtlas& atlas, const RefineOptions& options,
                               const Freedoms& freedom) {
  if (options.density != Density::Keep) return {};
  const std::vector<double> wanted = wanted_density(input, options.density);
  std::vector<double> out;
  for (std::size_t p = 0; p < atlas.pieces.size(); ++p) {
    const Piece& piece = atlas.pieces[p];
    const double density = is_fixed(freedom, p) ? 0 : wanted[piece.chart];
    out.push_back(density * density * piece.mesh.surface.area());
  }
  return out;
}

void restore_shapes(const std::vector<Chart>& input, const Freedoms& freedom, CutAtlas& atlas) {
  for (Piece& piece : atlas.pieces) {
    if (freedom.empty() || freedom[piece.chart] != Freedom::Moves) continue;
    piece.mesh.uvs = nearest_similar(input_uvs(piece, input), piece.mesh.uvs);
  }
}

Objective goal_of(const std::vector<Chart>& input, const CutAtlas& atlas, const RefineOptions& options) {
  const std::vector<double>& importance = options.importance;
  const bool uniform = std::adjacent_find(importance.begin(), importance.end(), std::not_equal_to<>()) == importance.end();
  ObjectiveRequest request{.importance = uniform ? std::vector<double>() : importance};
  if (options.density == Density::Keep) {
    const std::vector<double> wanted = wanted_density(input, options.density);
    for (const Piece& piece : atlas.pieces) request.density.push_back(wanted[piece.chart]);
  }
  if (options.reference == Reference::Input) {
    for (const Piece& piece : atlas.pieces) {
      request.reference_uvs.push_back(input_uvs(piece, input));
      request.reference_scale.push_back(1 / usable_density(input[piece.chart]));
    }
  }
  return make_objective(meshes_of(atlas), request);
}

}  // namespace atlas_refine
