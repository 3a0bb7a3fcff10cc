// Vertices in cells, looked up where they would be mirrored to.
#include "needed/mirror_image.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace atlas_refine {
namespace {

constexpr double kSame = 1e-4;      // of the diagonal of all vertices: so near they are one
constexpr double kMirrored = 0.9;   // of the vertices have an image, where the surface has one
constexpr std::size_t kSome = 100;  // vertices tell most planes that are none

struct Plane {
  Vec3 at, normal;

  Vec3 image(const Vec3& p) const { return p - 2 * (p - at).dot(normal) * normal; }
};

/// Finds points by their places.
class Places {
 public:
  Places(const std::vector<Vec3>& points, double reach) : points_(points), reach_(reach) {
    for (int k = 0; k < static_cast<int>(points.size()); ++k) cells_.push_back({cell(points[k]), k});
    std::sort(cells_.begin(), cells_.end());
  }

  /// The nearest within reach, -1 where there is none.
  int find(const Vec3& at) const {
    const Cell own = cell(at);
    int best = -1;
    double nearest = reach_;
    for (int k = 0; k < 27; ++k) {
      const Cell next = {own[0] + k % 3 - 1, own[1] + k / 3 % 3 - 1, own[2] + k / 9 - 1};
      for (auto it = std::lower_bound(cells_.begin(), cells_.end(), Entry{next, 0}); it != cells_.end() && it->first == next;
           ++it) {
        const double distance = (points_[it->second] - at).norm();
        if (distance >= nearest) continue;
        nearest = distance;
        best = it->second;
      }
    }
    return best;
  }

 private:
  using Cell = std::array<long long, 3>;
  using Entry = std::pair<Cell, int>;

  Cell cell(const Vec3& p) const {
    return {static_cast<long long>(std::floor(p.x() / reach_)), static_cast<long long>(std::floor(p.y() / reach_)),
            static_cast<long long>(std::floor(p.z() / reach_))};
  }

  const std::vector<Vec3>& points_;
  double reach_;
  std::vector<Entry> cells_;
};

std::vector<Plane> likely_planes(const std::vector<Vec3>& points) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : points) middle += p / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3& p : points) spread += (p - middle) * (p - middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(spread);
  std::vector<Plane> out;
  for (int axis = 0; axis < 3; ++axis) {
    out.push_back({Vec3::Zero(), Vec3::Unit(axis)});
    out.push_back({middle, Vec3::Unit(axis)});
  }
  for (int axis = 0; axis < 3; ++axis) out.push_back({middle, eigen.eigenvectors().col(axis)});
  return out;
}

/// For each, or each of some, the one at its image; nothing where too many have none, or lie in the plane themselves.
std::vector<int> images(const std::vector<Vec3>& points, const Places& places, const Plane& plane, std::size_t step) {
  std::vector<int> out;
  std::size_t without = 0, inside = 0;
  for (std::size_t k = 0; k < points.size(); k += step) {
    out.push_back(places.find(plane.image(points[k])));
    without += out.back() < 0;
    inside += out.back() == static_cast<int>(k);
  }
  if (static_cast<double>(without) > (1 - kMirrored) * static_cast<double>(out.size()) || 2 * inside > out.size()) out.clear();
  return out;
}

/// By the first of the planes that mirrors the points.
std::vector<int> images(const std::vector<Vec3>& points) {
  if (points.empty()) return {};
  Vec3 low = points.front(), high = low;
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double reach = kSame * (high - low).norm();
  if (!(reach > 0)) return {};
  const Places places(points, reach);
  for (const Plane& plane : likely_planes(points)) {
    if (images(points, places, plane, points.size() / kSome + 1).empty()) continue;
    std::vector<int> all = images(points, places, plane, 1);
    if (!all.empty()) return all;
  }
  return {};
}

}  // namespace

MirrorImage::MirrorImage(const Atlas& atlas, const ChartSet& set) : atlas_(atlas), set_(set) {
  std::map<int, int> numbers;  // points that the charts have, in order
  for (const std::vector<int>& chart : set.points) {
    for (const int point : chart) numbers.emplace(point, 0);
  }
  std::vector<int> points;
  for (auto& [point, number] : numbers) {
    number = static_cast<int>(points.size());
    points.push_back(point);
  }
  std::vector<Vec3> places(points.size());
  for (const Chart& chart : set.charts) corner_of_.emplace_back(chart.vertex_count(), -1);
  for (int c = 0; c < atlas.corner_count(); ++c) {
    const auto [chart, vertex] = set.corners[c];
    if (chart < 0) continue;
    corner_of_[chart][vertex] = c;
    places[numbers[point_of(c)]] = atlas.positions[atlas.corner_vertices[c]];
  }
  const std::vector<int> mirrored = images(places);
  if (mirrored.empty()) return;
  images_.assign(points.back() + 1, -1);
  for (std::size_t k = 0; k < points.size(); ++k) images_[points[k]] = mirrored[k] < 0 ? -1 : points[mirrored[k]];
  for (int f = 0; f < atlas.face_count(); ++f) {
    face_of_.resize(atlas.face_offsets[f + 1], f);
    std::vector<int> key = points_of(f);
    std::sort(key.begin(), key.end());
    if (!key.empty()) faces_.emplace(std::move(key), f);
  }
}

int MirrorImage::point_of(int corner) const {
  const auto [chart, vertex] = set_.corners[corner];
  return set_.points[chart][vertex];
}

/// Empty for a face of no chart.
std::vector<int> MirrorImage::points_of(int face) const {
  std::vector<int> out;
  for (int c = atlas_.face_offsets[face]; c < atlas_.face_offsets[face + 1]; ++c) {
    if (set_.corners[c].chart < 0) return {};
    out.push_back(point_of(c));
  }
  return out;
}

std::optional<CornerRef> MirrorImage::of(const CornerRef& vertex) const {
  if (images_.empty() || vertex.vertex < 0 || vertex.vertex >= static_cast<int>(corner_of_[vertex.chart].size()))
    return std::nullopt;
  const int corner = corner_of_[vertex.chart][vertex.vertex];
  if (corner < 0) return std::nullopt;
  std::vector<int> key = points_of(face_of_[corner]);
  for (int& point : key) point = images_[point];
  std::sort(key.begin(), key.end());
  const auto found = faces_.find(key);
  const int image = images_[point_of(corner)];
  if (found == faces_.end()) return std::nullopt;
  for (int c = atlas_.face_offsets[found->second]; c < atlas_.face_offsets[found->second + 1]; ++c) {
    if (point_of(c) == image) return set_.corners[c];
  }
  return std::nullopt;
}

}  // namespace atlas_refine
