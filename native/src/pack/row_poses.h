// Charts as they may stand in a row.
#pragma once

#include <vector>

#include "pack/pack_charts.h"

namespace atlas_refine {

/// Of a hull from the floor up; left sides are mirrored.
using Side = std::vector<Vec2>;

/// A chart in a turn in which it may stand in a row.
struct RowPose {
  int chart;
  Placement motion;  ///< to the floor, its left end at 0
  Vec2 size;
  double area;  ///< of the hull
  Side left, right;
  double to_right_side;  ///< area between the right side and x = 0

  /// Its right end in the mean of a row's height, above the chart where its top ends.
  double mean_end(double height) const { return (to_right_side + (height - size.y()) * right.back().x()) / height; }
};

/// All charts in those turns that lay an edge of their hulls on the floor or the ceiling, the lowest few of each, and the highest
/// of all first.
struct RowPoses {
  std::vector<RowPose> all;
  std::vector<double> least_height;  ///< of each chart
  std::vector<int> by_height;        ///< charts by that, the highest first
  double area = 0;                   ///< of the hulls,
  double grown = 0;                  ///< and with half the gap around them

  RowPoses(const std::vector<Outline>& outlines, double gap);
};

/// By how much a chart with that left side has to lie to the right of one with that right side.
double row_distance(const Side& right, const Side& left, double gap);

}  // namespace atlas_refine
