// Shapes from the surface or a reference, scaled by density; weights from areas, densities and importance.
#include "solve/objective.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/guards.h"
#include "geometry/rest_triangle.h"

namespace atlas_refine {
namespace {

/// Of the area of a guard that no measure counts: enough that it bends before it stops the others, too little to be felt.
constexpr double kBarrierShare = 0.01;

/// Of a triangle, as a part of the mean weight. How stiff a triangle is does not depend on its size, but how far its corners may
/// move before it flips does: many times smaller than those beside it, it would stop their steps. All together gain at most this
/// part of the objective.
constexpr double kLeastWeight = 1e-3;

/// The area on the surface, or in the texture where a chart's density asks for more of that: what cost next to nothing for the
/// texels that it takes would grow until the bound holds. So would a triangle without area on the surface: the shape that stands
/// for it has some. `factor`: on its lengths.
double area_to_weigh(const RestTriangle& shape, double factor) {
  constexpr double kOwn = 0.5;  // of its shape's area, which rounding is far from
  const double standing_for = 0.5 / shape.inverse_edges.determinant();
  return std::max(1.0, factor * factor) * (shape.area > kOwn * standing_for ? shape.area : standing_for);
}

double surface_area(const std::vector<Chart>& pieces) {
  double area = 0;
  for (const Chart& piece : pieces) area += piece.surface.area();
  return area;
}

/// Factor on the lengths of each piece's shapes.
std::vector<double> length_factors(const std::vector<Chart>& pieces, const std::vector<double>& density) {
  if (density.empty()) return std::vector<double>(pieces.size(), 1);
  double wanted = 0, area = 0;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    wanted += density[p] * density[p] * pieces[p].surface.area();
    area += pieces[p].surface.area();
  }
  std::vector<double> factors;
  factors.reserve(density.size());
  for (const double d : density) factors.push_back(d * std::sqrt(area / wanted));
  return factors;
}

/// Of a triangle of piece p, at the surface's size.
Mat2 wanted_shape(const ObjectiveRequest& request, std::size_t p, const Triangle& v, const Mat2& own) {
  if (request.reference_uvs.empty()) return own;
  const std::vector<Vec2>& uvs = request.reference_uvs[p];
  const RestTriangle rest = rest_from_plane(uvs[v[0]], uvs[v[1]], uvs[v[2]], request.reference_scale[p]);
  return rest.area > 0 ? rest.inverse_edges : own;
}

void raise_least(std::vector<double>& weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double least = kLeastWeight * sum / static_cast<double>(weights.size());
  for (double& weight : weights) weight = std::max(least, weight);
}

void normalise(std::vector<double>& weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& weight : weights) weight /= sum;
}

}  // namespace

Objective make_objective(const std::vector<Chart>& pieces, const ObjectiveRequest& request) {
  Objective out;
  out.unit = std::sqrt(surface_area(pieces));
  const std::vector<double> factors = length_factors(pieces, request.density);
  std::vector<double> importance;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    for_each_element(pieces[p], [&](const Triangle& triangle, const RestTriangle& shape, double share, int face) {
      out.inverse_edges.push_back(out.unit / factors[p] * wanted_shape(request, p, triangle, shape.inverse_edges));
      out.weight.push_back(area_to_weigh(shape, factors[p]) * (share > 0 ? share : kBarrierShare));
      if (!request.importance.empty()) importance.push_back(request.importance[face]);
    });
  }
  raise_least(out.weight);
  for (std::size_t e = 0; e < importance.size(); ++e) out.weight[e] *= importance[e];
  normalise(out.weight);
  return out;
}

}  // namespace atlas_refine
