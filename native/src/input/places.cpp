// Vertices sorted by position: those that lie together share the smallest index.
#include "input/places.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace atlas_refine {

std::vector<int> places(const Atlas& atlas) {
  const std::vector<Vec3>& positions = atlas.positions;
  const auto key = [&](int v) {
    const int mesh = atlas.vertex_meshes.empty() ? 0 : atlas.vertex_meshes[v];
    return std::tuple(mesh, positions[v].x(), positions[v].y(), positions[v].z());
  };
  std::vector<int> order(positions.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  std::vector<int> place(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    place[order[i]] = same ? place[order[i - 1]] : order[i];
  }
  return place;
}

}  // namespace atlas_refine
