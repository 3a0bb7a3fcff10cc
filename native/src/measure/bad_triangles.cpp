// Orientation tests, and heights.
#include "measure/bad_triangles.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/plane.h"
#include "geometry/predicates.h"
#include "geometry/rest_triangle.h"
#include "support/gathered.h"
#include "support/parallel.h"
#include "support/quantile.h"
#include "support/thread_pool.h"

namespace atlas_refine {
namespace {

/// e-folds from the chart's median stretch, above which a triangle at a bad one is drawn out.
constexpr double kDrawnOut = 1.2;
/// The same wherever a triangle is: no map of a surface without folds differs so much from place to place.
constexpr double kOutOfScale = 2;
/// Of the chart's size: triangles lower than that may flip where the chart is moved.
constexpr double kRounding = 1e-13;
/// Least / largest stretch of a triangle, as a part of what the chart has elsewhere, below which it is next to flat: the engine
/// gets out of that in hundreds of steps, stuck halfway, or not at all.
constexpr double kCrushed = 1e-4;
constexpr int kGrain = 4096;  // triangles

/// Logarithms of the largest and the least stretch of a positive triangle against the surface.
std::array<double, 2> log_stretch(const Chart& chart, std::size_t t) {
  const Triangle& v = chart.triangles[t];
  const RestTriangle uv = rest_from_plane(chart.uvs[v[0]], chart.uvs[v[1]], chart.uvs[v[2]], 1);
  if (uv.area == 0 || chart.surface[t].area == 0) return {INFINITY, -INFINITY};
  const Mat2 j = uv.inverse_edges.inverse() * chart.surface[t].inverse_edges;
  const double sum = std::hypot(j(0, 0) + j(1, 1), j(1, 0) - j(0, 1)), diff = std::hypot(j(0, 0) - j(1, 1), j(1, 0) + j(0, 1));
  const double largest = 0.5 * (sum + diff);
  return {std::log(largest), std::log(std::abs(j.determinant()) / largest)};
}

/// The medians over all but the bad triangles.
std::array<double, 2> usual_log_stretch(const Chart& chart, const std::vector<char>& bad) {
  const auto good = gathered<std::array<double, 2>>(static_cast<int>(bad.size()), kGrain, [&](int begin, int end, auto& out) {
    for (int t = begin; t < end; ++t) {
      if (!bad[t]) out.push_back(log_stretch(chart, t));
    }
  });
  std::array<std::vector<double>, 2> stretch;
  for (const auto& own : good) {
    for (int k = 0; k < 2; ++k) stretch[k].push_back(own[k]);
  }
  return {median(stretch[0]), median(stretch[1])};
}

/// What half of the surface of all but the bad triangles is below.
double median_on_surface(const Chart& chart, const std::vector<double>& values, const std::vector<char>& bad) {
  std::vector<std::pair<double, double>> with_area;
  double half = 0;
  for (std::size_t t = 0; t < bad.size(); ++t) {
    if (bad[t]) continue;
    with_area.emplace_back(values[t], chart.surface[t].area);
    half += 0.5 * chart.surface[t].area;
  }
  std::sort(with_area.begin(), with_area.end());
  std::size_t k = 0;
  for (double below = with_area[0].second; below < half && k + 1 < with_area.size(); below += with_area[++k].second) continue;
  return with_area[k].first;
}

/// Flipped, without area, or so thin that rounding may flip them.
std::vector<char> flat_triangles(const Chart& chart) {
  const double least = kRounding * uv_box({chart}).diagonal();
  std::vector<char> bad(chart.triangles.size());
  parallel_ranges(static_cast<int>(bad.size()), present_threads(), kGrain, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const Triangle& t = chart.triangles[k];
      const Vec2 &a = chart.uvs[t[0]], &b = chart.uvs[t[1]], &c = chart.uvs[t[2]];
      const double longest = std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
      const bool flat = doubled_area(a, b, c) < longest * std::max(kSliverHeight * longest, least);
      bad[k] = flat || orientation(a, b, c) <= 0;
    }
  });
  return bad;
}

/// Logarithm of the least stretch / the largest.
double log_slimness(const std::array<double, 2>& stretch) { return stretch[1] - stretch[0]; }

/// Triangles that are positive, but crushed against their shape on the surface as nearly all others are not.
void add_crushed(const Chart& chart, std::vector<char>& bad) {
  const auto count = static_cast<int>(bad.size());
  const auto crushed = gathered<int>(count, kGrain, [&](int begin, int end, std::vector<int>& out) {
    for (int t = begin; t < end; ++t) {
      if (!bad[t] && log_slimness(log_stretch(chart, t)) < std::log(kCrushed)) out.push_back(t);
    }
  });
  if (crushed.empty()) return;
  const double usual = log_slimness(usual_log_stretch(chart, bad));
  for (const int t : crushed) bad[t] = log_slimness(log_stretch(chart, t)) < std::log(kCrushed) + usual;
}

}  // namespace

std::vector<char> bad_triangles(const Chart& chart) {
  std::vector<char> bad = flat_triangles(chart);
  add_crushed(chart, bad);
  return bad;
}

std::vector<char> misshapen_triangles(const Chart& chart) {
  std::vector<char> bad = bad_triangles(chart);
  std::vector<char> at_bad(chart.vertex_count(), 0);
  for (std::size_t t = 0; t < bad.size(); ++t) {
    for (const int v : chart.triangles[t]) at_bad[v] = at_bad[v] || bad[t];
  }
  const auto count = std::count(bad.begin(), bad.end(), 1);
  if (count == 0 || count == static_cast<std::ptrdiff_t>(bad.size())) return bad;
  const std::array<double, 2> usual = usual_log_stretch(chart, bad);
  for (std::size_t t = 0; t < bad.size(); ++t) {
    const Triangle& v = chart.triangles[t];
    if (bad[t] || (!at_bad[v[0]] && !at_bad[v[1]] && !at_bad[v[2]])) continue;
    const auto own = log_stretch(chart, t);
    bad[t] = std::max(std::abs(own[0] - usual[0]), std::abs(own[1] - usual[1])) > kDrawnOut;
  }
  return bad;
}

std::vector<char> triangles_out_of_scale(const Chart& chart) {
  std::vector<char> out = misshapen_triangles(chart);
  const auto count = static_cast<int>(out.size());
  if (std::count(out.begin(), out.end(), 1) == count) return out;
  std::vector<double> largest(count, 0);
  parallel_ranges(count, present_threads(), kGrain, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) largest[t] = out[t] ? 0 : log_stretch(chart, t)[0];
  });
  const double usual = median_on_surface(chart, largest, out);
  for (int t = 0; t < count; ++t) out[t] = out[t] || largest[t] - usual > kOutOfScale;
  return out;
}

bool mostly_bad(const Chart& chart, const std::vector<char>& bad) {
  double area = 0;
  for (std::size_t t = 0; t < bad.size(); ++t) area += bad[t] ? chart.surface[t].area : 0;
  return area > 0.5 * chart.surface.area();
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
  const std::vector<char> misshapen = misshapen_triangles(before);
  if (misshapen == flat_triangles(before)) return dirichlet_sums_between({before}, {after}).best_energy();
  std::vector<RestTriangle> shapes;
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < misshapen.size(); ++t) {
    const Triangle& v = before.triangles[t];
    if (misshapen[t]) continue;
    shapes.push_back(rest_from_plane(before.uvs[v[0]], before.uvs[v[1]], before.uvs[v[2]], 1));
    triangles.push_back(v);
  }
  return dirichlet_sums(shapes, triangles, after.uvs).best_energy();
}

}  // namespace atlas_refine
