// Edges that the caller has wishes for: which the mesh does not have, and which were cut all the same.
#include "report/wished_edges.h"

#include <algorithm>
#include <set>
#include <string>
#include <tuple>
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

/// How many edges that must stay whole the cuts run along or across.
int forbidden_edges_cut(const std::vector<SidePrices>& prices, const std::vector<Chart>& sources, const CutAtlas& cut) {
  using ChartEdge = std::tuple<int, int, int>;  // chart, lower and higher vertex
  std::set<ChartEdge> forbidden, hit;
  for (int c = 0; c < static_cast<int>(prices.size()); ++c) {
    for (std::size_t t = 0; t < prices[c].size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(sources[c].triangles[t][k], sources[c].triangles[t][(k + 1) % 3]);
        if (prices[c][t][k] == kNoSeam) forbidden.insert({c, low, high});
      }
    }
  }
  const auto note = [&](int chart, const std::set<int>& vertices) {
    const ChartEdge edge{chart, *vertices.begin(), *vertices.rbegin()};
    if (vertices.size() == 2 && forbidden.contains(edge)) hit.insert(edge);
  };
  for (const Seam& seam : cut.seams) {
    std::set<int> both;
    for (int end : seam.ends) {
      std::set<int> own = {end};
      if (end < 0) own = {cut.points[~end].support.vertices.begin(), cut.points[~end].support.vertices.end()};
      own.erase(-1);
      note(seam.chart, own);
      both.insert(own.begin(), own.end());
    }
    note(seam.chart, both);
  }
  return static_cast<int>(hit.size());
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

void warn_of_forbidden_edges(const std::vector<SidePrices>& prices, const std::vector<Chart>& sources, const CutAtlas& cut,
                             Journal& journal) {
  const int count = forbidden_edges_cut(prices, sources, cut);
  if (count == 0) return;
  journal.warnings.push_back("cuts run along or across " + std::to_string(count) + (count == 1 ? " edge" : " edges") +
                             " where no seam is wanted");
}

}  // namespace atlas_refine
