// The longest run of the outer boundary within a narrow strip, and the direction of its edges.
#include "pack/straight_border.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace atlas_refine {
namespace {

// As fractions of the boundary's length: what counts as a border. Of the charts of real atlases panels, planks and strips have
// 0.2 and more, organic ones less than 0.1, garments and cells up to 0.14.
constexpr double kLeastRun = 0.15;
// Less is enough where so much of the outline runs along it or across: letters, combs, stepped panels.
constexpr double kLeastRunOfSquare = 0.06;
constexpr double kSquare = 0.75;
constexpr double kSquareSine = 0.02;
// How far its vertices may lie beside the line. Along a circle a run is a twentieth.
constexpr double kStrip = 0.002;

std::vector<Vec2> outer_boundary(const Chart& chart) {
  std::vector<Vec2> points;
  for (int v : chart.boundary_loops.front()) points.push_back(chart.uvs[v]);
  return points;
}

double length_of(const std::vector<Vec2>& loop) {
  double length = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) length += (loop[(k + 1) % loop.size()] - loop[k]).norm();
  return length;
}

double angle_between(const Vec2& from, const Vec2& to) { return std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to)); }

/// The vertex at which the boundary turns most: no border runs on there.
std::size_t sharpest_corner(const std::vector<Vec2>& loop) {
  const std::size_t n = loop.size();
  std::size_t best = 0;
  double most = -1;
  for (std::size_t k = 0; k < n; ++k) {
    const double turn = std::abs(angle_between(loop[k] - loop[(k + n - 1) % n], loop[(k + 1) % n] - loop[k]));
    if (turn <= most) continue;
    most = turn;
    best = k;
  }
  return best;
}

/// Consecutive vertices, by their number from a corner on.
struct Run {
  std::size_t begin = 0, end = 0;
};

/// How far one can go on from vertex `begin` within a strip: all vertices are seen from it through the narrowing cone.
std::size_t end_of_run(const std::vector<Vec2>& points, std::size_t begin, double strip) {
  const Vec2 start = points[begin];
  Vec2 axis = Vec2::Zero();
  double low = -std::numbers::pi, high = std::numbers::pi, farthest = 0;
  for (std::size_t k = begin + 1; k < points.size(); ++k) {
    const Vec2 way = points[k] - start;
    const double distance = way.norm();
    if (distance < farthest - strip) return k - 1;
    farthest = std::max(farthest, distance);
    if (distance <= strip) continue;
    if (axis.isZero()) axis = way;
    const double angle = angle_between(axis, way), beside = std::asin(strip / distance);
    if (angle < low || angle > high) return k - 1;
    low = std::max(low, angle - beside);
    high = std::min(high, angle + beside);
  }
  return points.size() - 1;
}

/// The run's edge whose direction is the median by length: exact where the border is straight.
Vec2 median_edge(const std::vector<Vec2>& points, const Run& run) {
  const Vec2 chord = points[run.end] - points[run.begin];
  std::vector<std::pair<double, std::size_t>> edges;  // angle to the chord, and start
  double total = 0;
  for (std::size_t k = run.begin; k < run.end; ++k) {
    const Vec2 edge = points[k + 1] - points[k];
    edges.emplace_back(angle_between(chord, edge), k);
    total += edge.norm();
  }
  std::sort(edges.begin(), edges.end());
  double rest = 0.5 * total;
  std::size_t k = 0;
  while (k + 1 < edges.size() && (rest -= (points[edges[k].second + 1] - points[edges[k].second]).norm()) > 0) ++k;
  return points[edges[k].second + 1] - points[edges[k].second];
}

/// Of the outline the part that runs along the direction or across it.
double square_share(const std::vector<Vec2>& points, const Vec2& direction) {
  double square = 0, all = 0;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const Vec2 edge = points[k + 1] - points[k];
    const double along = std::abs(edge.dot(direction));
    const double across = std::abs(direction.x() * edge.y() - direction.y() * edge.x());
    all += edge.norm();
    if (std::min(along, across) <= kSquareSine * edge.norm()) square += edge.norm();
  }
  return square / all;
}

}  // namespace

std::optional<Turn> turn_onto_axis(const Chart& chart) {
  const std::vector<Vec2> loop = outer_boundary(chart);
  const double length = length_of(loop);
  std::vector<Vec2> points(loop.size() + 1);
  const std::size_t corner = sharpest_corner(loop);
  for (std::size_t k = 0; k <= loop.size(); ++k) points[k] = loop[(corner + k) % loop.size()];
  Run best;
  double longest = kLeastRunOfSquare * length;
  for (std::size_t begin = 0, end = 0; begin + 1 < points.size(); begin = end) {
    end = end_of_run(points, begin, kStrip * length);
    const double reach = (points[end] - points[begin]).norm();
    if (reach < longest) continue;
    longest = reach;
    best = {begin, end};
  }
  if (best.end == 0) return std::nullopt;
  const Vec2 direction = median_edge(points, best).normalized();
  if (longest < kLeastRun * length && square_share(points, direction) < kSquare) return std::nullopt;
  // The nearest of the four half-axes comes to lie on u.
  const Vec2 along = std::abs(direction.x()) >= std::abs(direction.y()) ? direction : Vec2(direction.y(), -direction.x());
  const double sign = along.x() > 0 ? 1 : -1;
  return Turn{sign * along.x(), -sign * along.y()};
}

}  // namespace atlas_refine
