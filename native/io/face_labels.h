// Names that faces have in a file: of materials, of objects.
#pragma once

#include <string>
#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine::io {

struct FaceLabels {
  std::vector<std::string> names;  ///< each once, in the order in which faces have them
  std::vector<int> of_face;        ///< one per face of the atlas: index into names
};

}  // namespace atlas_refine::io
