// Orientation tests, and heights.
#include "repair/bad_triangles.h"

#include <algorithm>
#include <cmath>

#include "geometry/plane.h"
#include "geometry/predicates.h"
#include "geometry/rest_triangle.h"

namespace atlas_refine {

constexpr double kRounding = 1e-13;  // of the chart's size: triangles lower than that may flip where the chart is moved

std::vector<char> bad_triangles(const Chart& chart) {
  const double least = kRounding * uv_box({chart}).diagonal();
  std::vector<char> bad;
  bad.reserve(chart.triangles.size());
  for (const Triangle& t : chart.triangles) {
    const Vec2 &a = chart.uvs[t[0]], &b = chart.uvs[t[1]], &c = chart.uvs[t[2]];
    const double longest = std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
    const bool flat = doubled_area(a, b, c) < longest * std::max(kSliverHeight * longest, least);
    bad.push_back(flat || orientation(a, b, c) <= 0);
  }
  return bad;
}

DirichletSums sums_of_good(const Chart& chart) {
  const std::vector<char> bad = bad_triangles(chart);
  std::vector<RestTriangle> shapes;
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < bad.size(); ++t) {
    if (bad[t]) continue;
    shapes.push_back(chart.surface[t]);
    triangles.push_back(chart.triangles[t]);
  }
  return dirichlet_sums(shapes, triangles, chart.uvs);
}

double distortion_to_good(const Chart& before, const Chart& after) {
  return dirichlet_sums_between({before}, {after}).best_energy();
}

}  // namespace atlas_refine
