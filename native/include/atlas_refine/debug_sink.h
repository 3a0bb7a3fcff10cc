// Pictures of the stages: refine() hands every stage's atlas to a DebugSink; svg_sink() draws them.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine {

/// Something drawn over the charts: a boundary edge and the direction it is to take, a trail, or (from == to) a corner.
struct PictureMark {
  enum class Kind { Right, Up, Left, Down, Trail, Cut, ConvexCorner, ReflexCorner };
  Kind kind;
  Vec2 from, to;
};

/// The atlas at one stage. All indices refer to `uvs`.
struct AtlasSnapshot {
  std::string stage;    ///< "input", "placed", "squeezed", ...
  std::string caption;  ///< figures to print under the picture, may be empty
  std::vector<Vec2> uvs;
  std::vector<std::array<int, 3>> triangles;
  std::vector<double> stretch;                   ///< max(s1, 1 / s2) of each triangle, 1 = isometric
  std::vector<std::vector<int>> boundary_loops;  ///< closed, last vertex joins the first
  std::vector<PictureMark> marks;                ///< drawn in this order
  Vec2 box_min = Vec2::Zero();
  Vec2 box_max = Vec2::Zero();
};

class DebugSink {
 public:
  virtual ~DebugSink() = default;
  virtual void receive(const AtlasSnapshot& snapshot) = 0;
};

/// Writes `<directory>/<NN>-<stage>.svg` for each snapshot, a stretch heat map with chart outlines and the box.
/// The directory must exist; throws RefineError(BadOption) where a file cannot be written.
std::unique_ptr<DebugSink> svg_sink(const std::filesystem::path& directory);

}  // namespace atlas_refine
