// Surfaces from space, and what stands for the triangles that have no shape there.
#include "input/surfaces.h"

#include <cmath>

#include "geometry/plane.h"
#include "geometry/rest_triangle.h"

namespace atlas_refine {

namespace {

using Shapes = std::vector<RestTriangle>;  // of one chart

/// Weight of a face without a shape in space, as a fraction of the mean triangle: it must not count, and must not be zero.
constexpr double kSliverWeight = 1e-6;
// What stands for the shape of a face that has none in the UV plane either: its sides in space, this high on the longest one; of
// a point an equilateral of so much area, as a fraction of the mean triangle.
constexpr double kRaisedHeight = 0.02;
constexpr double kPointArea = 1e-4;

Shapes shapes_in_space(const Chart& chart, const std::vector<Vec3>& positions) {
  Shapes shapes;
  shapes.reserve(chart.triangles.size());
  for (const Triangle& t : chart.triangles) {
    shapes.push_back(rest_from_space(positions[t[0]], positions[t[1]], positions[t[2]]));
  }
  return shapes;
}

double mean_area(const std::vector<Shapes>& charts) {
  double area = 0;
  std::size_t count = 0;
  for (const Shapes& shapes : charts) {
    count += shapes.size();
    for (const RestTriangle& rest : shapes) area += rest.area;
  }
  return area > 0 ? area / static_cast<double>(count) : 1;
}

/// Surface units for one UV unit, over the triangles that have a shape.
double surface_scale(const Chart& chart, const Shapes& shapes) {
  double surface = 0, plane = 0;
  for (std::size_t t = 0; t < shapes.size(); ++t) {
    const Triangle& v = chart.triangles[t];
    if (shapes[t].area == 0) continue;
    surface += shapes[t].area;
    plane += 0.5 * std::abs(doubled_area(chart.uvs[v[0]], chart.uvs[v[1]], chart.uvs[v[2]]));
  }
  const double ratio = std::sqrt(surface / plane);
  return ratio > 0 && std::isfinite(ratio) ? ratio : 1;
}

void give_slivers_a_shape(const Chart& chart, const std::vector<Vec3>& positions, double scale, double mean, Shapes& shapes) {
  for (std::size_t t = 0; t < shapes.size(); ++t) {
    const Triangle& v = chart.triangles[t];
    RestTriangle& rest = shapes[t];
    if (rest.area > 0) continue;
    rest = rest_from_plane(chart.uvs[v[0]], chart.uvs[v[1]], chart.uvs[v[2]], scale);
    if (rest.area == 0) rest = rest_raised(positions[v[0]], positions[v[1]], positions[v[2]], kRaisedHeight);
    if (rest.area == 0) rest = rest_equilateral(kPointArea * mean);
    rest.area = kSliverWeight * mean;
  }
}

/// Guards without a shape in space get the one of the UVs, and are not measured.
void give_guards_a_shape(double scale, Chart& chart) {
  for (Guard& guard : chart.guards) {
    const Triangle& v = guard.triangle;
    if (guard.shape.area > 0) continue;
    guard.share = 0;
    guard.shape = rest_from_plane(chart.uvs[v[0]], chart.uvs[v[1]], chart.uvs[v[2]], scale);
  }
}

}  // namespace

void set_surfaces(std::vector<Chart>& charts, const std::vector<std::vector<Vec3>>& positions) {
  std::vector<Shapes> shapes;
  for (std::size_t k = 0; k < charts.size(); ++k) shapes.push_back(shapes_in_space(charts[k], positions[k]));
  const double mean = mean_area(shapes);
  for (std::size_t k = 0; k < charts.size(); ++k) {
    const double scale = surface_scale(charts[k], shapes[k]);
    give_slivers_a_shape(charts[k], positions[k], scale, mean, shapes[k]);
    give_guards_a_shape(scale, charts[k]);
    charts[k].surface = Surface(std::move(shapes[k]));
  }
}

void turn_triangles_over(Chart& chart) {
  const auto turn = [](Triangle& triangle, RestTriangle& rest) {
    std::swap(triangle[1], triangle[2]);
    // The edges change places and the flat triangle is turned over, to stay counterclockwise.
    rest.inverse_edges.row(0).swap(rest.inverse_edges.row(1));
    rest.inverse_edges.col(1) *= -1;
  };
  Shapes turned(chart.surface.begin(), chart.surface.end());
  for (std::size_t t = 0; t < turned.size(); ++t) turn(chart.triangles[t], turned[t]);
  for (Guard& guard : chart.guards) turn(guard.triangle, guard.shape);
  chart.surface = Surface(std::move(turned));
}

}  // namespace atlas_refine
