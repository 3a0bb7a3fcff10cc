// Charts and problems of single faces.
#include "atlas_refine/inspect.h"

#include <algorithm>

#include "geometry/box_tree.h"
#include "geometry/predicates.h"
#include "input/check_atlas.h"
#include "input/split_charts.h"
#include "input/take_part.h"
#include "measure/distortion.h"

namespace atlas_refine {
namespace {

UsableAtlas usable_of(const Atlas& atlas) {
  check_arrays(atlas);
  if (is_usable(atlas)) return {atlas, std::vector<char>(atlas.face_count(), 1)};
  return set_unusable_aside(atlas);
}

struct PlacedTriangle {
  std::array<Vec2, 3> corners;  // counterclockwise
  int face;
};

/// Those with area, whichever way they are turned.
std::vector<PlacedTriangle> triangles_of(const std::vector<Chart>& placed, const std::vector<char>& left_out) {
  std::vector<PlacedTriangle> out;
  for (const Chart& chart : placed) {
    for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
      const Triangle& v = chart.triangles[t];
      if (left_out[chart.triangle_faces[t]]) continue;
      PlacedTriangle triangle{{chart.uvs[v[0]], chart.uvs[v[1]], chart.uvs[v[2]]}, chart.triangle_faces[t]};
      const int turn = orientation(triangle.corners[0], triangle.corners[1], triangle.corners[2]);
      if (turn < 0) std::swap(triangle.corners[1], triangle.corners[2]);
      if (turn != 0) out.push_back(triangle);
    }
  }
  return out;
}

/// Whether a side of `a` has all of `b` on its other side, or on itself.
bool side_parts(const PlacedTriangle& a, const PlacedTriangle& b) {
  for (int k = 0; k < 3; ++k) {
    const Vec2 &from = a.corners[k], &to = a.corners[(k + 1) % 3];
    if (std::all_of(b.corners.begin(), b.corners.end(), [&](const Vec2& p) { return orientation(from, to, p) <= 0; }))
      return true;
  }
  return false;
}

/// Two triangles have no inner point in common exactly where a side of one parts them.
bool overlap_inside(const PlacedTriangle& a, const PlacedTriangle& b) { return !side_parts(a, b) && !side_parts(b, a); }

std::vector<char> find_overlapping(const std::vector<PlacedTriangle>& triangles, int face_count) {
  std::vector<Box> boxes;
  for (const PlacedTriangle& t : triangles) boxes.push_back(box_of_points({t.corners.begin(), t.corners.end()}));
  const BoxTree tree(boxes, std::vector<int>(boxes.size(), 0));
  std::vector<char> found(face_count, 0);
  const double touching = 0;
  for (int i = 0; i < static_cast<int>(triangles.size()); ++i) {
    tree.visit_within(boxes[i], touching, -1, [&](int j) {
      const int a = triangles[i].face, b = triangles[j].face;
      if (a != b && !(found[a] && found[b]) && overlap_inside(triangles[i], triangles[j])) found[a] = found[b] = 1;
      return true;
    });
  }
  return found;
}

std::vector<int> numbers_of(const std::vector<char>& flags) {
  std::vector<int> out;
  for (std::size_t f = 0; f < flags.size(); ++f) {
    if (flags[f]) out.push_back(static_cast<int>(f));
  }
  return out;
}

/// Flags of faces without UVs, and of charts that are a point or a line.
std::vector<char> find_unwrapped(const ChartSet& set, const std::vector<char>& has_uvs) {
  std::vector<char> out;
  for (const char has : has_uvs) out.push_back(!has);
  const double side = collapse_side(set);
  for (const Chart& chart : set.charts) {
    if (!is_collapsed(chart, side)) continue;
    for (const int face : chart.triangle_faces) out[face] = 1;
  }
  return out;
}

}  // namespace

std::vector<int> charts_of_faces(const Atlas& atlas, const std::vector<int>& groups) {
  const UsableAtlas usable = usable_of(atlas);
  const ChartSet set = split_charts(usable.atlas, Joining::AsMeant, groups);
  std::vector<int> out;
  for (int f = 0; f < atlas.face_count(); ++f) out.push_back(set.corners[atlas.face_offsets[f]].chart);
  return out;
}

Problems find_problems(const Atlas& atlas) {
  const UsableAtlas usable = usable_of(atlas);
  const ChartSet set = split_charts(usable.atlas);
  const std::vector<char> unwrapped = find_unwrapped(set, usable.has_uvs);
  Problems out{.unwrapped = numbers_of(unwrapped)};
  std::vector<char> zero_area(atlas.face_count(), 0), flipped = zero_area, mirrored = zero_area;
  for (const FaceDefect& defect : set.defects) {
    if (!unwrapped[defect.face]) (defect.kind == FaceDefect::Kind::ZeroArea ? zero_area : flipped)[defect.face] = 1;
  }
  for (std::size_t c = 0; c < set.charts.size(); ++c) {
    if (!set.mirrored[c]) continue;
    for (const int face : set.charts[c].triangle_faces) mirrored[face] = !unwrapped[face];
  }
  out.zero_area = numbers_of(zero_area);
  out.flipped = numbers_of(flipped);
  out.mirrored = numbers_of(mirrored);
  out.overlapping = numbers_of(find_overlapping(triangles_of(charts_as_placed(set), unwrapped), atlas.face_count()));
  return out;
}

}  // namespace atlas_refine
