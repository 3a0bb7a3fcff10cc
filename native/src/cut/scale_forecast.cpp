// Cotangent weights, angle defects, one factorisation for each border.
#include "cut/scale_forecast.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace atlas_refine {
namespace {

constexpr double kSteepest = 50;  // of a cotangent: a needle must not own the solution

/// Cotangent and angle of the corner between two sides.
std::pair<double, double> corner_between(const Vec2& one, const Vec2& other) {
  const double cross = std::abs(one.x() * other.y() - one.y() * other.x()), dot = one.dot(other);
  return {std::clamp(dot / cross, -kSteepest, kSteepest), std::atan2(cross, dot)};
}

}  // namespace

ScaleForecast::ScaleForecast(const Chart& chart)
    : triangles_(chart.triangles), curvature_(chart.vertex_count(), 2 * std::numbers::pi) {
  std::vector<Eigen::Triplet<double>> triplets;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Mat2 flat = chart.surface[t].inverse_edges.inverse();
    const std::array<Vec2, 3> corners = {Vec2(0, 0), flat.col(0), flat.col(1)};
    areas_.push_back(chart.surface[t].area);
    for (int k = 0; k < 3; ++k) {
      const int v = triangles_[t][(k + 1) % 3], w = triangles_[t][(k + 2) % 3];
      const auto [cotangent, angle_rad] = corner_between(corners[(k + 1) % 3] - corners[k], corners[(k + 2) % 3] - corners[k]);
      curvature_[triangles_[t][k]] -= angle_rad;
      for (const auto& [row, column, sign] : {std::tuple(v, v, 1), {w, w, 1}, {v, w, -1}, {w, v, -1}})
        triplets.emplace_back(row, column, 0.5 * sign * cotangent);
    }
  }
  laplacian_.resize(chart.vertex_count(), chart.vertex_count());
  laplacian_.setFromTriplets(triplets.begin(), triplets.end());
  solver_.analyzePattern(laplacian_);
}

std::vector<double> ScaleForecast::logarithms(const std::vector<char>& border) {
  constexpr double kHeld = 1e8;       // times the mean weight: holds a vertex at 0
  constexpr double kRounding = 1e-9;  // likewise: vertices without weight
  const double mean = std::max(laplacian_.diagonal().cwiseAbs().mean(), 1e-300);
  Eigen::SparseMatrix<double> matrix = laplacian_;
  Eigen::VectorXd right(matrix.rows());
  for (int v = 0; v < right.size(); ++v) {
    matrix.coeffRef(v, v) += (border[v] ? kHeld : kRounding) * mean;
    right[v] = border[v] ? 0 : -curvature_[v];
  }
  solver_.factorize(matrix);
  const Eigen::VectorXd out = solver_.solve(right);
  return {out.begin(), out.end()};
}

double ScaleForecast::energy(const std::vector<double>& logarithms) const {
  double grown = 0, shrunk = 0, area = 0;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (const int v : triangles_[t]) {
      grown += areas_[t] / 3 * std::exp(2 * logarithms[v]);
      shrunk += areas_[t] / 3 * std::exp(-2 * logarithms[v]);
    }
    area += areas_[t];
  }
  return std::sqrt(grown * shrunk) / area;
}

}  // namespace atlas_refine
