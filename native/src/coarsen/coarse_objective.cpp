// Averages of the fine elements in each coarse triangle.
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "coarsen/coarse_chart.h"
#include "geometry/guards.h"
#include "geometry/plane.h"
#include "solve/symmetric_dirichlet.h"
#include "support/gathered.h"

namespace atlas_refine {
namespace {

/// Sums over elements. With J an element's Jacobian from its shape to the UVs, E_d under a further map F is
/// weight (tr(F J J^T F^T) + tr(F^-T (J J^T)^-1 F^-1)) / 4.
struct Average {
  double area = 0;                                     ///< in the UVs
  double weight = 0;                                   ///< of the objective
  Mat2 square = Mat2::Zero(), inverse = Mat2::Zero();  ///< sums of weight J J^T and of weight (J J^T)^-1

  Average& operator+=(const Average& other) {
    area += other.area;
    weight += other.weight;
    square += other.square;
    inverse += other.inverse;
    return *this;
  }
};

/// What lies halfway from a to b among symmetric positive matrices.
Mat2 geometric_mean(const Mat2& a, const Mat2& b) {
  const double root_a = std::sqrt(a.determinant()), root_b = std::sqrt(b.determinant());
  const Mat2 sum = a / root_a + b / root_b;
  return std::sqrt(root_a * root_b / sum.determinant()) * sum;
}

std::vector<Average> averages(const Chart& chart, const CoarseChart& coarse, const Locator& locator, const ChartObjective& fine) {
  std::vector<std::pair<Triangle, double>> elements;  // and what counts of their areas
  for_each_element(chart, [&](const Triangle& t, const RestTriangle&, double share, int) { elements.emplace_back(t, share); });
  constexpr int kGrain = 2048;
  const auto parts =
      gathered<std::pair<int, Average>>(static_cast<int>(elements.size()), kGrain, [&](int begin, int end, auto& out) {
        for (int e = begin; e < end; ++e) {
          const auto& [t, share] = elements[e];
          const Vec2 &a = chart.uvs[t[0]], &b = chart.uvs[t[1]], &c = chart.uvs[t[2]];
          const double area = 0.5 * share * doubled_area(a, b, c);
          if (!(area > 0)) continue;
          const Mat2 j = jacobian(fine.inverse_edges[e], a, b, c);
          const Mat2 square = j * j.transpose();
          out.emplace_back(locator.locate((a + b + c) / 3, coarse.places[t[0]].triangle).triangle,
                           Average{area, fine.weight[e], fine.weight[e] * square, fine.weight[e] * square.inverse()});
        }
      });
  std::vector<Average> out(coarse.mesh.triangles.size());
  for (const auto& [triangle, part] : parts) out[triangle] += part;
  return out;
}

/// Triangles that hold the middle of no element are like those around them.
void fill(const Locator& locator, std::vector<Average>& averages) {
  for (bool filled = true; filled;) {
    filled = false;
    const std::vector<Average> before = averages;
    for (std::size_t t = 0; t < averages.size(); ++t) {
      if (before[t].area > 0) continue;
      for (const int other : locator.neighbours()[t]) {
        if (other >= 0) averages[t] += before[other];
      }
      filled = filled || averages[t].area > 0;
    }
  }
}

}  // namespace

ChartObjective coarse_objective(const Chart& chart, const CoarseChart& coarse, const ChartObjective& fine) {
  const Locator locator(coarse.mesh.uvs, coarse.mesh.triangles);
  std::vector<Average> of_triangle = averages(chart, coarse, locator, fine);
  fill(locator, of_triangle);
  ChartObjective out;
  double weight = 0;  // without the energies
  std::vector<double> energy;
  for (std::size_t t = 0; t < of_triangle.size(); ++t) {
    const Average& mean = of_triangle[t];
    const Triangle& v = coarse.mesh.triangles[t];
    const std::vector<Vec2>& uvs = coarse.mesh.uvs;
    // tr(S square) + tr(S^-1 inverse) is least where S^-1 is this.
    const Mat2 shape = geometric_mean(mean.square, mean.inverse.inverse());
    const Mat2 map = Eigen::LLT<Mat2>(shape).matrixL();
    Mat2 edges;
    edges << uvs[v[1]] - uvs[v[0]], uvs[v[2]] - uvs[v[0]];
    out.inverse_edges.push_back(edges.inverse() * map);
    out.weight.push_back(0.5 * edges.determinant() * mean.weight / mean.area);
    weight += out.weight.back();
    energy.push_back(0.25 * ((shape.inverse() * mean.square).trace() + (shape * mean.inverse).trace()) / mean.weight);
  }
  double wanted = 0;
  for (const double w : fine.weight) wanted += w;
  for (std::size_t t = 0; t < energy.size(); ++t) out.weight[t] *= wanted / weight * energy[t];
  return out;
}

}  // namespace atlas_refine
