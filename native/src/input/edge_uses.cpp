// Collecting and sorting the edges of faces.
#include "input/edge_uses.h"

#include <algorithm>

namespace atlas_refine {

namespace {

EdgeUse use_of(const Atlas& atlas, const std::vector<int>& place, int corner, int next) {
  const auto vertex = [&](int c) { return atlas.corner_vertices[c]; };
  const auto end_key = [&](int c) {
    return std::tuple(place[vertex(c)], atlas.corner_uvs[c].x(), atlas.corner_uvs[c].y(), vertex(c));
  };
  int low = corner, high = next;
  if (place[vertex(low)] == place[vertex(high)] ? end_key(low) > end_key(high) : place[vertex(low)] > place[vertex(high)])
    std::swap(low, high);
  EdgeUse use{place[vertex(low)], place[vertex(high)], vertex(low), vertex(high), corner, low, high};
  if (!use.has_length() && use.low_vertex > use.high_vertex) std::swap(use.low_vertex, use.high_vertex);
  return use;
}

}  // namespace

std::vector<EdgeUse> edge_uses(const Atlas& atlas, const std::vector<int>& place) {
  std::vector<EdgeUse> uses;
  uses.reserve(atlas.corner_count());
  for (int f = 0; f < atlas.face_count(); ++f) {
    const int first = atlas.face_offsets[f], end = atlas.face_offsets[f + 1];
    for (int c = first; c < end; ++c) uses.push_back(use_of(atlas, place, c, c + 1 < end ? c + 1 : first));
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) { return a.sort_key() < b.sort_key(); });
  return uses;
}

}  // namespace atlas_refine
