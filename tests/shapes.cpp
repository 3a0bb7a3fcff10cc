// Generated test atlases: outlines sampled at the edge length, a hexagonal grid of inner points, a constrained Delaunay between.
#include "shapes.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <set>
#include <stdexcept>

#include "support/rng.h"

namespace atlas_refine::shapes {
namespace {

constexpr double kPi = std::numbers::pi;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using Tds = CGAL::Triangulation_data_structure_2<VertexBase, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Tds>;

double loop_area(const std::vector<Vec2>& loop) {
  double twice = 0;
  for (size_t i = 0; i < loop.size(); ++i) {
    const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

double point_segment_distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 edge = b - a;
  const double t = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
  return (p - a - t * edge).norm();
}

double side(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool segments_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return (side(a, b, c) > 0) != (side(a, b, d) > 0) && (side(c, d, a) > 0) != (side(c, d, b) > 0);
}

bool inside(const std::vector<std::vector<Vec2>>& loops, const Vec2& p) {
  bool odd = false;
  for (const auto& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
      if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) odd = !odd;
    }
  }
  return odd;
}

std::vector<Vec2> sampled(const std::vector<Vec2>& loop, double edge_length) {
  std::vector<Vec2> samples;
  for (size_t i = 0; i < loop.size(); ++i) {
    const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
    const int parts = std::max(1, static_cast<int>(std::lround((b - a).norm() / edge_length)));
    for (int k = 0; k < parts; ++k) samples.push_back(a + (b - a) * (static_cast<double>(k) / parts));
  }
  return samples;
}

/// The faces outside the polygon: an even number of constraints away from infinity. By connectivity, not by coordinates:
/// samples of a straight line are not exactly collinear.
std::set<Cdt::Face_handle> faces_outside(const Cdt& cdt) {
  std::set<Cdt::Face_handle> seen{cdt.infinite_face()}, outside = seen;
  std::deque<Cdt::Face_handle> queue{cdt.infinite_face()};
  while (!queue.empty()) {
    const auto face = queue.front();
    queue.pop_front();
    for (int i = 0; i < 3; ++i) {
      const auto next = face->neighbor(i);
      if (!seen.insert(next).second) continue;
      const bool crosses = face->is_constrained(i);
      if ((outside.count(face) > 0) != crosses) outside.insert(next);
      queue.push_back(next);
    }
  }
  return outside;
}

double boundary_distance(const std::vector<std::vector<Vec2>>& loops, const Vec2& p) {
  double nearest = INFINITY;
  for (const auto& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i)
      nearest = std::min(nearest, point_segment_distance(p, loop[i], loop[(i + 1) % loop.size()]));
  }
  return nearest;
}

/// Points of a hexagonal grid inside the loops, well away from them.
std::vector<Vec2> inner_points(const std::vector<std::vector<Vec2>>& loops, double edge_length) {
  Vec2 low = loops[0][0], high = loops[0][0];
  for (const Vec2& p : loops[0]) low = low.cwiseMin(p), high = high.cwiseMax(p);
  std::vector<Vec2> points;
  const double row_height = edge_length * std::sqrt(0.75);
  for (int row = 1; low.y() + row * row_height < high.y(); ++row) {
    for (int column = 0; low.x() + column * edge_length < high.x(); ++column) {
      const Vec2 p(low.x() + (column + 0.5 * (row % 2)) * edge_length, low.y() + row * row_height);
      if (inside(loops, p) && boundary_distance(loops, p) > 0.6 * edge_length) points.push_back(p);
    }
  }
  return points;
}

/// The wavy surface; `bend` is about its steepest slope.
Vec3 lifted(const Vec2& p, double bend) {
  return {p.x(), p.y(),
          bend * (0.35 * std::sin(2.1 * p.x() + 0.4) * std::cos(1.7 * p.y() - 0.3) + 0.2 * std::sin(1.3 * p.y() + 0.9 * p.x()))};
}

void add_face(Atlas& atlas, const std::vector<int>& vertices, const std::vector<Vec2>& uvs) {
  if (atlas.face_offsets.empty()) atlas.face_offsets.push_back(0);
  for (int v : vertices) {
    atlas.corner_vertices.push_back(v);
    atlas.corner_uvs.push_back(uvs[v]);
  }
  atlas.face_offsets.push_back(atlas.corner_count());
}

/// A band along the centre line, `halves` on each side: rows of two triangles per cell. UVs and positions by callback.
template <class Point>
Polygon band(double from_angle, double to_angle, int steps, const Point& edge_point) {
  Polygon polygon;
  for (int k = 0; k <= steps; ++k) polygon.outer.push_back(edge_point(from_angle + (to_angle - from_angle) * k / steps, +1));
  for (int k = steps; k >= 0; --k) polygon.outer.push_back(edge_point(from_angle + (to_angle - from_angle) * k / steps, -1));
  return polygon;
}

Vec2 polar(double radius, double angle_rad) { return {radius * std::cos(angle_rad), radius * std::sin(angle_rad)}; }

bool clear_of_itself(const std::vector<Vec2>& loop, double clearance, double smallest_angle_rad) {
  const int n = static_cast<int>(loop.size());
  for (int i = 0; i < n; ++i) {
    const Vec2 before = loop[(i + n - 1) % n] - loop[i], after = loop[(i + 1) % n] - loop[i];
    const double cosine = before.dot(after) / (before.norm() * after.norm());
    if (cosine > std::cos(smallest_angle_rad)) return false;
    for (int k = 0; k < n; ++k) {
      if (k == i || (k + 1) % n == i) continue;
      if (point_segment_distance(loop[i], loop[k], loop[(k + 1) % n]) < clearance) return false;
    }
  }
  return true;
}

/// Reverses stretches of the tour until no two of its edges cross; each reversal shortens it, so this ends.
void uncross(std::vector<Vec2>& tour) {
  const int n = static_cast<int>(tour.size());
  for (bool changed = true; changed;) {
    changed = false;
    for (int i = 0; i < n; ++i) {
      for (int k = i + 2; k < n; ++k) {
        if (i == 0 && k == n - 1) continue;
        if (!segments_cross(tour[i], tour[i + 1], tour[k], tour[(k + 1) % n])) continue;
        std::reverse(tour.begin() + i + 1, tour.begin() + k + 1);
        changed = true;
      }
    }
  }
}

}  // namespace

double area(const Polygon& polygon) {
  double sum = loop_area(polygon.outer);
  for (const auto& hole : polygon.holes) sum += loop_area(hole);
  return sum;
}

Polygon transformed(const Polygon& polygon, double scale, double angle_rad, const Vec2& offset) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  const auto move = [&](std::vector<Vec2> loop) {
    for (Vec2& p : loop) p = scale * Vec2(c * p.x() - s * p.y(), s * p.x() + c * p.y()) + offset;
    return loop;
  };
  Polygon result{move(polygon.outer), {}};
  for (const auto& hole : polygon.holes) result.holes.push_back(move(hole));
  return result;
}

Polygon rectangle(double width, double height) { return {{{0, 0}, {width, 0}, {width, height}, {0, height}}, {}}; }

Polygon disk(double radius, int corners) {
  Polygon polygon;
  for (int k = 0; k < corners; ++k) polygon.outer.push_back(polar(radius, 2 * kPi * k / corners));
  return polygon;
}

Polygon ring(double inner_radius, double outer_radius) {
  Polygon polygon = disk(outer_radius);
  polygon.holes.push_back(disk(inner_radius).outer);
  std::reverse(polygon.holes[0].begin(), polygon.holes[0].end());
  return polygon;
}

Polygon c_shape() {
  return band(0.25 * kPi, 1.75 * kPi, 24, [](double angle, int which) { return polar(which > 0 ? 0.5 : 0.3, angle); });
}

Polygon s_shape() {
  // Two three-quarter arcs joined at the centre; the centre line is walked once along each of its sides.
  constexpr double kRadius = 0.26, kHalfWidth = 0.08;
  std::vector<Vec2> left, right;
  for (int k = 0; k <= 36; ++k) {
    const bool upper = k < 18;
    const double angle = upper ? kPi * (0.0 + 1.5 * k / 18) : kPi * (0.5 - 1.5 * (k - 18) / 18);
    const Vec2 centre(0, upper ? kRadius : -kRadius);
    const double outward = upper ? kHalfWidth : -kHalfWidth;
    right.push_back(centre + polar(kRadius + outward, angle));
    left.push_back(centre + polar(kRadius - outward, angle));
  }
  Polygon polygon{right, {}};
  polygon.outer.insert(polygon.outer.end(), left.rbegin(), left.rend());
  if (loop_area(polygon.outer) < 0) std::reverse(polygon.outer.begin(), polygon.outer.end());
  return polygon;
}

Polygon u_shape() { return {{{0, 0}, {0.8, 0}, {0.8, 1}, {0.6, 1}, {0.6, 0.2}, {0.2, 0.2}, {0.2, 1}, {0, 1}}, {}}; }

Polygon spiral(double turns) {
  const double pitch = 0.38 / turns;
  return band(0, 2 * kPi * turns, static_cast<int>(24 * turns),
              [&](double angle, int which) { return polar(0.1 + pitch * angle / (2 * kPi) + which * 0.32 * pitch, angle); });
}

Polygon comb(int teeth) {
  Polygon polygon;
  const double pitch = 1.0 / (2 * teeth - 1);
  polygon.outer = {{0, 0}, {1, 0}};
  for (int k = teeth - 1; k >= 0; --k) {
    const double left = 2 * k * pitch;
    polygon.outer.insert(polygon.outer.end(), {{left + pitch, 0.6}, {left, 0.6}});
    if (k > 0) polygon.outer.insert(polygon.outer.end(), {{left, 0.15}, {left - pitch, 0.15}});
  }
  return polygon;
}

Polygon star(int points) {
  Polygon polygon;
  for (int k = 0; k < 2 * points; ++k) polygon.outer.push_back(polar(k % 2 == 0 ? 0.5 : 0.22, kPi * k / points + 0.5 * kPi));
  return polygon;
}

Polygon random_star_polygon(std::uint64_t seed, int corners) {
  Rng rng(seed, 1);
  Polygon polygon;
  for (int k = 0; k < corners; ++k)
    polygon.outer.push_back(polar(rng.uniform(0.22, 0.5), 2 * kPi * (k + rng.uniform(-0.3, 0.3)) / corners));
  return polygon;
}

Polygon random_polygon(std::uint64_t seed, int corners) {
  for (int attempt = 0; attempt < 10000; ++attempt) {
    Rng rng(seed, 2, attempt);
    std::vector<Vec2> tour(corners);
    for (Vec2& p : tour) {
      p.x() = rng.uniform();
      p.y() = rng.uniform();
    }
    uncross(tour);
    if (loop_area(tour) < 0) std::reverse(tour.begin(), tour.end());
    if (loop_area(tour) > 0.15 && clear_of_itself(tour, 0.04, kPi / 9)) return {tour, {}};
  }
  throw std::logic_error("random_polygon: too many corners for its clearance");
}

Atlas mesh(const Polygon& polygon, double edge_length, double bend) {
  std::vector<std::vector<Vec2>> loops{sampled(polygon.outer, edge_length)};
  for (const auto& hole : polygon.holes) loops.push_back(sampled(hole, edge_length));
  Cdt cdt;
  std::vector<Vec2> uvs;
  const auto insert = [&](const Vec2& p) {
    const auto vertex = cdt.insert({p.x(), p.y()});
    vertex->info() = static_cast<int>(uvs.size());
    uvs.push_back(p);
    return vertex;
  };
  for (const auto& loop : loops) {
    std::vector<Cdt::Vertex_handle> handles;
    for (const Vec2& p : loop) handles.push_back(insert(p));
    for (size_t i = 0; i < handles.size(); ++i) cdt.insert_constraint(handles[i], handles[(i + 1) % handles.size()]);
  }
  for (const Vec2& p : inner_points(loops, edge_length)) insert(p);

  Atlas atlas;
  for (const Vec2& p : uvs) atlas.positions.push_back(lifted(p, bend));
  const auto outside = faces_outside(cdt);
  std::vector<std::array<int, 3>> faces;
  for (auto face = cdt.finite_faces_begin(); face != cdt.finite_faces_end(); ++face) {
    if (!outside.count(face)) faces.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }
  for (const auto& corners : faces) add_face(atlas, {corners.begin(), corners.end()}, uvs);
  return atlas;
}

Atlas combine(const std::vector<Atlas>& atlases) {
  Atlas all;
  all.face_offsets.push_back(0);
  double shift = 0;
  for (const Atlas& one : atlases) {
    const int first_vertex = static_cast<int>(all.positions.size()), first_corner = all.corner_count();
    double low = INFINITY, high = -INFINITY;
    for (const Vec3& p : one.positions) low = std::min(low, p.x()), high = std::max(high, p.x());
    for (const Vec3& p : one.positions) all.positions.push_back(p + Vec3(shift - low, 0, 0));
    shift += high - low + 0.5;
    for (int v : one.corner_vertices) all.corner_vertices.push_back(v + first_vertex);
    all.corner_uvs.insert(all.corner_uvs.end(), one.corner_uvs.begin(), one.corner_uvs.end());
    for (int f = 0; f < one.face_count(); ++f) all.face_offsets.push_back(one.face_offsets[f + 1] + first_corner);
  }
  return all;
}

std::vector<Named> named_polygons() {
  return {{"C", c_shape()}, {"S", s_shape()}, {"U", u_shape()}, {"spiral", spiral()},
          {"comb", comb()}, {"star", star()}, {"ring", ring()}};
}

Atlas two_squares(double distance) {
  return combine({mesh(rectangle(1, 1), 0.2), mesh(transformed(rectangle(1, 1), 1, 0, {1 + distance, 0}), 0.2)});
}

Atlas squares(int count, double spacing) {
  const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
  std::vector<Atlas> charts;
  for (int k = 0; k < count; ++k) {
    Atlas square = quad_grid(2, 2);
    const double side_length = Rng(7, k).uniform(0.5, 1.0);
    const Vec2 corner((k % columns) * (1 + spacing), (k / columns) * (1 + spacing));
    for (Vec3& p : square.positions) p *= side_length;
    for (Vec2& uv : square.corner_uvs) uv = side_length * uv + corner;
    charts.push_back(std::move(square));
  }
  return combine(charts);
}

Atlas scraps_and_blobs(int count, std::uint64_t seed) {
  constexpr double kPitch = 4;  // of a loose layout, more than any chart is wide
  const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
  std::vector<Atlas> charts;
  for (int k = 0; k < count; ++k) {
    Rng rng(seed, k);
    const bool scrap = rng.uniform() < 0.8;
    Atlas chart = scrap ? quad_grid(1 + rng.below(4), 1) : mesh(random_star_polygon(seed + k), 0.15);
    const double size = (scrap ? 0.35 : 1.5) * std::exp(0.5 * rng.uniform(-1, 1));
    const Vec2 corner(kPitch * (k % columns), kPitch * (k / columns));
    for (Vec3& p : chart.positions) p *= size;
    for (Vec2& uv : chart.corner_uvs) uv = size * uv + corner;
    charts.push_back(std::move(chart));
  }
  return combine(charts);
}

Atlas disk_in_ring() { return combine({mesh(ring()), mesh(disk(0.15))}); }

Atlas touching_charts() { return combine({mesh(rectangle(1, 1), 0.2), mesh(transformed(rectangle(1, 1), 1, 0, {1, 0}), 0.2)}); }

Atlas quad_grid(int columns, int rows) {
  Atlas atlas;
  std::vector<Vec2> uvs;
  for (int r = 0; r <= rows; ++r) {
    for (int c = 0; c <= columns; ++c) uvs.emplace_back(static_cast<double>(c) / columns, static_cast<double>(r) / columns);
  }
  for (const Vec2& p : uvs) atlas.positions.push_back(lifted(p, 0.5));
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const int v = r * (columns + 1) + c;
      add_face(atlas, {v, v + 1, v + columns + 2, v + columns + 1}, uvs);
    }
  }
  return atlas;
}

Atlas quad_band(int along, int across, double turns) {
  Atlas atlas;
  std::vector<Vec2> uvs;
  for (int k = 0; k <= along; ++k) {
    for (int i = 0; i <= across; ++i) uvs.push_back(polar(0.25 + 0.25 * i / across, 2 * kPi * turns * k / along));
  }
  for (const Vec2& p : uvs) atlas.positions.push_back(lifted(p, 0.5));
  for (int k = 0; k < along; ++k) {
    for (int i = 0; i < across; ++i) {
      const int v = k * (across + 1) + i;
      add_face(atlas, {v, v + 1, v + across + 2, v + across + 1}, uvs);
    }
  }
  return atlas;
}

Atlas honeycomb(int columns, int rows) {
  // Rows of vertices that go up and down by turns; a cell lies between two of them, every other row half a cell further.
  const int width = 2 * columns + 2;
  const double scale = 0.5 / std::max(columns, rows);
  Atlas atlas;
  std::vector<Vec2> uvs;
  for (int r = 0; r <= rows; ++r) {
    for (int i = 0; i < width; ++i) uvs.push_back(scale * Vec2(0.87 * i, 1.5 * r + ((i + r) % 2 == 0 ? 0.25 : -0.25)));
  }
  for (const Vec2& p : uvs) atlas.positions.push_back(lifted(p, 0.5));
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const int low = r * width + 2 * c + r % 2, high = low + width;
      add_face(atlas, {low, low + 1, low + 2, high + 2, high + 1, high}, uvs);
    }
  }
  return atlas;
}

Atlas self_overlapping(double turns) {
  constexpr int kAcross = 4;
  constexpr double kInner = 0.3, kOuter = 0.5;
  const int along = static_cast<int>(40 * turns);
  Atlas atlas;
  std::vector<Vec2> uvs;
  for (int k = 0; k <= along; ++k) {
    const double angle = 2 * kPi * turns * k / along;
    for (int i = 0; i <= kAcross; ++i) {
      uvs.push_back(polar(kInner + (kOuter - kInner) * i / kAcross, angle));
      atlas.positions.emplace_back(uvs.back().x(), uvs.back().y(), 0.05 * angle);
    }
  }
  for (int k = 0; k < along; ++k) {
    for (int i = 0; i < kAcross; ++i) {
      const int v = k * (kAcross + 1) + i;
      add_face(atlas, {v, v + 1, v + kAcross + 2}, uvs);
      add_face(atlas, {v, v + kAcross + 2, v + kAcross + 1}, uvs);
    }
  }
  return atlas;
}

Atlas mirrored(const Atlas& atlas) {
  Atlas result = atlas;
  for (Vec2& uv : result.corner_uvs) uv.x() = -uv.x();
  return result;
}

Atlas with_flipped_face(const Atlas& atlas) {
  // The first face's first vertex goes through the middle of the opposite edge, in every corner that holds it.
  Atlas result = atlas;
  const int moved = atlas.corner_vertices[0];
  const Vec2 old = atlas.corner_uvs[0];
  const Vec2 target = old + 1.5 * (0.5 * (atlas.corner_uvs[1] + atlas.corner_uvs[2]) - old);
  for (int c = 0; c < atlas.corner_count(); ++c) {
    if (atlas.corner_vertices[c] == moved) result.corner_uvs[c] = target;
  }
  return result;
}

}  // namespace atlas_refine::shapes
