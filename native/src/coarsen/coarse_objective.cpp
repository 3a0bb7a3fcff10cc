// Averages of the fine elements in each coarse triangle.
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <numeric>

#include "coarsen/coarse_chart.h"
#include "geometry/guards.h"
#include "geometry/plane.h"
#include "solve/symmetric_dirichlet.h"
#include "support/parallel.h"
#include "support/thread_pool.h"

namespace atlas_refine {
namespace {

constexpr int kGrain = 2048;       // elements,
constexpr int kCoarseGrain = 128;  // coarse triangles for each part of a parallel loop

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

/// Elements of a chart in the UVs: its triangles, then its guards.
struct Elements {
  explicit Elements(const Chart& chart) : chart(chart), shares(triangle_shares(chart)) {}

  int size() const { return static_cast<int>(chart.triangles.size() + chart.guards.size()); }
  bool is_guard(int e) const { return e >= static_cast<int>(chart.triangles.size()); }
  const Guard& guard(int e) const { return chart.guards[e - chart.triangles.size()]; }
  const Triangle& corners(int e) const { return is_guard(e) ? guard(e).triangle : chart.triangles[e]; }
  double share(int e) const { return is_guard(e) ? guard(e).share : shares[e]; }

  const Chart& chart;
  std::vector<double> shares;
};

/// The coarse triangle that holds the middle of each element.
std::vector<int> places_of(const Elements& elements, const CoarseChart& coarse, const Locator& locator) {
  std::vector<int> out(elements.size());
  parallel_ranges(elements.size(), present_threads(), kGrain, [&](int begin, int end) {
    for (int e = begin; e < end; ++e) {
      const Triangle& t = elements.corners(e);
      const std::vector<Vec2>& uvs = elements.chart.uvs;
      out[e] = locator.locate((uvs[t[0]] + uvs[t[1]] + uvs[t[2]]) / 3, coarse.places[t[0]].triangle).triangle;
    }
  });
  return out;
}

Average average_of(const Elements& elements, int e, const ChartObjective& fine) {
  const Triangle& t = elements.corners(e);
  const std::vector<Vec2>& uvs = elements.chart.uvs;
  const Vec2 &a = uvs[t[0]], &b = uvs[t[1]], &c = uvs[t[2]];
  const double area = 0.5 * elements.share(e) * doubled_area(a, b, c);
  if (!(area > 0)) return {};
  const Mat2 j = jacobian(fine.inverse_edges[e], a, b, c);
  const Mat2 square = j * j.transpose();
  return {area, fine.weight[e], fine.weight[e] * square, fine.weight[e] * square.inverse()};
}

/// By coarse triangle, each sum in the order of its elements.
std::vector<Average> averages(const Chart& chart, const CoarseChart& coarse, const Locator& locator, const ChartObjective& fine) {
  const Elements elements(chart);
  const std::vector<int> places = places_of(elements, coarse, locator);
  const std::size_t count = coarse.mesh.triangles.size();
  std::vector<int> first(count + 1, 0), held(places.size());  // entries [first[t], first[t + 1]) lie in t
  for (const int place : places) ++first[place + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<int> next(first.begin(), first.end() - 1);
  for (int e = 0; e < elements.size(); ++e) held[next[places[e]]++] = e;
  std::vector<Average> out(count);
  parallel_ranges(static_cast<int>(count), present_threads(), kCoarseGrain, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      for (int k = first[t]; k < first[t + 1]; ++k) out[t] += average_of(elements, held[k], fine);
    }
  });
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
