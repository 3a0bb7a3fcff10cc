// Input to charts (section 3, "Inputs"): UV connectivity, mirrored charts turned, flips counted.
#include "input/split_charts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "atlas_refine/error.h"
#include "geometry/half_edge_mesh.h"
#include "geometry/plane.h"
#include "geometry/predicates.h"
#include "geometry/rest_triangle.h"
#include "geometry/triangulate_polygon.h"
#include "input/check_atlas.h"
#include "input/join_edges.h"
#include "support/disjoint_sets.h"

namespace atlas_refine {

namespace {

/// Weight of a face without a shape in space, as a fraction of the mean triangle: it must not count, and must not be zero.
constexpr double kSliverWeight = 1e-6;

class Splitter {
 public:
  explicit Splitter(const Atlas& atlas) : atlas_(atlas), joins_(join_edges(atlas)) {
    set_.seam_edges = joins_.seam_edges;
    set_.seam_length = joins_.seam_length;
  }

  ChartSet run() {
    number_charts();
    orient_charts();
    number_vertices();
    for (int f = 0; f < atlas_.face_count(); ++f) add_face(f);
    make_surfaces();
    for (Chart& chart : set_.charts) set_boundary(chart);
    return std::move(set_);
  }

 private:
  int chart_count() const { return static_cast<int>(set_.charts.size()); }

  void number_charts() {
    face_charts_.assign(atlas_.face_count(), -1);
    std::vector<int> stack;
    int count = 0;
    for (int seed = 0; seed < atlas_.face_count(); ++seed) {
      if (face_charts_[seed] >= 0) continue;
      face_charts_[seed] = count;
      stack.assign(1, seed);
      while (!stack.empty()) {
        const int face = stack.back();
        stack.pop_back();
        for (int c = atlas_.face_offsets[face]; c < atlas_.face_offsets[face + 1]; ++c) {
          if (joins_.partners[c] < 0) continue;
          const int other = joins_.corner_faces[joins_.partners[c]];
          if (face_charts_[other] >= 0) continue;
          face_charts_[other] = count;
          stack.push_back(other);
        }
      }
      ++count;
    }
    set_.charts.resize(count);
    rest_.resize(count);
  }

  /// A chart is mirrored where the UV area of its faces, wound as the input has them, sums to less than zero. Then u is negated.
  /// Either way its faces are turned together so that the chart's area is positive; faces that are not are defects.
  void orient_charts() {
    std::vector<double> as_wound(chart_count(), 0), as_joined(chart_count(), 0);
    for (int f = 0; f < atlas_.face_count(); ++f) {
      const double area = doubled_uv_area(atlas_, f);
      as_wound[face_charts_[f]] += area;
      as_joined[face_charts_[f]] += joins_.turned_faces[f] ? -area : area;
    }
    set_.mirrored.resize(chart_count());
    for (int k = 0; k < chart_count(); ++k) set_.mirrored[k] = as_wound[k] < 0;
    for (int f = 0; f < atlas_.face_count(); ++f) {
      const int k = face_charts_[f];
      const bool negative = (as_joined[k] < 0) != set_.mirrored[k];
      if (negative) joins_.turned_faces[f] = !joins_.turned_faces[f];
    }
  }

  /// UV vertices: corners united across joined edges, so that each has one fan of faces.
  void number_vertices() {
    DisjointSets sets(atlas_.corner_count());
    for (int c = 0; c < atlas_.corner_count(); ++c) {
      const int partner = joins_.partners[c];
      if (partner < c) continue;
      const int c_end = joins_.next_corner(atlas_, c), partner_end = joins_.next_corner(atlas_, partner);
      const bool alike = joins_.turned_faces[joins_.corner_faces[c]] == joins_.turned_faces[joins_.corner_faces[partner]];
      sets.unite(c, alike ? partner_end : partner);
      sets.unite(c_end, alike ? partner : partner_end);
    }
    set_.corners.resize(atlas_.corner_count());
    for (int c = 0; c < atlas_.corner_count(); ++c) {
      const int k = face_charts_[joins_.corner_faces[c]];
      const int root = sets.find(c);
      Chart& chart = set_.charts[k];
      if (root == c) chart.uvs.push_back(uv(c));
      set_.corners[c] = root == c ? CornerRef{k, chart.vertex_count() - 1} : set_.corners[root];
    }
  }

  /// The corner's UV as its chart has it.
  Vec2 uv(int corner) const {
    const Vec2& p = atlas_.corner_uvs[corner];
    return set_.mirrored[face_charts_[joins_.corner_faces[corner]]] ? Vec2(-p.x(), p.y()) : p;
  }

  void add_face(int face) {
    std::vector<int>& corners = scratch_corners_;
    corners.resize(atlas_.face_offsets[face + 1] - atlas_.face_offsets[face]);
    std::iota(corners.begin(), corners.end(), atlas_.face_offsets[face]);
    if (joins_.turned_faces[face]) std::reverse(corners.begin() + 1, corners.end());
    if (corners.size() == 3) {
      if (!add_triangle(face, corners[0], corners[1], corners[2])) add_defect(face, corners);
      return;
    }
    std::vector<Vec2> uvs;
    std::vector<Vec3> positions;
    for (int c : corners) {
      uvs.push_back(uv(c));
      positions.push_back(atlas_.positions[atlas_.corner_vertices[c]]);
    }
    auto triangles = triangulate_polygon(uvs, positions);
    if (!triangles) {
      add_defect(face, corners);
      triangles = polygon_fan(static_cast<int>(corners.size()));
    }
    for (const Triangle& t : *triangles) add_triangle(face, corners[t[0]], corners[t[1]], corners[t[2]]);
  }

  /// False where the triangle is not positive.
  bool add_triangle(int face, int a, int b, int c) {
    const auto position = [&](int corner) { return atlas_.positions[atlas_.corner_vertices[corner]]; };
    Chart& chart = set_.charts[face_charts_[face]];
    chart.triangles.push_back({set_.corners[a].vertex, set_.corners[b].vertex, set_.corners[c].vertex});
    chart.triangle_faces.push_back(face);
    rest_[face_charts_[face]].push_back(rest_from_space(position(a), position(b), position(c)));
    return orientation(uv(a), uv(b), uv(c)) > 0;
  }

  void add_defect(int face, const std::vector<int>& corners) {
    bool negative = false, zero = false;
    double doubled = 0;
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const int sign = orientation(uv(corners[0]), uv(corners[i - 1]), uv(corners[i]));
      negative = negative || sign < 0;
      zero = zero || sign == 0;
      doubled += doubled_area(uv(corners[0]), uv(corners[i - 1]), uv(corners[i]));
    }
    FaceDefect::Kind kind = FaceDefect::Kind::Flipped;
    if (zero && !negative)
      kind = FaceDefect::Kind::ZeroArea;
    else if (corners.size() > 3 && doubled > 0)
      kind = FaceDefect::Kind::CrossesItself;
    set_.defects.push_back({face_charts_[face], face, kind});
  }

  /// Triangles without a shape in space take the one they have in the UV plane, at the scale of their chart, or an equilateral.
  void make_surfaces() {
    double area = 0;
    std::size_t count = 0;
    for (const auto& shapes : rest_) {
      count += shapes.size();
      for (const RestTriangle& rest : shapes) area += rest.area;
    }
    const double mean = area > 0 ? area / static_cast<double>(count) : 1;
    for (int k = 0; k < chart_count(); ++k) {
      give_slivers_a_shape(set_.charts[k], mean, rest_[k]);
      set_.charts[k].surface = Surface(std::move(rest_[k]));
    }
  }

  static void give_slivers_a_shape(const Chart& chart, double mean_area, std::vector<RestTriangle>& shapes) {
    double surface = 0, plane = 0;
    for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
      const Triangle& v = chart.triangles[t];
      if (shapes[t].area == 0) continue;
      surface += shapes[t].area;
      plane += 0.5 * std::abs(doubled_area(chart.uvs[v[0]], chart.uvs[v[1]], chart.uvs[v[2]]));
    }
    const double ratio = std::sqrt(surface / plane);
    const double scale = ratio > 0 && std::isfinite(ratio) ? ratio : 1;
    for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
      const Triangle& v = chart.triangles[t];
      RestTriangle& rest = shapes[t];
      if (rest.area > 0) continue;
      rest = rest_from_plane(chart.uvs[v[0]], chart.uvs[v[1]], chart.uvs[v[2]], scale);
      if (rest.area == 0) rest = rest_equilateral(mean_area);
      rest.area = kSliverWeight * mean_area;
    }
  }

  static void set_boundary(Chart& chart) {
    chart.boundary_loops = mesh_topology(chart.vertex_count(), chart.triangles).boundary_loops;
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < chart.boundary_loops.size(); ++i) {
      const std::vector<int>& loop = chart.boundary_loops[i];
      double sum = 0;
      for (std::size_t j = 2; j < loop.size(); ++j) {
        sum += doubled_area(chart.uvs[loop[0]], chart.uvs[loop[j - 1]], chart.uvs[loop[j]]);
      }
      order.push_back({-std::abs(sum), i});
    }
    std::sort(order.begin(), order.end());
    std::vector<std::vector<int>> sorted;
    for (const auto& [area, i] : order) sorted.push_back(std::move(chart.boundary_loops[i]));
    chart.boundary_loops = std::move(sorted);
  }

  const Atlas& atlas_;
  EdgeJoins joins_;
  ChartSet set_;
  std::vector<int> face_charts_;
  std::vector<std::vector<RestTriangle>> rest_;  ///< of each chart
  std::vector<int> scratch_corners_;
};

}  // namespace

ChartSet split_charts(const Atlas& atlas) {
  check_atlas(atlas);
  return Splitter(atlas).run();
}

std::vector<Chart> charts_as_placed(const ChartSet& set) {
  std::vector<Chart> charts = set.charts;
  for (std::size_t k = 0; k < charts.size(); ++k) {
    if (!set.mirrored[k]) continue;
    for (Vec2& uv : charts[k].uvs) uv.x() = -uv.x();
    for (Triangle& t : charts[k].triangles) std::swap(t[1], t[2]);
    std::vector<RestTriangle> turned(charts[k].surface.begin(), charts[k].surface.end());
    for (RestTriangle& rest : turned) {
      // The edges change places and the flat triangle is turned over, to stay counterclockwise.
      rest.inverse_edges.row(0).swap(rest.inverse_edges.row(1));
      rest.inverse_edges.col(1) *= -1;
    }
    charts[k].surface = Surface(std::move(turned));
    for (std::vector<int>& loop : charts[k].boundary_loops) std::reverse(loop.begin(), loop.end());
  }
  return charts;
}

std::vector<std::vector<int>> space_points(const Atlas& atlas, const ChartSet& set) {
  std::vector<int> order(atlas.positions.size()), point(atlas.positions.size());
  std::iota(order.begin(), order.end(), 0);
  const auto less = [&](int a, int b) {
    const Vec3 &p = atlas.positions[a], &q = atlas.positions[b];
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  };
  std::stable_sort(order.begin(), order.end(), less);
  for (std::size_t k = 0; k < order.size(); ++k) {
    point[order[k]] = k > 0 && !less(order[k - 1], order[k]) ? point[order[k - 1]] : order[k];
  }
  std::vector<std::vector<int>> out;
  for (const Chart& chart : set.charts) out.emplace_back(chart.vertex_count(), -1);
  for (int c = 0; c < atlas.corner_count(); ++c)
    out[set.corners[c].chart][set.corners[c].vertex] = point[atlas.corner_vertices[c]];
  return out;
}

std::string describe(const FaceDefect& defect) {
  const std::string face = "face " + std::to_string(defect.face) + " of chart " + std::to_string(defect.chart);
  switch (defect.kind) {
    case FaceDefect::Kind::Flipped:
      return face + " is flipped in the UV map";
    case FaceDefect::Kind::ZeroArea:
      return face + " has no area in the UV map";
    case FaceDefect::Kind::CrossesItself:
      return face + " crosses itself in the UV map";
  }
  return face;
}

void require_no_flips(const Atlas& atlas, const ChartSet& set) {
  const FaceDefect* first = nullptr;
  int count = 0;
  for (const FaceDefect& defect : set.defects) {
    if (defect.kind == FaceDefect::Kind::CrossesItself) continue;
    if (!first) first = &defect;
    ++count;
  }
  if (!first) return;
  std::string message = message_prefix(atlas) + describe(*first);
  if (count > 1) message += " (and " + std::to_string(count - 1) + " more such faces)";
  throw RefineError(ErrorCode::BadInput, "input", message, first->chart, first->face);
}

}  // namespace atlas_refine
