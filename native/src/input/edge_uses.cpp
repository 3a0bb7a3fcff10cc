// Collecting and sorting the edges of faces.
#include "input/edge_uses.h"

#include <algorithm>
#include <numeric>

#include "support/parallel.h"

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

/// Calls body(corner, next) for every edge of every face.
template <class Body>
void for_each_side(const Atlas& atlas, Body body) {
  for (int f = 0; f < atlas.face_count(); ++f) {
    const int first = atlas.face_offsets[f], end = atlas.face_offsets[f + 1];
    for (int c = first; c < end; ++c) body(c, c + 1 < end ? c + 1 : first);
  }
}

}  // namespace

std::vector<EdgeUse> edge_uses(const Atlas& atlas, const std::vector<int>& place, int threads) {
  const auto lower_place = [&](int c, int next) {
    return std::min(place[atlas.corner_vertices[c]], place[atlas.corner_vertices[next]]);
  };
  std::vector<int> start(place.size() + 1, 0);  // of the uses of each lower place
  for_each_side(atlas, [&](int c, int next) { ++start[lower_place(c, next) + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<EdgeUse> uses(atlas.corner_count());
  std::vector<int> filled(start.begin(), start.end() - 1);
  // Each thread passes over all sides for those of its own places.
  const int places = static_cast<int>(place.size());
  parallel_ranges(threads, threads, 1, [&](int part, int parts_end) {
    const int begin = static_cast<int>(static_cast<long long>(places) * part / threads);
    const int end = static_cast<int>(static_cast<long long>(places) * parts_end / threads);
    for_each_side(atlas, [&](int c, int next) {
      const int low = lower_place(c, next);
      if (low >= begin && low < end) uses[filled[low]++] = use_of(atlas, place, c, next);
    });
    for (int p = begin; p < end; ++p) {
      std::sort(uses.begin() + start[p], uses.begin() + start[p + 1],
                [](const EdgeUse& a, const EdgeUse& b) { return a.sort_key() < b.sort_key(); });
    }
  });
  return uses;
}

}  // namespace atlas_refine
