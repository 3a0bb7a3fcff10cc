// Polygons with holes, written as one outline.
#include "io/keyhole.h"

#include <algorithm>
#include <map>
#include <utility>

namespace atlas_refine::io {

bool is_keyhole(std::vector<int> polygon) {
  std::vector<std::vector<int>> open = {std::move(polygon)};
  std::vector<int> seen;
  while (!open.empty()) {
    const std::vector<int> loop = std::move(open.back());
    open.pop_back();
    const auto n = static_cast<int>(loop.size());
    std::map<std::pair<int, int>, int> edges;  // by their ends, where they start
    bool parted = false;
    for (int i = 0; i < n && !parted; ++i) {
      const int from = loop[i], to = loop[(i + 1) % n];
      if (const auto back = edges.find({to, from}); back != edges.end()) {
        // ... from=b a=to ... : what lies between the two ways, and the rest.
        const int j = back->second;
        open.emplace_back(loop.begin() + j + 1, loop.begin() + i);
        std::vector<int>& rest = open.emplace_back(loop.begin() + i + 1, loop.end());
        rest.insert(rest.end(), loop.begin(), loop.begin() + j);
        parted = true;
      }
      edges[{from, to}] = i;
    }
    if (parted) continue;
    if (n < 3) return false;
    seen.insert(seen.end(), loop.begin(), loop.end());
  }
  std::sort(seen.begin(), seen.end());
  return std::adjacent_find(seen.begin(), seen.end()) == seen.end();
}

}  // namespace atlas_refine::io
