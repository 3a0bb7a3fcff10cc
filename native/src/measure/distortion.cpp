// Distortion of charts against the surface: E_d (eq. 9), E_2, stretch.
#include "measure/distortion.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/guards.h"
#include "geometry/rest_triangle.h"
#include "solve/symmetric_dirichlet.h"
#include "support/parallel.h"
#include "support/thread_pool.h"

namespace atlas_refine {

namespace {

Mat2 uv_edges(const Triangle& v, const std::vector<Vec2>& uvs) {
  Mat2 edges;
  edges.col(0) = uvs[v[1]] - uvs[v[0]];
  edges.col(1) = uvs[v[2]] - uvs[v[0]];
  return edges;
}

Mat2 uv_edges(const Chart& chart, std::size_t triangle) { return uv_edges(chart.triangles[triangle], chart.uvs); }

constexpr double kPercentile = 0.99;

/// |J|^2 and |J^-1|^2 = |J|^2 / det^2 of one triangle. One without UV area is left out: it would make every sum infinite.
/// The determinant is taken factor by factor, so that it is zero where the UV edges are parallel.
void add_triangle(const Mat2& uv_edges, const Mat2& inverse_edges, double area, DirichletSums& sums) {
  const double determinant = uv_edges.determinant() * inverse_edges.determinant();
  const double dirichlet = (uv_edges * inverse_edges).squaredNorm();
  const double inverse = dirichlet / (determinant * determinant);
  if (!std::isfinite(inverse)) return;
  sums.dirichlet += area * dirichlet;
  sums.inverse += area * inverse;
  sums.area += area;
}

}  // namespace

DirichletSums& DirichletSums::operator+=(const DirichletSums& other) {
  dirichlet += other.dirichlet;
  inverse += other.inverse;
  area += other.area;
  return *this;
}

double DirichletSums::best_scale() const { return dirichlet > 0 ? std::sqrt(std::sqrt(inverse / dirichlet)) : 1; }

double DirichletSums::best_energy() const {
  if (!(area > 0)) return std::numeric_limits<double>::infinity();
  return std::sqrt(dirichlet) * std::sqrt(inverse) / (2 * area);
}

DirichletSums dirichlet_sums(const Chart& chart) {
  DirichletSums sums;
  for_each_element(chart, [&](const Triangle& triangle, const RestTriangle& shape, double share, int) {
    add_triangle(uv_edges(triangle, chart.uvs), shape.inverse_edges, share * shape.area, sums);
  });
  return sums;
}

DirichletSums dirichlet_sums(const std::vector<RestTriangle>& rest, const std::vector<Triangle>& triangles,
                             const std::vector<Vec2>& uvs) {
  DirichletSums sums;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    add_triangle(uv_edges(triangles[t], uvs), rest[t].inverse_edges, rest[t].area, sums);
  return sums;
}

DirichletSums dirichlet_sums(const std::vector<Chart>& charts) {
  DirichletSums sums;
  for (const Chart& chart : charts) sums += dirichlet_sums(chart);
  return sums;
}

DirichletSums dirichlet_sums_between(const std::vector<Chart>& from, const std::vector<Chart>& to) {
  DirichletSums sums;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const std::vector<Vec2>& uvs = from[k].uvs;
    for_each_element(to[k], [&](const Triangle& v, const RestTriangle&, double share, int) {
      const RestTriangle rest = rest_from_plane(uvs[v[0]], uvs[v[1]], uvs[v[2]], 1);
      if (rest.area > 0) add_triangle(uv_edges(v, to[k].uvs), rest.inverse_edges, share * rest.area, sums);
    });
  }
  return sums;
}

double triangle_stretch(const RestTriangle& rest, const Triangle& triangle, const std::vector<Vec2>& uvs, double scale) {
  const Mat2 edges = scale * uv_edges(triangle, uvs);
  const Mat2 jacobian = edges * rest.inverse_edges;
  // s1 + s2 and s1 - s2 from the parts of J that turn and that mirror.
  const double sum = std::hypot(jacobian(0, 0) + jacobian(1, 1), jacobian(1, 0) - jacobian(0, 1));
  const double difference = std::hypot(jacobian(0, 0) - jacobian(1, 1), jacobian(1, 0) + jacobian(0, 1));
  const double s1 = 0.5 * (sum + difference);
  const double s2 = std::abs(edges.determinant() * rest.inverse_edges.determinant()) / s1;
  return s2 > 0 ? std::max(s1, 1 / s2) : std::numeric_limits<double>::infinity();
}

std::vector<double> triangle_stretch(const Chart& chart, double scale) {
  constexpr int kGrain = 4096;
  std::vector<double> out(chart.triangles.size());
  parallel_ranges(static_cast<int>(out.size()), present_threads(), kGrain, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) out[t] = triangle_stretch(chart.surface[t], chart.triangles[t], chart.uvs, scale);
  });
  return out;
}

double stretch_99(std::vector<StretchedArea> all) {
  double total = 0, below = 0;
  for (const StretchedArea& one : all) total += one.area;
  // Halved until one is left: the half that it is not in needs no order.
  auto first = all.begin(), last = all.end();
  while (last - first > 1) {
    const auto middle = first + (last - first) / 2;
    std::nth_element(first, middle, last, [](const auto& a, const auto& b) { return a.stretch < b.stretch; });
    double before = below;
    for (auto one = first; one != middle; ++one) before += one->area;
    if (before >= kPercentile * total) {
      last = middle;
    } else {
      below = before;
      first = middle;
    }
  }
  return first->stretch;
}

double stretch_99(const std::vector<Chart>& charts, double scale) {
  std::vector<StretchedArea> all;
  for (const Chart& chart : charts) {
    const std::vector<double> stretch = triangle_stretch(chart, scale);
    for (std::size_t t = 0; t < stretch.size(); ++t) all.push_back({stretch[t], chart.surface[t].area});
  }
  return stretch_99(std::move(all));
}

double DistortionLimits::used(double distortion_is, double stretch_is) const {
  return std::max(distortion > 0 ? distortion_is / distortion : 0, stretch > 0 ? stretch_is / stretch : 0);
}

double DistortionLimits::used_by(const std::vector<Chart>& charts) const {
  if (!any()) return 0;
  const DirichletSums sums = dirichlet_sums(charts);
  return used(sums.best_energy(), stretch > 0 ? stretch_99(charts, sums.best_scale()) : 0);
}

std::vector<double> triangle_losses(const Chart& chart, double scale) {
  std::vector<double> losses;
  losses.reserve(chart.triangles.size());
  for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
    const auto [a, b, c] = chart.triangles[t];
    const Mat2 j = scale * jacobian(chart.surface[t].inverse_edges, chart.uvs[a], chart.uvs[b], chart.uvs[c]);
    losses.push_back(chart.surface[t].area * (symmetric_dirichlet(j) - 1));
  }
  return losses;
}

double uv_area(const Chart& chart) {
  double area = 0;
  for (std::size_t t = 0; t < chart.triangles.size(); ++t) area += 0.5 * std::abs(uv_edges(chart, t).determinant());
  return area;
}

double uv_area(const std::vector<Chart>& charts) {
  double area = 0;
  for (const Chart& chart : charts) area += uv_area(chart);
  return area;
}

double texel_density(const Chart& chart) { return std::sqrt(uv_area(chart) / chart.surface.area()); }

double texel_density(const std::vector<Chart>& charts) {
  double surface = 0;
  for (const Chart& chart : charts) surface += chart.surface.area();
  return std::sqrt(uv_area(charts) / surface);
}

double uv_perimeter(const std::vector<Chart>& charts) {
  double perimeter = 0;
  for (const Chart& chart : charts) {
    for (const auto& loop : chart.boundary_loops) {
      for (std::size_t k = 0; k < loop.size(); ++k)
        perimeter += (chart.uvs[loop[(k + 1) % loop.size()]] - chart.uvs[loop[k]]).norm();
    }
  }
  return perimeter;
}

Box uv_box(const std::vector<Chart>& charts) {
  Box box;
  bool first = true;
  for (const Chart& chart : charts) {
    for (const Vec2& uv : chart.uvs) {
      box.min = first ? uv : box.min.cwiseMin(uv);
      box.max = first ? uv : box.max.cwiseMax(uv);
      first = false;
    }
  }
  return box;
}

Box box_of_points(const std::vector<Vec2>& points) {
  Box box{points.front(), points.front()};
  for (const Vec2& p : points) {
    box.min = box.min.cwiseMin(p);
    box.max = box.max.cwiseMax(p);
  }
  return box;
}

Box box_of_aspect(const Box& box, double aspect) {
  if (aspect == 0) return box;
  const double height = std::max(box.size().y(), box.size().x() / aspect);
  return {box.min, box.min + Vec2(height * aspect, height)};
}

Vec2 sides_of_area(double area, double aspect) {
  const double height = std::sqrt(area / (aspect > 0 ? aspect : 1));
  return {height * (aspect > 0 ? aspect : 1), height};
}

}  // namespace atlas_refine
