// The classical dynamic program over the chords of a polygon (minimum weight triangulation).
#include "geometry/least_flipped.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "geometry/plane.h"

namespace atlas_refine {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

constexpr int kMostCorners = 1000;       // the time grows with their cube
constexpr double kThin = 1e-5;           // height / longest side: what single precision makes of a straight line
constexpr double kLengthCounts = 1e-12;  // against flipped area: where nothing else tells

/// Moved and scaled: its box has a diagonal of 1. Counterclockwise, for the most part.
void normalise(std::vector<Vec2>& polygon) {
  Vec2 low = polygon[0], high = low;
  for (const Vec2& p : polygon) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double size = (high - low).norm();
  const double scale = size > 0 ? 1 / size : 0;
  const double turn = doubled_area(polygon) < 0 ? -1 : 1;
  for (Vec2& p : polygon) p = {turn * scale * (p.x() - low.x()), scale * (p.y() - low.y())};
}

/// Seen along its mean normal.
std::vector<Vec2> flattened(const std::vector<Vec3>& polygon) {
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i) normal += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  normal.normalize();
  const Vec3 across = normal.unitOrthogonal(), up = normal.cross(across);
  std::vector<Vec2> out;
  out.reserve(polygon.size());
  for (const Vec3& p : polygon) out.emplace_back(across.dot(p - polygon[0]), up.dot(p - polygon[0]));
  return out;
}

std::pair<int, int> ordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// The best triangulation of the corners from i to j, cut off by the chord between them.
struct Part {
  double cost = kInfinite;
  int apex = -1;  ///< of the triangle at the chord
};

class Parts {
 public:
  explicit Parts(int count) : count_(count), parts_(static_cast<std::size_t>(count) * count) {}
  Part& at(int i, int j) { return parts_[static_cast<std::size_t>(i) * count_ + j]; }

  /// Of the part from i to j.
  std::vector<Triangle> triangles(int i, int j) {
    std::vector<Triangle> out;
    std::vector<std::pair<int, int>> open = {{i, j}};
    while (!open.empty()) {
      const auto [a, b] = open.back();
      open.pop_back();
      if (b - a < 2) continue;
      const int apex = at(a, b).apex;
      out.push_back({a, apex, b});
      open.insert(open.end(), {{a, apex}, {apex, b}});
    }
    std::sort(out.begin(), out.end());
    return out;
  }

 private:
  int count_;
  std::vector<Part> parts_;
};

}  // namespace

FlippedArea::FlippedArea(std::vector<Vec2> uvs, const std::vector<Vec3>& positions)
    : outlines_{std::move(uvs), flattened(positions)} {
  for (int k = 0; k < 2; ++k) {
    normalise(outlines_[k]);
    tells_[k] = doubled_area(outlines_[k]) > kThin;
    if (!tells_[k]) outlines_[k].assign(outlines_[k].size(), Vec2::Zero());
  }
}

double FlippedArea::of(const Triangle& t) const {
  double sum = 0;
  for (int k = 0; k < 2; ++k) {
    if (!tells_[k]) continue;
    const Vec2 &a = outlines_[k][t[0]], &b = outlines_[k][t[1]], &c = outlines_[k][t[2]];
    const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    sum += std::max(0.0, kThin * longest - doubled_area(a, b, c));
  }
  return sum;
}

double FlippedArea::of(const std::vector<Triangle>& triangles) const {
  double sum = 0;
  for (const Triangle& t : triangles) sum += of(t);
  return sum;
}

double FlippedArea::length_squared(int a, int b) const {
  return (outlines_[0][b] - outlines_[0][a]).squaredNorm() + (outlines_[1][b] - outlines_[1][a]).squaredNorm();
}

std::optional<std::vector<Triangle>> least_flipped(const FlippedArea& flipped, const std::vector<int>& vertices) {
  const int count = flipped.corner_count();
  if (count > kMostCorners) return std::nullopt;
  std::set<std::pair<int, int>> sides;
  for (int i = 0; i < count; ++i) sides.insert(ordered(vertices[i], vertices[(i + 1) % count]));
  Parts parts(count);
  for (int i = 0; i + 1 < count; ++i) parts.at(i, i + 1).cost = 0;
  for (int span = 2; span < count; ++span) {
    for (int i = 0, j = span; j < count; ++i, ++j) {
      const bool whole = span == count - 1;
      if (vertices[i] == vertices[j] || (!whole && sides.contains(ordered(vertices[i], vertices[j])))) continue;
      Part& part = parts.at(i, j);
      for (int k = i + 1; k < j; ++k) {
        const double cost = parts.at(i, k).cost + parts.at(k, j).cost;
        if (!(cost < part.cost)) continue;
        const double all = cost + flipped.of({i, k, j});
        if (all < part.cost) part = {all, k};
      }
      part.cost += kLengthCounts * flipped.length_squared(i, j);
    }
  }
  if (parts.at(0, count - 1).cost == kInfinite) return std::nullopt;
  return parts.triangles(0, count - 1);
}

}  // namespace atlas_refine
