// Flooding between cuts, and slivers joined.
#include "layout/edge_parts.h"

#include <algorithm>
#include <map>

#include "support/disjoint_sets.h"

namespace atlas_refine {
namespace {

// A part smaller than this share of its chart is a sliver, and one of fewer triangles unless it is this large a share.
constexpr double kLeastShare = 0.01;
constexpr int kLeastTriangles = 4;
constexpr double kLargeShare = 0.1;

struct Part {
  double area = 0;
  int triangles = 0;
  std::map<int, double> borders;  // lengths, by the part beyond
};

/// Parts by their number; a part that was joined to another is empty.
std::map<int, Part> parts_of(const SplitMesh& mesh, const Chart& chart, const std::vector<int>& part) {
  std::map<int, Part> out;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    Part& own = out[part[t]];
    own.area += chart.surface[t].area;
    ++own.triangles;
    for (int k = 0; k < 3; ++k) {
      const int across = mesh.neighbours[t][k];
      if (across < 0 || part[across] == part[t]) continue;
      own.borders[part[across]] += (chart.uvs[mesh.to({t, k})] - chart.uvs[mesh.from({t, k})]).norm();
    }
  }
  return out;
}

bool is_sliver(const Part& part, double whole) {
  return part.area < kLeastShare * whole || (part.triangles < kLeastTriangles && part.area < kLargeShare * whole);
}

void join(std::map<int, Part>& parts, int from, int to) {
  const Part gone = std::move(parts[from]);
  parts.erase(from);
  Part& into = parts[to];
  into.area += gone.area;
  into.triangles += gone.triangles;
  for (const auto& [beyond, length] : gone.borders) {
    if (beyond == to) continue;
    into.borders[beyond] += length;
    Part& other = parts[beyond];
    other.borders.erase(from);
    other.borders[to] += length;
  }
  into.borders.erase(from);
}

int largest_neighbour(const Part& part) {
  return std::max_element(part.borders.begin(), part.borders.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

/// What part each one becomes a part of.
void join_slivers(std::map<int, Part> parts, double whole, DisjointSets& sets) {
  while (parts.size() > 1) {
    const auto smallest = std::min_element(parts.begin(), parts.end(), [&](const auto& a, const auto& b) {
      return std::pair(!is_sliver(a.second, whole), a.second.area) < std::pair(!is_sliver(b.second, whole), b.second.area);
    });
    if (!is_sliver(smallest->second, whole) || smallest->second.borders.empty()) return;
    const int from = smallest->first, to = largest_neighbour(smallest->second);
    sets.unite(from, to);
    join(parts, from, to);
  }
}

}  // namespace

EdgeParts::EdgeParts(const SplitMesh& mesh, const Chart& chart)
    : mesh_(mesh), chart_(chart), is_cut_(mesh.triangle_count(), {0, 0, 0}), on_border_(mesh.vertex_count(), 0) {
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      if (mesh.is_boundary({t, k})) on_border_[mesh.from({t, k})] = on_border_[mesh.to({t, k})] = 1;
    }
  }
}

void EdgeParts::cut(const std::vector<Side>& sides) {
  for (const Side& s : sides) {
    const Side twin = mesh_.twin(s);
    is_cut_[s.triangle][s.side] = is_cut_[twin.triangle][twin.side] = 1;
    on_border_[mesh_.from(s)] = on_border_[mesh_.to(s)] = 1;
  }
}

std::vector<Side> EdgeParts::seams() const {
  DisjointSets sets(mesh_.triangle_count());
  for (int t = 0; t < mesh_.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      if (!is_cut_[t][k] && mesh_.neighbours[t][k] >= 0) sets.unite(t, mesh_.neighbours[t][k]);
    }
  }
  std::vector<int> part(mesh_.triangle_count());
  for (int t = 0; t < mesh_.triangle_count(); ++t) part[t] = sets.find(t);
  join_slivers(parts_of(mesh_, chart_, part), chart_.surface.area(), sets);
  std::vector<Side> out;
  for (int t = 0; t < mesh_.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int across = mesh_.neighbours[t][k];
      if (across > t && sets.find(t) != sets.find(across)) out.push_back({t, k});
    }
  }
  return out;
}

}  // namespace atlas_refine
