// Triangles of the reader, sorted by face and looked through.
#include "input/reader_triangles.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

namespace atlas_refine {
namespace {

int face_of(const Atlas& atlas, int corner) {
  const auto after = std::upper_bound(atlas.face_offsets.begin(), atlas.face_offsets.end(), corner);
  return static_cast<int>(after - atlas.face_offsets.begin()) - 1;
}

/// True where every side of the polygon is a side of one triangle, and all others meet in pairs that run both ways.
bool make_up_polygon(const std::vector<Triangle>& triangles, int corner_count) {
  if (static_cast<int>(triangles.size()) != corner_count - 2) return false;
  std::set<std::pair<int, int>> sides;
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      if (t[k] == t[(k + 1) % 3] || !sides.emplace(t[k], t[(k + 1) % 3]).second) return false;
    }
  }
  for (const auto& [a, b] : sides) {
    if (sides.contains({b, a}) == (b == (a + 1) % corner_count)) return false;
  }
  return true;
}

}  // namespace

ReaderTriangles::ReaderTriangles(const Atlas& atlas) : atlas_(atlas) {
  if (atlas.triangles.empty()) return;
  std::vector<int> faces;
  for (const auto& triangle : atlas.triangles) faces.push_back(face_of(atlas, triangle[0]));
  first_.assign(atlas.face_count() + 1, 0);
  for (int face : faces) ++first_[face + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  order_.resize(faces.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) { return faces[a] < faces[b]; });
}

std::optional<std::vector<Triangle>> ReaderTriangles::of_face(int face, const std::vector<int>& corners) const {
  if (first_.empty() || first_[face] == first_[face + 1]) return std::nullopt;
  std::vector<Triangle> triangles;
  for (int k = first_[face]; k < first_[face + 1]; ++k) {
    Triangle& triangle = triangles.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const auto at = std::find(corners.begin(), corners.end(), atlas_.triangles[order_[k]][i]);
      triangle[i] = static_cast<int>(at - corners.begin());
    }
    // In the order of the polygon, whichever way the reader winds it.
    std::sort(triangle.begin(), triangle.end());
  }
  std::sort(triangles.begin(), triangles.end());
  if (!make_up_polygon(triangles, static_cast<int>(corners.size()))) return std::nullopt;
  return triangles;
}

}  // namespace atlas_refine
