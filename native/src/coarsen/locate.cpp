// A visibility walk, and a search of all triangles where the walk is stopped by the boundary.
#include "coarsen/locate.h"

#include <algorithm>
#include <utility>

#include "geometry/plane.h"

namespace atlas_refine {
namespace {

constexpr double kOutside = -1e-9;  // weights below count as outside
constexpr int kMostSteps = 500;

std::vector<std::array<int, 3>> neighbours_of(const std::vector<Triangle>& triangles) {
  struct Side {
    int low, high, triangle, corner;
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles[t][(k + 1) % 3], triangles[t][(k + 2) % 3]);
      sides.push_back({low, high, static_cast<int>(t), k});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return std::pair(a.low, a.high) < std::pair(b.low, b.high); });
  std::vector<std::array<int, 3>> out(triangles.size(), {-1, -1, -1});
  for (std::size_t k = 1; k < sides.size(); ++k) {
    const Side &a = sides[k - 1], &b = sides[k];
    if (a.low != b.low || a.high != b.high) continue;
    out[a.triangle][a.corner] = b.triangle;
    out[b.triangle][b.corner] = a.triangle;
  }
  return out;
}

double least_weight(const Place& place) { return *std::min_element(place.weights.begin(), place.weights.end()); }

}  // namespace

Locator::Locator(const std::vector<Vec2>& points, const std::vector<Triangle>& triangles)
    : points_(points), triangles_(triangles), neighbours_(neighbours_of(triangles)) {}

Place Locator::place_in(int triangle, const Vec2& point) const {
  const auto& [a, b, c] = triangles_[triangle];
  const double at_a = doubled_area(point, points_[b], points_[c]), at_b = doubled_area(point, points_[c], points_[a]);
  const double all = doubled_area(points_[a], points_[b], points_[c]);
  return {triangle, {at_a / all, at_b / all, 1 - (at_a + at_b) / all}};
}

Place Locator::locate(const Vec2& point, int near) const {
  Place place = place_in(near, point);
  for (int step = 0; step < kMostSteps; ++step) {
    std::array<int, 3> corners = {0, 1, 2};
    std::sort(corners.begin(), corners.end(), [&](int i, int j) { return place.weights[i] < place.weights[j]; });
    if (place.weights[corners[0]] >= kOutside) return place;
    const auto across = std::find_if(corners.begin(), corners.end(),
                                     [&](int k) { return place.weights[k] < kOutside && neighbours_[place.triangle][k] >= 0; });
    if (across == corners.end()) break;
    place = place_in(neighbours_[place.triangle][*across], point);
  }
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
    const Place other = place_in(t, point);
    if (least_weight(other) > least_weight(place)) place = other;
  }
  return place;
}

}  // namespace atlas_refine
