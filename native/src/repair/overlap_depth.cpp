// Vertices looked up in a tree of triangles.
#include "repair/overlap_depth.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/box_tree.h"
#include "geometry/plane.h"
#include "measure/distortion.h"

namespace atlas_refine {
namespace {

constexpr double kWellInside = 0.01;  // of the triangle's heights: borders that touch can be parted

struct FarTriangle {
  Box box;
  std::size_t number;
  int ring;  ///< the least of its corners'
};

/// Those without a corner at a bad one, row by row from left to right, as the tree wants its items.
std::vector<FarTriangle> far_triangles(const Chart& chart, const std::vector<int>& ring) {
  std::vector<FarTriangle> out;
  for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
    const Triangle& v = chart.triangles[t];
    const int least = std::min({ring[v[0]], ring[v[1]], ring[v[2]]});
    if (least > 0) out.push_back({box_of(chart, v), t, least});
  }
  const Box all = box_of_points(chart.uvs);
  const double rows = std::sqrt(static_cast<double>(out.size())) / std::max(all.size().y(), 1e-300);
  const auto row = [&](const FarTriangle& t) { return std::floor((t.box.min.y() - all.min.y()) * rows); };
  std::stable_sort(out.begin(), out.end(), [&](const FarTriangle& a, const FarTriangle& b) {
    return std::pair(row(a), a.box.min.x()) < std::pair(row(b), b.box.min.x());
  });
  return out;
}

bool well_inside(const Chart& chart, const Triangle& t, int vertex) {
  if (t[0] == vertex || t[1] == vertex || t[2] == vertex) return false;
  const Vec2 &a = chart.uvs[t[0]], &b = chart.uvs[t[1]], &c = chart.uvs[t[2]], &p = chart.uvs[vertex];
  const double least = kWellInside * doubled_area(a, b, c);
  return least > 0 && doubled_area(a, b, p) > least && doubled_area(b, c, p) > least && doubled_area(c, a, p) > least;
}

}  // namespace

int overlap_depth(const Chart& chart, const std::vector<int>& ring) {
  const std::vector<FarTriangle> triangles = far_triangles(chart, ring);
  std::vector<Box> boxes;
  for (const FarTriangle& t : triangles) boxes.push_back(t.box);
  const BoxTree tree(std::move(boxes), std::vector<int>(triangles.size(), 0));
  const double touching = 0;
  int depth = 0;
  for (int v = 0; v < chart.vertex_count(); ++v) {
    if (ring[v] <= depth) continue;
    tree.visit_within({chart.uvs[v], chart.uvs[v]}, touching, -1, [&](int k) {
      const int deep = std::min(ring[v], triangles[k].ring);
      if (deep > depth && well_inside(chart, chart.triangles[triangles[k].number], v)) depth = deep;
      return true;
    });
  }
  return depth;
}

}  // namespace atlas_refine
