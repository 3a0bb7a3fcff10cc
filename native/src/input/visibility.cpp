// Pictures of each mesh's depth from directions all around, in parallel projection.
#include "input/visibility.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "input/places.h"
#include "support/parallel.h"

namespace atlas_refine {
namespace {

constexpr int kDirections = 32;
constexpr int kWidth = 128;         // of a picture, in pixels
constexpr double kGrazing = 0.2;    // least cosine: what is seen at less is not asked for
constexpr double kOnSurface = 1.5;  // pixels: how far the middle of a vertex' pixel may lie from it, and the slope besides
constexpr double kNowhere = -std::numeric_limits<double>::infinity();

/// Spread evenly over the sphere (a Fibonacci lattice).
Vec3 direction(int k) {
  const double z = 1 - (2 * k + 1.0) / kDirections, turn = k * std::numbers::pi * (3 - std::sqrt(5.0));
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

/// One mesh, its vertices by where they lie.
struct Body {
  std::vector<int> vertices;  ///< of the atlas, of each point
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;  ///< of points
  std::vector<Vec3> normals;                  ///< of unit length or zero
  Vec3 middle = Vec3::Zero();
  double radius = 0;
};

/// Places in a picture: x and y in pixels, z towards the eye in the same unit.
class Picture {
 public:
  Picture(const Body& body, const Vec3& towards_eye)
      : middle_(body.middle), scale_(0.5 * (kWidth - 2) / body.radius), depth_(kWidth * kWidth, kNowhere) {
    const Vec3 right = towards_eye.unitOrthogonal();
    axes_ << right.transpose(), towards_eye.cross(right).transpose(), towards_eye.transpose();
  }

  Vec3 place(const Vec3& p) const { return scale_ * (axes_ * (p - middle_)) + Vec3(0.5 * kWidth, 0.5 * kWidth, 0); }

  void draw(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 normal = (b - a).cross(c - a);
    if (normal.z() == 0) return;
    const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    for (int y = first_middle(low.y()); y + 0.5 <= high.y(); ++y) {
      for (int x = first_middle(low.x()); x + 0.5 <= high.x(); ++x) {
        const double px = x + 0.5, py = y + 0.5;
        if (!holds(a, b, c, px, py)) continue;
        const double z = a.z() - (normal.x() * (px - a.x()) + normal.y() * (py - a.y())) / normal.z();
        depth_[y * kWidth + x] = std::max(depth_[y * kWidth + x], z);
      }
    }
  }

  bool shows(const Vec3& p, double cosine) const {
    const double slope = std::sqrt(1 - cosine * cosine) / cosine;
    return p.z() + kOnSurface * (1 + slope) >= depth_[pixel(p.y()) * kWidth + pixel(p.x())];
  }

 private:
  static int pixel(double at) { return std::clamp(static_cast<int>(at), 0, kWidth - 1); }
  static int first_middle(double at) { return std::max(0, static_cast<int>(std::ceil(at - 0.5))); }
  static bool holds(const Vec3& a, const Vec3& b, const Vec3& c, double x, double y) {
    const auto side = [&](const Vec3& p, const Vec3& q) { return (q.x() - p.x()) * (y - p.y()) - (q.y() - p.y()) * (x - p.x()); };
    const double ab = side(a, b), bc = side(b, c), ca = side(c, a);
    return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
  }

  Vec3 middle_;
  double scale_;
  std::vector<double> depth_;
  Eigen::Matrix3d axes_;
};

std::vector<Body> bodies_of(const Atlas& atlas, const std::vector<int>& place) {
  std::map<int, Body> of_mesh;
  std::vector<int> point(atlas.positions.size(), -1);
  for (int f = 0; f < atlas.face_count(); ++f) {
    const int first = atlas.face_offsets[f], last = atlas.face_offsets[f + 1];
    Body& body = of_mesh[atlas.vertex_meshes.empty() ? 0 : atlas.vertex_meshes[atlas.corner_vertices[first]]];
    const auto point_of = [&](int corner) {
      const int v = place[atlas.corner_vertices[corner]];
      if (point[v] < 0) {
        point[v] = static_cast<int>(body.vertices.size());
        body.vertices.push_back(v);
      }
      return point[v];
    };
    for (int c = first + 1; c + 1 < last; ++c) body.triangles.push_back({point_of(first), point_of(c), point_of(c + 1)});
  }
  std::vector<Body> out;
  for (auto& [mesh, body] : of_mesh) out.push_back(std::move(body));
  return out;
}

void measure(const Atlas& atlas, Body& body) {
  Eigen::AlignedBox3d box;
  for (const int v : body.vertices) box.extend(body.points.emplace_back(atlas.positions[v]));
  body.middle = box.center();
  body.radius = 0.5 * box.diagonal().norm();
  body.normals.assign(body.points.size(), Vec3::Zero());
  for (const auto& [a, b, c] : body.triangles) {
    const Vec3 normal = (body.points[b] - body.points[a]).cross(body.points[c] - body.points[a]);
    for (const int v : {a, b, c}) body.normals[v] += normal;
  }
  for (Vec3& normal : body.normals) normal.normalize();
}

/// Per point whether it is seen from there; not those that look away.
std::vector<char> seen_from(const Body& body, const Vec3& towards_eye) {
  Picture picture(body, towards_eye);
  std::vector<Vec3> at;
  for (const Vec3& p : body.points) at.push_back(picture.place(p));
  for (const auto& [a, b, c] : body.triangles) picture.draw(at[a], at[b], at[c]);
  std::vector<char> out;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double cosine = body.normals[i].dot(towards_eye);
    out.push_back(cosine > kGrazing && picture.shows(at[i], cosine));
  }
  return out;
}

/// Per point.
std::vector<double> seen_from_around(const Body& body, int threads) {
  std::vector<std::vector<char>> seen(kDirections);
  parallel_ranges(kDirections, threads, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) seen[k] = seen_from(body, direction(k));
  });
  std::vector<double> out;
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    double all = 0, free = 0;
    for (int k = 0; k < kDirections; ++k) {
      const double cosine = body.normals[i].dot(direction(k));
      if (cosine <= kGrazing) continue;
      all += cosine;
      free += seen[k][i] ? cosine : 0;
    }
    out.push_back(all > 0 ? free / all : 1);
  }
  return out;
}

}  // namespace

std::vector<double> visibility(const Atlas& atlas, int threads) {
  const std::vector<int> place = places(atlas);
  std::vector<double> out(atlas.positions.size(), 1);
  for (Body& body : bodies_of(atlas, place)) {
    measure(atlas, body);
    if (!(body.radius > 0)) continue;
    const std::vector<double> seen = seen_from_around(body, threads);
    for (std::size_t i = 0; i < seen.size(); ++i) out[body.vertices[i]] = seen[i];
  }
  for (std::size_t v = 0; v < out.size(); ++v) out[v] = out[place[v]];
  return out;
}

}  // namespace atlas_refine
