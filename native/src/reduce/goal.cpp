// Densities, reference shapes and importance of pieces.
#include "reduce/goal.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "measure/distortion.h"

namespace atlas_refine {
namespace {

/// sqrt(UV area / surface area); 1 for a chart without UV area.
double texel_density(const Chart& chart) {
  const double density = std::sqrt(uv_area(chart) / chart.surface.area());
  return density > 0 && std::isfinite(density) ? density : 1;
}

std::vector<Vec2> input_uvs(const Piece& piece, const std::vector<Chart>& input) {
  std::vector<Vec2> out;
  for (const Support& support : piece.supports) out.push_back(value_at(support, input[piece.chart].uvs));
  return out;
}

}  // namespace

std::vector<double> wanted_density(const std::vector<Chart>& input, Density density) {
  if (density == Density::Equal) return std::vector<double>(input.size(), 1);
  std::vector<double> out;
  double wanted = 0, surface = 0;
  for (const Chart& chart : input) {
    out.push_back(texel_density(chart));
    wanted += out.back() * out.back() * chart.surface.area();
    surface += chart.surface.area();
  }
  for (double& value : out) value *= std::sqrt(surface / wanted);
  return out;
}

bool set_density(std::vector<Chart>& charts, const std::vector<double>& wanted, Density density) {
  double least = 0, most = 0;
  for (std::size_t c = 0; c < charts.size(); ++c) {
    const double own = density == Density::Equal ? 1 / dirichlet_sums(charts[c]).best_scale() : texel_density(charts[c]);
    const double scale = wanted[c] / own;
    for (Vec2& uv : charts[c].uvs) uv *= scale;
    least = least == 0 ? scale : std::min(least, scale);
    most = std::max(most, scale);
  }
  return most > 1.001 * least;
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
      request.reference_scale.push_back(1 / texel_density(input[piece.chart]));
    }
  }
  return make_objective(meshes_of(atlas), request);
}

}  // namespace atlas_refine
