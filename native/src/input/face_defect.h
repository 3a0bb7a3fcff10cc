// A face that a chart cannot be used with.
#pragma once

#include <string>

namespace atlas_refine {

/// A face that is not positive in the UV plane.
struct FaceDefect {
  enum class Kind {
    Flipped,        ///< turned against the rest of its chart
    ZeroArea,       ///< a point or a line in the UV plane
    CrossesItself,  ///< a polygon of positive area whose outline is not simple; its triangles are a fan
  };
  int chart;
  int face;
  Kind kind;
};

/// "face 7 of chart 0 is flipped in the UV map"; `chart` is what the chart is called.
std::string describe(const FaceDefect& defect, int chart);

}  // namespace atlas_refine
