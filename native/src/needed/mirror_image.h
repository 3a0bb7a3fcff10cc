// The plane that a surface is its own mirror image by, told by its vertices.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "input/split_charts.h"

namespace atlas_refine {

class MirrorImage {
 public:
  /// `atlas`: that the charts are of; both must outlive this. Planes through the centroid of its vertices, or the origin, along
  /// axes, and across the vertices' principal axes.
  MirrorImage(const Atlas& atlas, const ChartSet& set);

  /// The vertex of a chart where the image of this one lies, in the image of one of its faces.
  std::optional<CornerRef> of(const CornerRef& vertex) const;

 private:
  int point_of(int corner) const;
  std::vector<int> points_of(int face) const;

  const Atlas& atlas_;
  const ChartSet& set_;
  std::vector<int> images_;                  // per point that at its image, -1 where there is none; empty without a plane
  std::vector<std::vector<int>> corner_of_;  // per vertex of each chart one of its corners
  std::vector<int> face_of_;                 // per corner
  std::map<std::vector<int>, int> faces_;    // by their points, in order
};

}  // namespace atlas_refine
