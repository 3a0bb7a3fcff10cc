// What charts take of a box with the gap around them, where that is a part of the box.
#pragma once

#include <optional>
#include <vector>

#include "atlas_refine/options.h"
#include "geometry/chart.h"

namespace atlas_refine {

class RoomForGap {
 public:
  RoomForGap(const std::vector<Chart>& charts, const Gap& gap, double box_aspect);

  /// The part that charts with half the gap around them take of the box with as much around it.
  double taken(double gap, const Vec2& box) const;
  /// The gap in the box of which they take that part; nothing where they take more of any.
  std::optional<double> gap_at(double part) const;
  /// What charts of any shapes, but of their areas, cover at most of a box of the aspect with that gap between them: what is
  /// nearer than half of it to one of them is nobody else's, and has, by Brunn and Minkowski, at least the area of the disk that
  /// it is around a disk of the chart's area.
  double most_pe() const;

 private:
  /// Of charts with half of it around them: a quarter disk at the corners of each.
  double grown(double gap) const;

  double area_;
  double perimeter_;
  double lengths_ = 0;  ///< of charts that cover 1 together: the sum of their areas' roots
  double disks_;        ///< area of a disk of diameter 1 for each chart
  Vec2 unit_;           ///< sides of a box of area 1
  double gap_of_unit_;  ///< in that box
};

}  // namespace atlas_refine
