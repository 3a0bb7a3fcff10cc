// Defects in words.
#include "input/face_defect.h"

namespace atlas_refine {

std::string describe(const FaceDefect& defect, int chart) {
  const std::string face = "face " + std::to_string(defect.face) + " of chart " + std::to_string(chart);
  switch (defect.kind) {
    case FaceDefect::Kind::Flipped:
      return face + " is flipped in the UV map";
    case FaceDefect::Kind::ZeroArea:
      return face + " has no area in the UV map";
    case FaceDefect::Kind::CrossesItself:
      return face + " crosses itself in the UV map";
  }
  return face;
}

}  // namespace atlas_refine
