// Charts without UV area aside, stacks found, the rest dealt out to atlases.
#include "input/take_part.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/box_tree.h"
#include "geometry/freedom.h"
#include "geometry/plane.h"
#include "input/mirrored_copies.h"
#include "measure/distortion.h"
#include "support/quantile.h"

namespace atlas_refine {
namespace {

constexpr double kCollapsed = 1e-6;
constexpr double kFar = 1e3;           // of the median: so long a triangle reaches to a vertex that was lost
constexpr double kTile = 1;            // UV units
constexpr double kOnEachOther = 1e-4;  // of the UV box: how near stacked charts lie

/// Locked charts first, then those that are not mirrored, then the others.
std::vector<int> leaders_first(const ChartSet& set, std::vector<int> charts, const std::vector<char>& locked) {
  const auto rank = [&](int k) { return any_flagged(set.charts[k], locked) ? 0 : set.mirrored[k] ? 2 : 1; };
  std::stable_sort(charts.begin(), charts.end(), [&](int a, int b) { return rank(a) < rank(b); });
  return charts;
}

double extent_of(const Chart& chart, const Triangle& t) { return box_of(chart, t).size().maxCoeff(); }

/// Whether the triangles up to that extent lie on a point or a line.
bool is_point_or_line(const Chart& chart, double longest, double box_side) {
  Box box{Vec2::Constant(INFINITY), Vec2::Constant(-INFINITY)};
  double area = 0;
  for (const Triangle& t : chart.triangles) {
    if (extent_of(chart, t) > longest) continue;
    box = united(box, box_of(chart, t));
    area += 0.5 * std::abs(doubled_area(chart.uvs[t[0]], chart.uvs[t[1]], chart.uvs[t[2]]));
  }
  const double length = box.size().maxCoeff();
  return length <= kCollapsed * box_side || area <= kCollapsed * length * std::max(length, box_side);
}

/// Stacks among those of these charts that may be stacked on each other.
std::vector<Follower> find_stacks_in_groups(const std::vector<Chart>& placed, const std::vector<int>& charts,
                                            const std::vector<int>& stack_groups, double tolerance) {
  std::map<int, std::vector<int>> of_group;
  for (const int k : charts) of_group[group_of(placed[k], stack_groups)].push_back(k);
  std::vector<Follower> out;
  for (const auto& [group, own] : of_group) {
    for (Follower& follower : find_stacks(placed, own, tolerance)) out.push_back(std::move(follower));
  }
  return out;
}

}  // namespace

int group_of(const Chart& chart, const std::vector<int>& groups) {
  return groups.empty() ? 0 : groups[chart.triangle_faces.front()];
}

bool is_collapsed(const Chart& chart, double box_side) {
  if (!is_point_or_line(chart, INFINITY, box_side)) return false;
  std::vector<double> extents;
  for (const Triangle& t : chart.triangles) extents.push_back(extent_of(chart, t));
  return is_point_or_line(chart, kFar * median(std::move(extents)), box_side);
}

double collapse_side(const ChartSet& set) {
  // A vertex far outside the tile must not make points of all charts.
  return std::min(kTile, uv_box(set.charts).size().maxCoeff());
}

Participants take_part(const ChartSet& set, const RefineOptions& options, const std::vector<char>& has_uvs,
                       const std::set<int>& apart) {
  Participants out;
  std::map<int, std::vector<int>> groups;
  const double side = collapse_side(set);
  for (int k = 0; k < static_cast<int>(set.charts.size()); ++k) {
    const Chart& chart = set.charts[k];
    const bool without = !has_uvs.empty() && !has_uvs[chart.triangle_faces.front()];
    if (options.collapsed == Collapsed::Leave && (without || is_collapsed(chart, side))) {
      out.left.push_back({k, without ? "has no finite UVs" : "has no area in the UV map"});
    } else if (any_flagged(chart, options.locked) && chart.boundary_loops.empty()) {
      out.left.push_back({k, "is locked and has no boundary that others could keep away from"});
    } else {
      groups[group_of(chart, options.groups)].push_back(k);
    }
  }
  const bool stacks = options.stacks == Stacks::Keep && set.charts.size() > 1;
  const std::vector<Chart> placed = stacks ? charts_as_placed(set) : std::vector<Chart>();
  for (auto& [group, charts] : groups) {
    std::vector<char> follows(set.charts.size(), 0);
    if (stacks) {
      const std::vector<int> in_order = leaders_first(set, charts, options.locked);
      auto followers = find_stacks_in_groups(placed, in_order, options.stack_groups, kOnEachOther * side);
      keep_mirrored_copies(set, followers);
      for (Follower& follower : followers) {
        if (apart.contains(follower.chart)) {
          out.unstacked.push_back(follower.chart);
          continue;
        }
        follows[follower.chart] = 1;
        out.followers.push_back(std::move(follower));
      }
    }
    std::erase_if(charts, [&](int k) { return follows[k] != 0; });
    out.parts.push_back({group, std::move(charts)});
  }
  return out;
}

}  // namespace atlas_refine
