// Interior angles, smoothing, and the rotation in closed form.
#include "align/polar_angles.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include "geometry/plane.h"

namespace atlas_refine {
namespace {

constexpr int kSmoothingRounds = 5;
constexpr double kSmoothed = 1e-4;    // largest change of an interior angle at which smoothing stops
constexpr double kKernelReach = 3.5;  // in units of sigma: exp(-6) is left beyond

double angle_between(const Vec2& a, const Vec2& b) { return std::atan2(cross(a, b), a.dot(b)); }

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// One application of eq. (3) to every direction. `centres` are positions of the edges' centres along the boundary.
std::vector<Vec2> filtered(const BoundaryAngles& boundary, const std::vector<double>& centres, double perimeter, double sigma,
                           const std::vector<Vec2>& directions) {
  const int n = boundary.size();
  const double reach = std::min(kKernelReach * sigma, 0.5 * perimeter);
  std::vector<Vec2> out(n);
  for (int i = 0; i < n; ++i) {
    Vec2 sum = boundary.lengths[i] * directions[i];
    for (const int way : {1, -1}) {
      for (int k = 1; k < n; ++k) {
        const int j = ((i + way * k) % n + n) % n;
        double distance = std::abs(centres[j] - centres[i]);
        const bool wrapped = way > 0 ? j < i : j > i;
        if (wrapped) distance = perimeter - distance;
        if (distance > reach) break;
        sum += boundary.lengths[j] * std::exp(-0.5 * distance * distance / (sigma * sigma)) * directions[j];
      }
    }
    out[i] = sum.norm() > 0 ? Vec2(sum.normalized()) : directions[i];
  }
  return out;
}

/// The loop from its vertex farthest from the boundary's centre on: what comes of it depends neither on the order of faces nor on
/// the turn of the input.
std::vector<int> from_farthest(const std::vector<Vec2>& uvs, std::vector<int> loop) {
  const std::size_t n = loop.size();
  Vec2 sum = Vec2::Zero();
  double perimeter = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = uvs[loop[i]], &b = uvs[loop[(i + 1) % n]];
    sum += 0.5 * (b - a).norm() * (a + b);
    perimeter += (b - a).norm();
  }
  const Vec2 centre = sum / perimeter;
  const auto nearer = [&](int a, int b) { return (uvs[a] - centre).squaredNorm() < (uvs[b] - centre).squaredNorm(); };
  std::rotate(loop.begin(), std::max_element(loop.begin(), loop.end(), nearer), loop.end());
  return loop;
}

}  // namespace

double BoundaryAngles::perimeter() const { return std::accumulate(lengths.begin(), lengths.end(), 0.0); }

BoundaryAngles polar_angles(const Chart& disk) {
  BoundaryAngles out;
  out.vertices = from_farthest(disk.uvs, disk.boundary_loops.front());
  const int n = out.size();
  std::vector<double> interior(disk.vertex_count(), 0);
  for (const Triangle& t : disk.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Vec2& p = disk.uvs[t[k]];
      interior[t[k]] += std::abs(angle_between(disk.uvs[t[(k + 1) % 3]] - p, disk.uvs[t[(k + 2) % 3]] - p));
    }
  }
  for (int i = 0; i < n; ++i) {
    const Vec2 edge = disk.uvs[out.vertices[(i + 1) % n]] - disk.uvs[out.vertices[i]];
    out.lengths.push_back(edge.norm());
    const double angle =
        i == 0 ? std::atan2(edge.y(), edge.x()) : out.angle_rad.back() + std::numbers::pi - interior[out.vertices[i]];
    out.angle_rad.push_back(angle);
  }
  return out;
}

std::vector<double> smoothed_angles(const BoundaryAngles& boundary, double sigma) {
  const int n = boundary.size();
  const double perimeter = boundary.perimeter();
  std::vector<double> centres(n);
  double at = 0;
  for (int i = 0; i < n; ++i) {
    centres[i] = at + 0.5 * boundary.lengths[i];
    at += boundary.lengths[i];
  }
  std::vector<double> angles = boundary.angle_rad;
  std::vector<Vec2> directions;
  for (double angle : angles) directions.push_back(direction(angle));
  for (int round = 0; round < kSmoothingRounds; ++round) {
    const std::vector<Vec2> next = filtered(boundary, centres, perimeter, sigma, directions);
    std::vector<double> turned(n, 0);
    for (int i = 0; i < n; ++i) {
      if (next[i].dot(directions[i]) < 0) continue;  // the angle would be ambiguous
      turned[i] = angle_between(directions[i], next[i]);
      directions[i] = next[i];
      angles[i] += turned[i];
    }
    double change = 0;
    for (int i = 0; i < n; ++i) change = std::max(change, std::abs(turned[i] - turned[(i + 1) % n]));
    if (change < kSmoothed) break;
  }
  return angles;
}

double aligning_rotation(const std::vector<double>& lengths, const std::vector<double>& angle_rad) {
  std::complex<double> sum = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) sum += std::polar(lengths[i], 4 * angle_rad[i]);
  return std::abs(sum) > 0 ? -0.25 * std::arg(sum) : 0;
}

}  // namespace atlas_refine
