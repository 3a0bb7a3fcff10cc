// Which charts are refined, in which atlas, and which are not.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "atlas_refine/options.h"
#include "input/split_charts.h"
#include "input/stacks.h"

namespace atlas_refine {

/// A chart that stays as it is, outside the atlas, and why.
struct LeftChart {
  int chart;
  std::string reason;
};

/// The charts of one atlas.
struct Part {
  int group;                ///< of RefineOptions::groups, 0 without
  std::vector<int> charts;  ///< in ascending order
};

struct Participants {
  std::vector<Part> parts;  ///< in the order of their group numbers; none of them empty
  std::vector<LeftChart> left;
  std::vector<Follower> followers;  ///< of charts that take part
  std::vector<int> unstacked;       ///< that lie on others, whose cuts they could not follow
};

/// The number that the chart's faces have in RefineOptions::groups; 0 where there are none.
int group_of(const Chart& chart, const std::vector<int>& groups);

/// Left: charts whose UVs are all on a point or a line, unless they are to be embedded, and charts of faces without finite
/// UVs (`has_uvs` false; empty: all have). Followers: as RefineOptions::stacks says, within one group; charts that are not
/// mirrored, locked ones before, lead; those of different stack groups do not follow each other, nor parts of one folded chart
/// that are no mirrored copies, nor charts in `apart`.
Participants take_part(const ChartSet& set, const RefineOptions& options, const std::vector<char>& has_uvs,
                       const std::set<int>& apart = {});

/// True where the chart's UVs lie on a point or a line: within 1e-6 of `box_side`, or of its own length. Few vertices that are
/// far from all others, which are none of it, do not make a line of the rest.
bool is_collapsed(const Chart& chart, double box_side);
/// The `box_side` for charts of this set.
double collapse_side(const ChartSet& set);

}  // namespace atlas_refine
