// Vertex by vertex, among charts whose boxes are the same.
#include "input/stacks.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "input/leaders_triangles.h"
#include "measure/distortion.h"

namespace atlas_refine {
namespace {

constexpr double kPartOfChart = 0.02;

bool near(const Vec2& a, const Vec2& b, double tolerance) { return (a - b).cwiseAbs().maxCoeff() <= tolerance; }

/// A chart that others may lie on.
struct Leader {
  int chart;
  Box box;
  std::vector<int> by_x;  ///< its vertices in the order of u
};

Leader leader_of(const std::vector<Chart>& charts, int chart, const Box& box) {
  Leader leader{chart, box, std::vector<int>(charts[chart].vertex_count())};
  const std::vector<Vec2>& uvs = charts[chart].uvs;
  std::iota(leader.by_x.begin(), leader.by_x.end(), 0);
  std::stable_sort(leader.by_x.begin(), leader.by_x.end(), [&](int a, int b) { return uvs[a].x() < uvs[b].x(); });
  return leader;
}

/// The nearest vertex that is not taken yet, -1 where none is near.
int nearest_vertex(const Vec2& p, const Chart& chart, const Leader& leader, const std::vector<char>& taken, double tolerance) {
  auto at = std::lower_bound(leader.by_x.begin(), leader.by_x.end(), p.x() - tolerance,
                             [&](int v, double x) { return chart.uvs[v].x() < x; });
  int best = -1;
  for (; at != leader.by_x.end() && chart.uvs[*at].x() <= p.x() + tolerance; ++at) {
    if (taken[*at] || !near(p, chart.uvs[*at], tolerance)) continue;
    if (best < 0 || (chart.uvs[*at] - p).squaredNorm() < (chart.uvs[best] - p).squaredNorm()) best = *at;
  }
  return best;
}

/// For each vertex of `chart` one of `onto`'s; nothing where some vertex has none of its own.
std::optional<std::vector<int>> match_vertices(const Chart& chart, const Chart& onto, const Leader& leader, double tolerance) {
  std::vector<char> taken(onto.vertex_count(), 0);
  std::vector<int> out;
  for (const Vec2& p : chart.uvs) {
    const int v = nearest_vertex(p, onto, leader, taken, tolerance);
    if (v < 0) return std::nullopt;
    taken[v] = 1;
    out.push_back(v);
  }
  return out;
}

std::set<std::pair<int, int>> border(const Chart& chart, const std::vector<int>& name) {
  std::set<std::pair<int, int>> edges;
  for (const std::vector<int>& loop : chart.boundary_loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) edges.insert(std::minmax({name[loop[k]], name[loop[(k + 1) % loop.size()]]}));
  }
  return edges;
}

std::optional<Follower> follower_of(const std::vector<Chart>& charts, int chart, const Leader& leader, double tolerance) {
  const Chart &own = charts[chart], &onto = charts[leader.chart];
  if (own.vertex_count() != onto.vertex_count()) return std::nullopt;
  auto vertices = match_vertices(own, onto, leader, tolerance);
  if (!vertices) return std::nullopt;
  std::vector<int> identity(onto.vertex_count());
  std::iota(identity.begin(), identity.end(), 0);
  if (border(own, *vertices) != border(onto, identity)) return std::nullopt;
  const bool same = same_polygons(own, onto, *vertices);
  return Follower{chart, leader.chart, std::move(*vertices), same};
}

}  // namespace

std::vector<Follower> find_stacks(const std::vector<Chart>& placed, const std::vector<int>& candidates, double tolerance) {
  std::vector<Follower> out;
  std::multimap<double, Leader> leaders;  // by the left side of their boxes
  for (const int chart : candidates) {
    const Box box = box_of_points(placed[chart].uvs);
    const double own = std::min(tolerance, kPartOfChart * box.size().maxCoeff());
    std::optional<Follower> found;
    for (auto at = leaders.lower_bound(box.min.x() - own); !found && at != leaders.end() && at->first <= box.min.x() + own;
         ++at) {
      const Leader& leader = at->second;
      if (near(leader.box.min, box.min, own) && near(leader.box.max, box.max, own))
        found = follower_of(placed, chart, leader, own);
    }
    if (found) {
      out.push_back(std::move(*found));
    } else {
      leaders.emplace(box.min.x(), leader_of(placed, chart, box));
    }
  }
  return out;
}

}  // namespace atlas_refine
