// Edges that the caller has wishes for, and that the mesh does not have.
#include "report/wished_edges.h"

#include <algorithm>
#include <string>
#include <utility>

#include "input/places.h"

namespace atlas_refine {
namespace {

using Edge = std::pair<int, int>;

/// Of all faces, by the places of their ends, in ascending order.
std::vector<Edge> edges_in_space(const Atlas& atlas, const std::vector<int>& place) {
  std::vector<Edge> out;
  out.reserve(atlas.corner_count());
  for (int f = 0; f < atlas.face_count(); ++f) {
    const int first = atlas.face_offsets[f], end = atlas.face_offsets[f + 1];
    for (int c = first; c < end; ++c) {
      const int next = c + 1 < end ? c + 1 : first;
      out.emplace_back(std::minmax(place[atlas.corner_vertices[c]], place[atlas.corner_vertices[next]]));
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

void tell_of_missing_edges(const Atlas& atlas, const RefineOptions& options, Journal& journal) {
  if (options.no_seam.empty() && options.prefer_seam.empty()) return;
  const std::vector<int> place = places(atlas);
  const std::vector<Edge> edges = edges_in_space(atlas, place);
  const auto is_missing = [&](const std::array<int, 2>& pair) {
    return !std::binary_search(edges.begin(), edges.end(), Edge(std::minmax(place[pair[0]], place[pair[1]])));
  };
  const auto tell = [&](const std::vector<std::array<int, 2>>& pairs, const std::string& wish) {
    const auto count = std::count_if(pairs.begin(), pairs.end(), is_missing);
    if (count == 0) return;
    const auto [a, b] = *std::find_if(pairs.begin(), pairs.end(), is_missing);
    const std::string vertices = std::to_string(a) + " and " + std::to_string(b);
    journal.warnings.push_back(wish + ": " +
                               (count == 1 ? "vertices " + vertices + " are no edge of a face; that pair counts"
                                           : std::to_string(count) + " pairs of vertices are no edge of a face, the first " +
                                                 vertices + "; they count") +
                               " for nothing");
  };
  tell(options.no_seam, "edges without seams");
  tell(options.prefer_seam, "edges for seams");
}

}  // namespace atlas_refine
